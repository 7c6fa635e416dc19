//! Printed matter: labels, packages, pages.

use super::Painter;
use super::color::{Color, mix, scaled};
use super::glyphs::{bars, letter_ink, writing};
use super::noise::{fractal, hash};
use super::palette::Palette;
use super::pattern::plain_or_pattern;
use crate::objects::dice::Dice;
use crate::objects::exact::{angle_turns, wave};

/// A rectangle of a print: left, top, right, bottom in 0..1, and what is in it.
struct Block {
    at: [f32; 4],
    what: What,
    ink: Color,
    seed: u32,
}

enum What {
    /// A flat area.
    Area,
    /// A frame, its width as a share of the texture's.
    Frame(f32),
    /// Writing: letters in a line, lines.
    Text([f32; 2]),
    /// A word in large letters.
    Word(f32),
    Bars,
    /// A round emblem with so many rays; its second colour.
    Emblem(f32, Color),
    /// A landscape of three colours.
    Picture([Color; 3]),
}

/// A print of a ground and blocks of words, writing, pictures and codes: more of them, and finer ones, the nearer
/// `detail` is to 1.
pub(in crate::objects) fn printed(
    dice: &mut Dice,
    size_m: [f64; 2],
    palette: &Palette,
    detail: f64,
) -> Painter {
    let shuffled = palette.turned(dice.int(0, 4));
    let ground = if dice.chance(0.6) {
        let color = dice.pick(&[palette.light, palette.main, shuffled.main]);
        Box::new(move |_, _| color) as Painter
    } else {
        plain_or_pattern(dice, size_m, &shuffled, detail * 0.6)
    };
    let inks = [palette.dark, palette.accent, palette.second, palette.light];
    let ratio = (size_m[0] / size_m[1]) as f32;
    let mut blocks = Vec::new();
    let count = 1 + (detail * dice.range(2.0, 11.0)) as u32;
    for _ in 0..count {
        let (width, height) = (dice.range(0.15, 0.7), dice.range(0.06, 0.45));
        let (x, y) = (dice.range(0.02, 0.98 - width), dice.range(0.03, 0.97 - height));
        let at = [x, y, x + width, y + height].map(|c| c as f32);
        let letter = dice.log_range(0.0012, 0.004);
        let columns = (width * size_m[0] / letter).clamp(2.0, 120.0) as f32;
        let lines = (height * size_m[1] / (letter * 1.7)).clamp(1.0, 80.0) as f32;
        let what = match dice.int(0, 9) {
            0 => What::Area,
            1 => What::Frame(dice.range(0.008, 0.03) as f32),
            2 | 3 => What::Text([columns, lines.round().max(1.0)]),
            4..=6 => What::Word(dice.int(3, 8) as f32),
            7 => What::Bars,
            8 => What::Emblem(dice.int(3, 14) as f32, palette.any(dice)),
            _ => What::Picture([palette.any(dice), palette.any(dice), palette.any(dice)]),
        };
        // A word that fills its block would be stretched beyond reading.
        let at = match &what {
            What::Word(letters) => {
                let tall = (at[2] - at[0]) * ratio / letters * 1.3;
                [at[0], at[1], at[2], (at[1] + tall).min(0.98)]
            }
            _ => at,
        };
        if dice.chance(0.5) {
            let margin = [at[0] - 0.015, at[1] - 0.015, at[2] + 0.015, at[3] + 0.015];
            blocks.push(Block { at: margin, what: What::Area, ink: palette.any(dice), seed: 0 });
        }
        blocks.push(Block { at, what, ink: dice.pick(&inks), seed: dice.seed() });
    }
    Box::new(move |u, v| {
        let mut color = ground(u, v);
        for block in &blocks {
            if let Some(over) = block.color(u, v, ratio) {
                color = over;
            }
        }
        color
    })
}

impl Block {
    fn color(&self, u: f32, v: f32, ratio: f32) -> Option<Color> {
        let [left, top, right, bottom] = self.at;
        if !(left..right).contains(&u) || !(top..bottom).contains(&v) {
            return None;
        }
        let (x, y) = ((u - left) / (right - left), (v - top) / (bottom - top));
        let inked = |ink: bool| ink.then_some(self.ink);
        match &self.what {
            What::Area => Some(self.ink),
            What::Frame(width) => {
                let edge = (u - left).min(right - u).min((v - top) / ratio).min((bottom - v) / ratio);
                inked(edge < *width)
            }
            What::Text([letters, lines]) => inked(writing(x * letters, y * lines, *letters, self.seed)),
            What::Word(letters) => {
                let at = x * letters;
                inked(letter_ink((at - at.floor()) / 0.8, y, hash(at as i32, 1, self.seed)))
            }
            What::Bars => Some(if bars(x, self.seed) { [0.06; 3] } else { [0.97; 3] }),
            What::Emblem(rays, second) => {
                let (a, b) = ((x - 0.5) * (right - left) * ratio, (y - 0.5) * (bottom - top));
                let r = (a * a + b * b).sqrt() / (0.5 * ((right - left) * ratio).min(bottom - top));
                let ray = wave(angle_turns(b, a) * rays);
                (r < 1.0).then_some(if r < 0.45 || (r < 0.85 && ray > 0.0) { self.ink } else { *second })
            }
            What::Picture([sky, land, near]) => {
                let hill = |k: u32, height: f32| {
                    y > height + 0.35 * (fractal(x * 4.0, k as f32, [64, 64], 4, self.seed + k) - 0.5)
                };
                let light = 0.8 + 0.4 * fractal(x * 12.0, y * 12.0, [64, 64], 4, self.seed + 9);
                let sun = (x - 0.7) * (x - 0.7) + (y - 0.25) * (y - 0.25) < 0.012;
                Some(if hill(1, 0.75) {
                    scaled(*near, light)
                } else if hill(2, 0.5) {
                    scaled(*land, light)
                } else if sun {
                    [0.98, 0.92, 0.7]
                } else {
                    mix(*sky, [1.0; 3], y)
                })
            }
        }
    }
}

/// A page full of writing.
pub(super) fn page(dice: &mut Dice, size_m: [f64; 2], paper: Color, inks: [Color; 2]) -> Painter {
    let letter = dice.log_range(0.0014, 0.005);
    let (columns, lines) =
        ((size_m[0] / letter).max(2.0) as f32, (size_m[1] / (letter * 1.7)).round().max(2.0) as f32);
    let seed = dice.seed();
    Box::new(move |u, v| {
        let (x, y) = ((u - 0.05) / 0.9, (v - 0.04) / 0.92);
        if !(0.0..1.0).contains(&y) || !writing(x * columns * 0.9, y * lines, columns * 0.9, seed) {
            return paper;
        }
        inks[hash((y * lines) as i32, 3, seed) as usize % 7 / 6]
    })
}
