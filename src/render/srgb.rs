//! The sRGB transfer curve (IEC 61966-2-1), both ways.

use std::sync::LazyLock;

/// Linear value of an sRGB value; both 0 to 1.
pub(super) fn to_linear(value: f32) -> f32 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// sRGB value of a linear value; both 0 to 1.
pub(super) fn from_linear(value: f32) -> f32 {
    if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// Linear values of the 256 sRGB bytes.
pub(super) static LINEAR_OF_BYTE: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| to_linear(i as f32 / 255.0)));

const STEPS: usize = 4096;

/// sRGB bytes of linear values: fine enough that neighbours differ by less than one byte.
static BYTE_OF_LINEAR: LazyLock<[u8; STEPS]> = LazyLock::new(|| {
    std::array::from_fn(|i| (from_linear(i as f32 / (STEPS - 1) as f32) * 255.0 + 0.5) as u8)
});

/// sRGB byte of a linear value, clamped to 0..1 (NaN becomes 0).
pub(super) fn byte_of_linear(value: f32) -> u8 {
    // The cast saturates, so no index is out of range.
    let i = (value.clamp(0.0, 1.0) * (STEPS - 1) as f32 + 0.5) as usize;
    BYTE_OF_LINEAR[i.min(STEPS - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_way_to_linear_and_back() {
        for byte in 0..=255u8 {
            assert_eq!(byte_of_linear(LINEAR_OF_BYTE[usize::from(byte)]), byte);
        }
        assert_eq!([byte_of_linear(f32::NAN), byte_of_linear(-3.0), byte_of_linear(9.0)], [0, 0, 255]);
    }
}
