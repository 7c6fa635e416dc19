//! Noise that repeats in both directions.

/// A hash of a lattice point.
pub(super) fn hash(x: i32, y: i32, seed: u32) -> u32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1)
        ^ (y as u32).wrapping_mul(0x85eb_ca77)
        ^ seed.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

/// A number in 0..1 for a lattice point.
pub(in crate::objects) fn unit(x: i32, y: i32, seed: u32) -> f32 {
    (hash(x, y, seed) >> 8) as f32 / (1 << 24) as f32
}

/// Smooth noise in 0..1 with features of size 1 that repeats after `period`.
pub(in crate::objects) fn smooth(x: f32, y: f32, period: [i32; 2], seed: u32) -> f32 {
    let (ix, iy) = (x.floor(), y.floor());
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (fx, fy) = (ease(x - ix), ease(y - iy));
    let wrapped = |i: f32, d: i32, period: i32| (i as i32 + d).rem_euclid(period.max(1));
    let (x0, x1) = (wrapped(ix, 0, period[0]), wrapped(ix, 1, period[0]));
    let (y0, y1) = (wrapped(iy, 0, period[1]), wrapped(iy, 1, period[1]));
    let between = |a: f32, b: f32, t: f32| a + (b - a) * t;
    between(
        between(unit(x0, y0, seed), unit(x1, y0, seed), fx),
        between(unit(x0, y1, seed), unit(x1, y1, seed), fx),
        fy,
    )
}

/// `octaves` of [`smooth`], each twice as fine, mean one half.
pub(in crate::objects) fn fractal(x: f32, y: f32, period: [i32; 2], octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut whole, mut scale, mut amplitude) = (0.0, 0.0, 1, 0.5);
    for octave in 0..octaves.max(1) {
        let s = scale as f32;
        sum += amplitude * smooth(x * s, y * s, period.map(|p| p.saturating_mul(scale)), seed + octave);
        whole += amplitude;
        scale *= 2;
        amplitude *= 0.5;
    }
    sum / whole
}

/// What cellular noise knows about a place.
#[derive(Clone, Copy, Debug)]
pub(in crate::objects) struct Cell {
    /// Distance to the nearest cell's point.
    pub(in crate::objects) near: f32,
    /// How much farther the second nearest is: 0 on the border between two cells.
    pub(in crate::objects) border: f32,
    /// From the nearest cell's point to here.
    pub(in crate::objects) from_point: [f32; 2],
    /// A number of the nearest cell.
    pub(in crate::objects) id: u32,
}

/// Cellular noise: one point in each unit square, moved from its middle by up to `jitter` / 2; repeats after
/// `period`.
pub(in crate::objects) fn cells(x: f32, y: f32, period: [i32; 2], jitter: f32, seed: u32) -> Cell {
    let (ix, iy) = (x.floor(), y.floor());
    let mut best = Cell { near: f32::MAX, border: 0.0, from_point: [0.0; 2], id: 0 };
    let mut second = f32::MAX;
    for dy in -1..=1 {
        for dx in -1..=1 {
            let (cx, cy) = (ix as i32 + dx, iy as i32 + dy);
            let (wx, wy) = (cx.rem_euclid(period[0].max(1)), cy.rem_euclid(period[1].max(1)));
            let (jx, jy) = (unit(wx, wy, seed) - 0.5, unit(wx, wy, seed ^ 0x5bd1) - 0.5);
            let d = [x - (cx as f32 + 0.5 + jitter * jx), y - (cy as f32 + 0.5 + jitter * jy)];
            let squared = d[0] * d[0] + d[1] * d[1];
            if squared < best.near {
                second = best.near;
                best = Cell { near: squared, from_point: d, id: hash(wx, wy, seed ^ 0x77), ..best };
            } else if squared < second {
                second = squared;
            }
        }
    }
    let near = best.near.sqrt();
    Cell { near, border: second.sqrt() - near, ..best }
}
