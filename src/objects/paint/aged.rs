//! What use leaves on a surface.

use super::Painter;
use super::color::{mix, scaled};
use super::noise::{fractal, smooth};
use crate::objects::dice::Dice;

/// A texture with dirt, wear, speckles or fading over it: none of it for most `amount` (0 to 1) near 0.
pub(in crate::objects) fn aged(dice: &mut Dice, size_m: [f64; 2], amount: f64, painter: Painter) -> Painter {
    let seed = dice.seed();
    let period = |feature: f64| size_m.map(|s| ((s / feature) as i32).clamp(1, 256));
    let (large, fine) = (period(dice.log_range(0.015, 0.05)), period(dice.log_range(0.0008, 0.003)));
    let dirt = if dice.chance(amount) { dice.range(0.1, 0.7) as f32 } else { 0.0 };
    let speckle = if dice.chance(amount * 0.7) { dice.range(0.03, 0.3) as f32 } else { 0.0 };
    let shade = dice.range(0.0, 0.15) as f32;
    let scratches = if dice.chance(amount * 0.5) { dice.range(0.1, 0.6) as f32 } else { 0.0 };
    let soil = dice.pick(&[[0.25, 0.2, 0.14], [0.12, 0.11, 0.1], [0.55, 0.5, 0.42], [0.4, 0.22, 0.1]]);
    Box::new(move |u, v| {
        let mut color = painter(u, v);
        let at = |p: [i32; 2]| (u * p[0] as f32, v * p[1] as f32);
        if shade > 0.02 {
            color = scaled(color, 1.0 - shade * v);
        }
        if dirt > 0.0 {
            let (x, y) = at(large);
            let cover = (fractal(x, y, large, 5, seed) - 0.45) * 3.0;
            color = mix(color, soil, dirt * cover.clamp(0.0, 1.0));
        }
        if speckle > 0.0 {
            let (x, y) = at(fine);
            color = scaled(color, 1.0 + speckle * (smooth(x, y, fine, seed + 20) - 0.5) * 2.0);
        }
        if scratches > 0.0 {
            let long = [large[0], fine[1]];
            let (x, y) = at(long);
            let line = smooth(x, y, long, seed + 30);
            color = mix(color, [0.85; 3], scratches * ((line - 0.9) * 10.0).clamp(0.0, 1.0));
        }
        color
    })
}
