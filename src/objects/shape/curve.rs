//! Smooth curves from few points.

use crate::objects::frame::V;

/// Rounds a polyline: each inner corner is cut `times` times (Chaikin), the ends stay.
pub(in crate::objects) fn rounded(points: &[[f64; 2]], times: u32) -> Vec<[f64; 2]> {
    let mut points = points.to_vec();
    for _ in 0..times {
        let mut next = Vec::with_capacity(points.len() * 2);
        next.extend(points.first());
        for pair in points.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let mix = |t: f64| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
            next.extend([mix(0.25), mix(0.75)]);
        }
        next.extend(points.last());
        points = next;
    }
    points
}

/// `count` points of the Catmull-Rom curve through `knots`, ends included.
pub(in crate::objects) fn path_through(knots: &[V], count: usize) -> Vec<V> {
    let spans = knots.len().saturating_sub(1);
    if spans == 0 {
        return knots.to_vec();
    }
    let knot = |i: isize| knots[i.clamp(0, spans as isize) as usize];
    (0..count)
        .map(|k| {
            let at = k as f64 / (count - 1).max(1) as f64 * spans as f64;
            let i = (at as usize).min(spans - 1) as isize;
            let t = at - i as f64;
            let (p, q, r, s) = (knot(i - 1), knot(i), knot(i + 1), knot(i + 2));
            q + (r - p) * (0.5 * t)
                + (p * 2.0 - q * 5.0 + r * 4.0 - s) * (0.5 * t * t)
                + (q * 3.0 - p - r * 3.0 + s) * (0.5 * t * t * t)
        })
        .collect()
}
