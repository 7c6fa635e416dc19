//! What the parts of one object have in common: colours, and how much there is to see on them.

use crate::objects::dice::Dice;
use crate::objects::paint::{
    Painter, Palette, aged, nearly_plain, pattern, plain_or_pattern, printed, texels,
};
use crate::objects::shape::Assembly;

/// Colours, detail and wear of an object.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Its colours.
    pub(super) palette: Palette,
    /// From plain (0) to as much and as fine a pattern as there is (1).
    pub(super) detail: f64,
    /// From new (0) to old (1).
    pub(super) wear: f64,
}

impl Style {
    /// Draws a style; plain and detailed ones, new and old ones are as likely.
    pub(super) fn draw(dice: &mut Dice) -> Self {
        Self { palette: Palette::draw(dice), detail: dice.unit(), wear: dice.unit() * dice.unit() }
    }

    /// The style with its colours in another order.
    pub(super) fn turned(self, by: u32) -> Self {
        Self { palette: self.palette.turned(by), ..self }
    }

    /// A surface of this style, `size_m` wide and high: plain or patterned.
    pub(super) fn surface(&self, a: &mut Assembly, dice: &mut Dice, size_m: [f64; 2]) -> u32 {
        let painter = plain_or_pattern(dice, size_m, &self.palette, self.detail);
        self.worn(a, dice, size_m, painter)
    }

    /// A surface with a pattern in any case.
    pub(super) fn patterned(&self, a: &mut Assembly, dice: &mut Dice, size_m: [f64; 2]) -> u32 {
        let painter = pattern(dice, size_m, &self.palette, self.detail);
        self.worn(a, dice, size_m, painter)
    }

    /// A printed surface.
    pub(super) fn print(&self, a: &mut Assembly, dice: &mut Dice, size_m: [f64; 2]) -> u32 {
        let painter = printed(dice, size_m, &self.palette, self.detail);
        self.worn(a, dice, size_m, painter)
    }

    /// Nearly one colour: the style's main one.
    pub(super) fn plain(&self, a: &mut Assembly, dice: &mut Dice, size_m: [f64; 2]) -> u32 {
        let painter = nearly_plain(dice, size_m, &self.palette, self.detail);
        self.worn(a, dice, size_m, painter)
    }

    /// A surface with the given texture, as worn as the style is.
    pub(super) fn worn(&self, a: &mut Assembly, dice: &mut Dice, size_m: [f64; 2], painter: Painter) -> u32 {
        let painter = aged(dice, size_m, self.wear, painter);
        a.paint(texels(size_m), painter)
    }
}
