//! Soft toys: animals of lumps that flow into each other, with eyes, ears and tails.

use super::style::Style;
use crate::objects::dice::Dice;
use crate::objects::frame::{V, v};
use crate::objects::paint::{Painter, fractal, mix, mosaic_skin, scaled};
use crate::objects::shape::{Assembly, Blob, Lump};

pub(super) fn make(dice: &mut Dice) -> Assembly {
    let mut a = Assembly::new();
    let style = Style::draw(dice);
    let tile = dice.range(0.05, 0.09);
    let fur = hide(&mut a, dice, &style, tile);
    let belly = hide(&mut a, dice, &style.turned(3), tile);
    let paws = if dice.chance(0.5) { hide(&mut a, dice, &style.turned(1), tile) } else { fur };
    let build = Build::draw(dice);
    let mut lumps = Vec::new();
    let head = match dice.int(0, 3) {
        0 | 1 => four_legged(&mut lumps, dice, &build, [fur, belly, paws]),
        2 => sitting(&mut lumps, dice, &build, [fur, belly, paws]),
        _ => bird_or_fish(&mut lumps, dice, &build, [fur, belly, paws]),
    };
    head_of(&mut lumps, dice, &head, [fur, belly, paws]);
    let blob = Blob { lumps, softness: dice.range(0.004, 0.02), tile };
    a.blob(&blob, dice.int(38, 56) as usize, |_, d| d);
    face(&mut a, dice, &style, &head);
    if dice.chance(0.35) {
        // A collar or scarf.
        let cloth = style.turned(2).patterned(&mut a, dice, [0.2, 0.02]);
        let at = head.center + (head.neck - head.center) * 0.75;
        let (r, thick) = (head.r * 0.85, dice.range(0.002, 0.005));
        let frame = a.at.along(at, head.center - head.neck);
        let path: Vec<V> =
            crate::objects::shape::circle([r, r], 40).iter().map(|[x, y]| v(*x, *y, 0.0)).collect();
        a.within(frame, |a| a.ring_along(&path, 12, [thick, thick], 0.0, cloth));
    }
    a
}

/// Fur, plush, scales or patches.
fn hide(a: &mut Assembly, dice: &mut Dice, style: &Style, tile: f64) -> u32 {
    let size = [tile; 2];
    let painter: Painter = match dice.int(0, 3) {
        0 => mosaic_skin(dice, size, &style.palette),
        1 => {
            let (seed, n) = (dice.seed(), dice.int(30, 90) as i32);
            let (base, tip) = (style.palette.main, style.palette.second);
            let strength = style.detail as f32;
            Box::new(move |u, v| {
                let hair = fractal(u * n as f32, v * n as f32 * 0.25, [n, n / 4], 3, seed);
                mix(scaled(base, 0.75 + 0.5 * hair), tip, strength * (hair - 0.55) * 3.0)
            })
        }
        _ => return style.surface(a, dice, size),
    };
    style.worn(a, dice, size, painter)
}

/// Proportions.
struct Build {
    long: f64,
    thick: f64,
    leg: f64,
    head: f64,
    neck: f64,
}

impl Build {
    fn draw(dice: &mut Dice) -> Self {
        Self {
            long: dice.range(0.06, 0.13),
            thick: dice.range(0.018, 0.038),
            leg: dice.range(0.012, 0.07),
            head: dice.range(0.014, 0.034),
            neck: dice.log_range(0.01, 0.08),
        }
    }
}

/// Where the head is and which way it looks.
struct Head {
    center: V,
    neck: V,
    r: f64,
}

