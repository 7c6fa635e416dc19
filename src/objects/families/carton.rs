//! Boxes: printed packages, open cartons with flaps, milk cartons, parcels, presents.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::{V, v};
use crate::objects::paint::{Painter, atlas, printed};
use crate::objects::shape::{ATLAS, Assembly, SAME_EACH, WHOLE};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let size = v(dice.log_range(0.03, 0.14), dice.log_range(0.02, 0.14), dice.log_range(0.02, 0.2));
    match dice.int(0, 6) {
        0 | 1 => package(&mut a, dice, &style, size),
        2 => open_carton(&mut a, dice, &style, size),
        3 => milk_carton(&mut a, dice, &style, v(size.x.min(0.1), size.x.min(0.1), size.z.max(0.08))),
        4 => present(&mut a, dice, &style, size),
        _ => parcels(&mut a, dice, &style),
    }
    a
}

/// One texture for six faces of a box of `size`, each printed for itself.
fn faces(a: &mut Assembly, dice: &mut Dice, style: &Style, size: V) -> u32 {
    let across = [
        [size.x, size.z],
        [size.y, size.z],
        [size.x, size.z],
        [size.y, size.z],
        [size.x, size.y],
        [size.x, size.y],
    ];
    let plainer = Style { detail: style.detail * 0.4, ..*style };
    let painters: [Painter; 6] = across.map(|face| {
        let style = if dice.chance(0.7) { style } else { &plainer };
        printed(dice, face, &style.palette, style.detail)
    });
    let aged = crate::objects::paint::aged(dice, [size.x, size.z], style.wear, atlas(painters));
    a.paint((1536, 1024), aged)
}

fn package(a: &mut Assembly, dice: &mut Dice, style: &Style, size: V) {
    let paint = faces(a, dice, style, size);
    let radius = if dice.chance(0.7) { 0.0006 } else { dice.range(0.002, 0.012) };
    let dent = if dice.chance(0.3) { dice.range(0.0, 0.06) } else { 0.0 };
    let frame = a.at.moved(0.0, 0.0, size.z / 2.0);
    a.within(frame, |a| {
        a.box_bent(size, radius, 3, ATLAS, paint, |p| {
            // Bulging or pressed in: the middle of the sides moves most.
            let free =
                (1.0 - 4.0 * p.x * p.x / (size.x * size.x)) * (1.0 - 4.0 * p.z * p.z / (size.z * size.z));
            v(p.x, p.y * (1.0 - dent * 2.0 * free.max(0.0)), p.z)
        });
    });
}

fn open_carton(a: &mut Assembly, dice: &mut Dice, style: &Style, size: V) {
    let size = v(size.x.max(0.06), size.y.max(0.06), size.z.clamp(0.04, 0.14));
    let wall = dice.range(0.0015, 0.003);
    let outside = style.print(a, dice, [size.x, size.z]);
    let inside = style.turned(3).plain(a, dice, [size.x, size.z]);
    let (x, y, z) = (size.x / 2.0, size.y / 2.0, size.z);
    // One solid: rings of four corners, in from the floor, up the inside, over the edge, down the outside.
    let ring = |dx: f64, dy: f64, z: f64| -> Vec<V> {
        vec![v(-dx, -dy, z), v(dx, -dy, z), v(dx, dy, z), v(-dx, dy, z)]
    };
    a.part(true, |a| {
        let floor = ring(x - wall, y - wall, wall);
        a.fan(&floor, true, WHOLE, inside);
        a.skin(&[floor, ring(x - wall, y - wall, z)], true, WHOLE, inside);
        a.skin(&[ring(x - wall, y - wall, z), ring(x, y, z)], true, WHOLE, inside);
        a.skin(&[ring(x, y, z), ring(x, y, 0.0)], true, WHOLE, outside);
        a.fan(&ring(x, y, 0.0), false, WHOLE, outside);
    });
    for side in 0..4u32 {
        let (half, depth) = if side % 2 == 0 { (x, y) } else { (y, x) };
        let (opening, length) = (dice.range(0.02, 0.42), half.min(depth) * dice.range(0.7, 1.0));
        let frame =
            a.at.turned(2, 0.25 * f64::from(side))
                .moved(0.0, -depth, z - wall * 0.5)
                .turned(0, 0.25 + opening);
        a.within(frame, |a| {
            a.block(v(-half * 0.98, -wall / 2.0, 0.0), v(half * 0.98, wall / 2.0, length), outside)
        });
    }
    if dice.chance(0.6) {
        for _ in 0..dice.int(1, 6) {
            let r = dice.range(0.012, 0.03f64.min(x.min(y) * 0.7));
            let paint = style.turned(dice.int(0, 4)).surface(a, dice, [r * 6.0, r * 3.0]);
            let at = v(dice.around_zero((x - r) * 0.45), dice.around_zero((y - r) * 0.45), wall + r);
            if dice.chance(0.5) {
                a.ellipsoid(at, V::repeat(r), 16, paint);
            } else {
                a.block(at.add_scalar(-r * 0.7), at.add_scalar(r * 0.7), paint);
            }
        }
    }
}

