//! Flat outlines, anticlockwise, about the origin.

use crate::objects::exact::{cos_turns, power, sin_turns};

/// A flat outline.
pub(in crate::objects) type Outline = Vec<[f64; 2]>;

/// An ellipse.
pub(in crate::objects) fn circle(half: [f64; 2], count: usize) -> Outline {
    superellipse(half, 1.0, count)
}

/// Between an ellipse (`squareness` 1) and a rectangle (towards 0).
pub(in crate::objects) fn superellipse(half: [f64; 2], squareness: f64, count: usize) -> Outline {
    let signed = |x: f64| power(x.abs(), squareness) * if x < 0.0 { -1.0 } else { 1.0 };
    (0..count)
        .map(|i| {
            let t = i as f64 / count as f64;
            [half[0] * signed(cos_turns(t)), half[1] * signed(sin_turns(t))]
        })
        .collect()
}

/// A rectangle with round corners of `steps` cells each.
pub(in crate::objects) fn rounded_rectangle(half: [f64; 2], radius: f64, steps: usize) -> Outline {
    let radius = radius.min(half[0].min(half[1]) * 0.999);
    let mut outline = Vec::with_capacity(4 * (steps + 1));
    for (corner, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].into_iter().enumerate() {
        for k in 0..=steps {
            let t = 0.25 * (corner as f64 + k as f64 / steps.max(1) as f64);
            outline.push([
                x * (half[0] - radius) + radius * cos_turns(t),
                y * (half[1] - radius) + radius * sin_turns(t),
            ]);
        }
    }
    outline
}

/// A star: `points` tips at `outer`, notches at `inner`.
pub(in crate::objects) fn star(outer: f64, inner: f64, points: usize) -> Outline {
    (0..2 * points)
        .map(|i| {
            let (r, t) = (if i % 2 == 0 { outer } else { inner }, i as f64 / (2 * points) as f64);
            [r * cos_turns(t), r * sin_turns(t)]
        })
        .collect()
}

/// A toothed wheel.
pub(in crate::objects) fn gear(outer: f64, inner: f64, teeth: usize) -> Outline {
    const TOOTH: [(f64, bool); 4] = [(0.0, false), (0.3, false), (0.42, true), (0.78, true)];
    (0..teeth)
        .flat_map(|i| {
            TOOTH.map(|(at, out)| {
                let (r, t) = (if out { outer } else { inner }, (i as f64 + at) / teeth as f64);
                [r * cos_turns(t), r * sin_turns(t)]
            })
        })
        .collect()
}

/// Twice the area; positive for anticlockwise outlines.
pub(in crate::objects) fn doubled_area(outline: &[[f64; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

/// The outline moved inwards by `by`, point by point; for `by` small against its features.
pub(in crate::objects) fn inset(outline: &[[f64; 2]], by: f64) -> Outline {
    let n = outline.len();
    let unit = |a: [f64; 2], b: [f64; 2]| {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = (x * x + y * y).sqrt().max(1e-12);
        [x / length, y / length]
    };
    (0..n)
        .map(|i| {
            let (before, here, after) = (outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]);
            let (a, b) = (unit(before, here), unit(here, after));
            // Along the mean of both sides' inner normals, farther where the corner is sharper.
            let normal = [-(a[1] + b[1]), a[0] + b[0]];
            let squared = normal[0] * normal[0] + normal[1] * normal[1];
            let scale = 2.0 * by / squared.max(1.0);
            [here[0] + normal[0] * scale, here[1] + normal[1] * scale]
        })
        .collect()
}