fn four_legged(lumps: &mut Vec<Lump>, dice: &mut Dice, b: &Build, [fur, belly, paws]: [u32; 3]) -> Head {
    let z = b.leg + b.thick;
    let (front, back) = (v(0.0, -b.long * 0.38, z), v(0.0, b.long * 0.38, z * dice.range(0.9, 1.05)));
    lumps.push(Lump::rod(front, back, [b.thick * dice.range(0.8, 1.15), b.thick], fur));
    lumps.push(Lump::ellipsoid(
        v(0.0, 0.0, z - b.thick * 0.35),
        v(b.thick * 0.85, b.long * 0.3, b.thick * 0.8),
        belly,
    ));
    let r = b.thick * dice.range(0.28, 0.5);
    for (x, y) in [(1.0, front.y), (-1.0, front.y), (1.0, back.y), (-1.0, back.y)] {
        let hip = v(x * b.thick * 0.6, y, z - b.thick * 0.3);
        let foot = v(x * b.thick * 0.7, y + dice.around_zero(0.008), r);
        lumps.push(Lump::rod(hip, foot, [r * 1.15, r], fur));
        lumps.push(Lump::ellipsoid(foot + v(0.0, -r * 0.5, 0.0), v(r * 1.05, r * 1.5, r), paws));
    }
    tail(lumps, dice, back + v(0.0, b.thick * 0.8, b.thick * 0.2), b, fur);
    let center = front
        + v(
            0.0,
            -b.thick * 0.6 - b.neck * dice.range(0.3, 0.6),
            b.neck * dice.range(0.5, 1.0) + b.thick * 0.5,
        );
    lumps.push(Lump::rod(front, center, [b.thick * 0.7, b.head * 0.75], fur));
    Head { center, neck: front, r: b.head }
}

fn sitting(lumps: &mut Vec<Lump>, dice: &mut Dice, b: &Build, [fur, belly, paws]: [u32; 3]) -> Head {
    let tall = b.long * 0.6;
    let body = v(b.thick * 1.1, b.thick, tall * 0.5 + 0.008);
    let middle = v(0.0, 0.0, body.z);
    lumps.push(Lump::ellipsoid(middle, body, fur));
    lumps.push(Lump::ellipsoid(middle + v(0.0, -b.thick * 0.35, -0.002), body * 0.75, belly));
    let r = b.thick * dice.range(0.3, 0.45);
    for x in [1.0, -1.0] {
        let hip = v(x * b.thick * 0.8, -b.thick * 0.3, r);
        let foot = v(x * b.thick * dice.range(1.0, 1.5), -b.thick - b.leg * 0.5, r);
        lumps.push(Lump::rod(hip, foot, [r * 1.2, r], fur));
        lumps.push(Lump::ellipsoid(foot + v(0.0, -r * 0.3, r * 0.3), v(r * 1.1, r * 0.8, r * 1.3), paws));
        let shoulder = v(x * b.thick * 0.8, 0.0, tall * 0.85);
        let reach = v(
            x * (b.thick + b.leg * 0.5),
            -b.thick * dice.range(0.2, 1.2),
            tall * dice.range(0.3, 1.1) + 0.01,
        );
        lumps.push(Lump::rod(shoulder, reach, [r, r * 0.8], fur));
        lumps.push(Lump::ellipsoid(reach, V::repeat(r), paws));
    }
    tail(lumps, dice, v(0.0, b.thick * 0.9, tall * 0.25), b, fur);
    let center = v(0.0, -b.thick * 0.2, tall + 0.008 + b.head * 0.9);
    Head { center, neck: v(0.0, 0.0, tall * 0.9), r: b.head * 1.15 }
}

fn bird_or_fish(lumps: &mut Vec<Lump>, dice: &mut Dice, b: &Build, [fur, belly, paws]: [u32; 3]) -> Head {
    let lift = if dice.chance(0.5) { b.leg } else { 0.002 };
    let body = v(b.thick, b.long * 0.4, b.thick * dice.range(0.8, 1.3));
    let middle = v(0.0, 0.0, body.z + lift);
    lumps.push(Lump::ellipsoid(middle, body, fur));
    lumps.push(Lump::ellipsoid(middle - v(0.0, body.y * 0.2, body.z * 0.3), body * 0.8, belly));
    let flap = dice.range(-0.3, 0.9);
    for x in [1.0, -1.0] {
        let wing = middle + v(x * (body.x + b.thick * 0.5), 0.004, body.z * flap * 0.6);
        lumps.push(Lump::rod(middle + v(x * body.x * 0.7, 0.0, body.z * 0.2), wing, [0.008, 0.004], paws));
        lumps.push(Lump::ellipsoid(wing, v(b.thick * 0.5, body.y * 0.5, 0.005), paws));
        if lift > 0.004 {
            let foot = v(x * b.thick * 0.45, -0.004, 0.004);
            lumps.push(Lump::rod(
                middle + v(x * b.thick * 0.45, 0.0, -body.z * 0.8),
                foot,
                [0.004, 0.0035],
                paws,
            ));
            lumps.push(Lump::ellipsoid(foot + v(0.0, -0.005, 0.0), v(0.006, 0.01, 0.004), paws));
        }
    }
    let back = middle + v(0.0, body.y * 1.3, body.z * dice.range(-0.2, 0.6));
    lumps.push(Lump::rod(middle + v(0.0, body.y * 0.7, 0.0), back, [b.thick * 0.5, 0.005], fur));
    let fin = if dice.chance(0.5) { v(b.thick * 0.8, 0.012, 0.004) } else { v(0.004, 0.014, b.thick * 0.8) };
    lumps.push(Lump::ellipsoid(back, fin, paws));
    let center = middle + v(0.0, -body.y * 0.8 - b.neck * 0.2, body.z * 0.5 + b.neck * 0.4);
    lumps.push(Lump::rod(middle, center, [b.thick * 0.6, b.head * 0.7], fur));
    Head { center, neck: middle, r: b.head }
}

