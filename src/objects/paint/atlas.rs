//! Several textures in one.

use super::Painter;

/// Three by two textures: front, right, back above left, top, bottom; as [`crate::objects::shape::ATLAS`].
pub(in crate::objects) fn atlas(faces: [Painter; 6]) -> Painter {
    Box::new(move |u, v| {
        let (column, row) = ((u * 3.0).floor().clamp(0.0, 2.0), (v * 2.0).floor().clamp(0.0, 1.0));
        let face = &faces[(row * 3.0 + column) as usize];
        face(u * 3.0 - column, v * 2.0 - row)
    })
}

/// Textures one below the other; each with the v at which it ends.
pub(in crate::objects) fn bands(mut parts: Vec<(f64, Painter)>) -> Painter {
    parts.sort_by(|a, b| a.0.total_cmp(&b.0));
    Box::new(move |u, v| {
        let mut from = 0.0;
        for (to, painter) in &parts {
            let to = *to as f32;
            if v < to {
                return painter(u, (v - from) / (to - from).max(1e-6));
            }
            from = to;
        }
        parts.last().map_or([0.5; 3], |(_, painter)| painter(u, 1.0))
    })
}