fn milk_carton(a: &mut Assembly, dice: &mut Dice, style: &Style, size: V) {
    let (h, body) = (size.x / 2.0, size.z * dice.range(0.65, 0.8));
    let skin = style.print(a, dice, [4.0 * size.x, size.z]);
    let ridge = size.z - size.z * 0.08;
    let ring = |x: f64, y: f64, z: f64| -> Vec<V> {
        // Eight points, so that the gable's gussets can fold in.
        vec![
            v(-x, -y, z),
            v(0.0, -y, z),
            v(x, -y, z),
            v(x, 0.0, z),
            v(x, y, z),
            v(0.0, y, z),
            v(-x, y, z),
            v(-x, 0.0, z),
        ]
    };
    let mut gable = ring(h, 0.0015, ridge);
    gable[3].x = h * 0.45;
    gable[7].x = -h * 0.45;
    a.loft(
        &[ring(h, 0.0015, size.z), ring(h, 0.0015, ridge + 0.001), gable, ring(h, h, body), ring(h, h, 0.0)],
        skin,
        skin,
    );
    if dice.chance(0.7) {
        let cap = a.plain(style.palette.accent);
        let slope = f64::from(crate::objects::exact::angle_turns((ridge - body) as f32, h as f32));
        let frame = a.at.moved(0.0, -h * 0.5, (body + ridge) * 0.5 - 0.001).turned(0, slope);
        let disc = crate::objects::shape::circle([h * 0.35, h * 0.35], 32);
        a.within(frame, |a| a.extrude(&disc, h * 0.3, 0.001, cap, cap));
    }
}

fn present(a: &mut Assembly, dice: &mut Dice, style: &Style, size: V) {
    let paper = style.patterned(a, dice, [size.x.max(size.y), size.z.max(size.y)]);
    let ribbon = style.turned(2).surface(a, dice, [0.1, 0.02]);
    let frame = a.at.moved(0.0, 0.0, size.z / 2.0);
    let (wide, proud) = (dice.range(0.004, 0.014), 0.0012);
    a.within(frame, |a| {
        a.rounded_box(size, 0.001, 1, SAME_EACH, paper);
        a.rounded_box(v(size.x + proud, wide, size.z + proud), 0.0003, 1, SAME_EACH, ribbon);
        a.rounded_box(v(wide, size.y + proud, size.z + proud), 0.0003, 1, SAME_EACH, ribbon);
    });
    let loops = dice.int(2, 9);
    let reach = size.x.min(size.y) * dice.range(0.25, 0.5);
    for k in 0..loops {
        let frame =
            a.at.moved(0.0, 0.0, size.z).turned(2, f64::from(k) / f64::from(loops) + dice.around_zero(0.02));
        let lift = reach * dice.range(0.3, 0.9);
        a.within(frame, |a| {
            a.sheet((2, 24), ribbon, |s, t| {
                let out = crate::objects::exact::sin_turns(t * 0.5);
                let up = crate::objects::exact::sin_turns(t) * 0.35 + out * 0.5;
                v(out * reach, s * wide * 0.5 * (0.4 + 0.6 * out), up * lift + 0.001)
            });
        });
    }
}

fn parcels(a: &mut Assembly, dice: &mut Dice, style: &Style) {
    let mut z = 0.0;
    let (mut x, mut y) = (dice.range(0.08, 0.14), dice.range(0.07, 0.12));
    for k in 0..dice.int(2, 6) {
        let height = dice.range(0.012, 0.06);
        let size = v(x, y, height);
        let paint = faces(a, dice, &style.turned(k), size);
        let before = a.at;
        a.at = before
            .moved(dice.around_zero(0.006), dice.around_zero(0.006), z + height / 2.0)
            .turned(2, dice.around_zero(0.06));
        a.rounded_box(size, 0.0006, 1, ATLAS, paint);
        a.at = before;
        z += height + 0.0002;
        x *= dice.range(0.75, 1.02);
        y *= dice.range(0.75, 1.02);
    }
}