fn tail(lumps: &mut Vec<Lump>, dice: &mut Dice, at: V, b: &Build, fur: u32) {
    let (length, r) = (dice.log_range(0.006, b.long * 0.6), dice.range(0.003, 0.008));
    let mut from = at;
    let mut direction = v(dice.around_zero(0.3), 1.0, dice.range(-0.4, 0.9));
    for _ in 0..3 {
        let to = from + direction.normalize() * (length / 3.0);
        lumps.push(Lump::rod(from, v(to.x, to.y, to.z.max(r)), [r, r * 0.9], fur));
        from = v(to.x, to.y, to.z.max(r));
        direction += v(dice.around_zero(0.3), -0.3, 0.3);
    }
    if dice.chance(0.4) {
        lumps.push(Lump::ellipsoid(from, V::repeat(r * 1.8), fur));
    }
}

fn head_of(lumps: &mut Vec<Lump>, dice: &mut Dice, head: &Head, [fur, belly, paws]: [u32; 3]) {
    let (c, r) = (head.center, head.r);
    lumps.push(Lump::ellipsoid(c, v(r, r * dice.range(0.85, 1.2), r * dice.range(0.8, 1.0)), fur));
    let snout = dice.range(0.3, 1.4) * r;
    let end = c + v(0.0, -r * 0.7 - snout, -r * dice.range(0.1, 0.4));
    lumps.push(Lump::rod(c + v(0.0, -r * 0.5, -r * 0.2), end, [r * 0.5, r * dice.range(0.2, 0.5)], belly));
    let (kind, tall) = (dice.int(0, 3), dice.range(0.5, 1.8) * r);
    for x in [1.0, -1.0] {
        let base = c + v(x * r * 0.6, 0.0, r * 0.65);
        match kind {
            0 => lumps.push(Lump::ellipsoid(
                c + v(x * r * 0.85, 0.0, r * 0.75),
                v(r * 0.4, r * 0.2, r * 0.4),
                paws,
            )),
            1 => lumps.push(Lump::rod(base, base + v(x * tall * 0.2, 0.0, tall), [r * 0.28, r * 0.1], paws)),
            2 => lumps.push(Lump::rod(
                base,
                base + v(x * tall * 0.7, 0.0, -tall * 0.5),
                [r * 0.25, r * 0.3],
                paws,
            )),
            _ => lumps.push(Lump::rod(
                base,
                base + v(x * tall * 0.6, 0.0, tall * 0.8),
                [r * 0.12, r * 0.06],
                paws,
            )),
        }
    }
}

fn face(a: &mut Assembly, dice: &mut Dice, style: &Style, head: &Head) {
    let white = dice.chance(0.5);
    let iris = style.palette.accent;
    let eye = a.paint(
        (128, 128),
        Box::new(move |_, v| match v {
            v if v < 0.18 => [0.03; 3],
            v if v < 0.32 && white => iris,
            _ if white => [0.95; 3],
            _ => [0.05; 3],
        }),
    );
    let size = head.r * dice.range(0.13, 0.26);
    for x in [1.0, -1.0] {
        let at = head.center + v(x * head.r * 0.5, -head.r * 0.82, head.r * 0.3);
        let frame = a.at.along(at, v(x * 0.35, -1.0, 0.15));
        a.within(frame, |a| a.ellipsoid(V::zeros(), V::repeat(size), 14, eye));
    }
}
