//! Colours.

/// sRGB, 0 to 1.
pub(in crate::objects) type Color = [f32; 3];

/// From `a` to `b` for `t` from 0 to 1.
pub(in crate::objects) fn mix(a: Color, b: Color, t: f32) -> Color {
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

/// Brighter or darker.
pub(in crate::objects) fn scaled(c: Color, by: f32) -> Color {
    c.map(|v| v * by)
}

/// By hue (0 to 1, repeating), saturation and value.
pub(in crate::objects) fn of_hue(hue: f64, saturation: f64, value: f64) -> Color {
    let channel = |n: f64| {
        let k = (n + hue * 6.0).rem_euclid(6.0);
        (value * (1.0 - saturation * k.min(4.0 - k).clamp(0.0, 1.0))) as f32
    };
    [channel(5.0), channel(3.0), channel(1.0)]
}
