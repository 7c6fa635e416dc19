//! Colours that go together.

use super::color::{Color, mix, of_hue, scaled};
use crate::objects::dice::Dice;

/// Colours of one object.
#[derive(Clone, Copy, Debug)]
pub(in crate::objects) struct Palette {
    /// The largest areas.
    pub(in crate::objects) main: Color,
    /// Beside it.
    pub(in crate::objects) second: Color,
    /// Small areas.
    pub(in crate::objects) accent: Color,
    /// Bright.
    pub(in crate::objects) light: Color,
    /// Dark.
    pub(in crate::objects) dark: Color,
}

impl Palette {
    /// Draws a palette: muted, bright, earthy, pastel, black and white or metal.
    pub(in crate::objects) fn draw(dice: &mut Dice) -> Self {
        let hue = dice.unit();
        let step = dice.pick(&[0.04, 0.08, 0.33, 0.42, 0.5, 0.58, 0.66]);
        let (saturation, value) = match dice.int(0, 9) {
            0..=2 => (dice.range(0.65, 0.95), dice.range(0.6, 0.95)),
            3 | 4 => (dice.range(0.25, 0.5), dice.range(0.4, 0.75)),
            5 | 6 => (dice.range(0.12, 0.3), dice.range(0.8, 0.97)),
            7 => (dice.range(0.4, 0.7), dice.range(0.2, 0.45)),
            _ => (dice.range(0.0, 0.1), dice.pick(&[0.12, 0.35, 0.6, 0.85, 0.95])),
        };
        let bright = dice.range(0.7, 0.95);
        let tint = of_hue(hue, 0.15, 1.0);
        Self {
            main: of_hue(hue, saturation, value),
            second: of_hue(
                hue + step,
                (saturation * dice.range(0.5, 1.3)).min(1.0),
                (value * dice.range(0.6, 1.4)).clamp(0.1, 0.97),
            ),
            accent: of_hue(hue + 0.5 + dice.around_zero(0.15), bright, dice.range(0.55, 0.95)),
            light: mix([0.96, 0.95, 0.92], tint, dice.range(0.0, 0.8) as f32),
            dark: scaled(tint, dice.range(0.06, 0.22) as f32),
        }
    }

    /// Any of the five.
    pub(in crate::objects) fn any(&self, dice: &mut Dice) -> Color {
        dice.pick(&self.all())
    }

    /// The five, the largest areas first.
    pub(in crate::objects) fn all(&self) -> [Color; 5] {
        [self.main, self.second, self.accent, self.light, self.dark]
    }

    /// The same colours in another order, so that parts of one object differ but match.
    pub(in crate::objects) fn turned(&self, by: u32) -> Self {
        let mut all = self.all();
        all.rotate_left(by as usize % 5);
        let [main, second, accent, light, dark] = all;
        Self { main, second, accent, light, dark }
    }
}
