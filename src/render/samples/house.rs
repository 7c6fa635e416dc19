//! A small brick house with a tiled roof.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::build::{Builder, WHOLE};
use super::noise;
use super::paint::{any_hue, mix, painted, scaled, wood};
use crate::render::Mesh;

pub(super) fn make(rng: &mut ChaCha8Rng) -> Mesh {
    let seed: u32 = rng.random();
    let (door, tile) = (any_hue(rng, 0.7, 0.55), any_hue(rng, 0.5, 0.6));
    let mut b = Builder::new();
    let brick = move |x: f32, y: f32| {
        let row = (y * 22.0).floor();
        let bx = x * 12.0 + 0.5 * (row % 2.0);
        let mortar = bx.fract() < 0.07 || (y * 22.0).fract() < 0.14;
        let grain = 0.85 + 0.3 * noise::smooth(x * 120.0, y * 120.0, 4096, seed);
        let shade = noise::cell(bx, row, seed + 1);
        scaled(
            if mortar { [0.78, 0.75, 0.7] } else { mix([0.55, 0.22, 0.15], [0.78, 0.42, 0.28], shade) },
            grain,
        )
    };
    // Four walls side by side: front with a door, the others with windows.
    let walls = b.material(painted("walls", (2048, 512), move |u, v| {
        let (wall, x) = ((u * 4.0) as u32, (u * 4.0).fract());
        let window = |cx: f32, cy: f32| {
            let (dx, dy) = ((x - cx).abs() / 0.1, (v - cy).abs() / 0.17);
            let far = dx.max(dy);
            (far < 1.0).then(|| {
                let sash = far > 0.84 || dx < 0.07 || dy < 0.05;
                if sash {
                    [0.95; 3]
                } else {
                    mix([0.25, 0.4, 0.55], [0.75, 0.85, 0.92], (x * 3.0 - v * 2.0).fract().abs())
                }
            })
        };
        if v > 0.93 {
            return scaled([0.5, 0.5, 0.48], 0.6 + 0.6 * noise::fractal(u * 60.0, v * 20.0, 60, seed + 2));
        }
        let opening = match wall {
            0 if (x - 0.5).abs() < 0.11 && v > 0.38 => {
                let panel = ((x - 0.39) * 9.1).fract().min((v * 5.0).fract()) > 0.15;
                let knob = (x - 0.57).hypot((v - 0.68) * 0.7) < 0.013;
                Some(if knob {
                    [0.9, 0.75, 0.3]
                } else if panel {
                    door
                } else {
                    scaled(door, 0.6)
                })
            }
            0 => window(0.2, 0.5).or_else(|| window(0.8, 0.5)),
            1 => window(0.5, 0.45),
            2 => window(0.28, 0.5).or_else(|| window(0.5, 0.5)).or_else(|| window(0.72, 0.5)),
            _ => window(0.3, 0.4).or_else(|| window(0.7, 0.6)),
        };
        opening.unwrap_or_else(|| brick(u * 2.0, v * 0.75))
    }));
    let part = |i: usize| [i as f32 / 4.0, 0.0, (i + 1) as f32 / 4.0, 1.0];
    b.cuboid(
        [-0.06, -0.04, 0.0],
        [0.06, 0.04, 0.065],
        [part(0), part(1), part(2), part(3), part(3), part(3)],
        walls,
    );
    let bricks = b.material(painted("bricks", (512, 512), brick));
    let roof = b.material(painted("roof", (1024, 1024), |u, v| {
        let row = (v * 14.0).floor();
        let tx = u * 18.0 + 0.5 * (row % 2.0);
        let (x, y) = (tx.fract() - 0.5, (v * 14.0).fract());
        let rounded = y > 1.0 - 0.5 * x * x * 2.0;
        let moss = noise::fractal(u * 9.0, v * 9.0, 9, seed + 3);
        let c = mix(
            scaled(tile, 0.6 + 0.6 * noise::cell(tx, row, seed + 4)),
            [0.3, 0.4, 0.2],
            (moss - 0.6) * 4.0,
        );
        scaled(c, if rounded { 0.35 } else { 0.55 + 0.5 * y })
    }));
    let boards = b.material(painted("boards", (512, 512), |u, v| {
        if (u * 10.0).fract() < 0.06 { [0.2, 0.12, 0.07] } else { wood(u, v, seed + 5) }
    }));
    // Roof: two slopes with an overhang, each a thin slab.
    let (ridge, eave, over) = (0.112f32, 0.058f32, 0.068f32);
    for side in [-1.0f32, 1.0] {
        for (lift, material) in [(0.0, boards), (0.004, roof)] {
            b.grid((24, 16), WHOLE, material, |i, j| {
                let (s, t) = (i as f32 / 24.0, j as f32 / 16.0);
                let sag = 0.003 * (s * std::f32::consts::PI).sin() * t;
                [side * (s * 2.0 - 1.0) * -over, side * t * 0.053, ridge + lift + (eave - ridge) * t - sag]
            });
        }
        // Gable and the slab's rim.
        b.grid((8, 8), WHOLE, boards, |i, j| {
            let (s, t) = (i as f32 / 8.0 * 2.0 - 1.0, j as f32 / 8.0);
            [side * 0.06, s * 0.04 * t, 0.108 - 0.043 * t]
        });
        b.grid((24, 1), [0.0, 0.0, 1.0, 0.1], boards, |i, j| {
            [(i as f32 / 24.0 * 2.0 - 1.0) * over, side * 0.053, eave + 0.004 * (1 - j) as f32 - 0.0002]
        });
        b.grid((16, 1), [0.0, 0.0, 1.0, 0.1], boards, |i, j| {
            let t = i as f32 / 16.0 * 2.0 - 1.0;
            [side * over, t * 0.053, ridge + (eave - ridge) * t.abs() + 0.004 * (1 - j) as f32]
        });
    }
    b.cuboid([0.022, 0.008, 0.085], [0.036, 0.022, 0.132], [[0.0, 0.0, 0.4, 1.0]; 6], bricks);
    b.finish()
}
