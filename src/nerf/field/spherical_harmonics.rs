//! Real spherical harmonics up to degree two.

/// Number of harmonics.
pub(in crate::nerf) const HARMONICS: usize = 9;

/// The nine harmonics at the unit vector `[x, y, z]`, orthonormal on the sphere.
pub(in crate::nerf) fn spherical_harmonics([x, y, z]: [f32; 3]) -> [f32; HARMONICS] {
    [
        0.282_094_8,
        0.488_602_5 * y,
        0.488_602_5 * z,
        0.488_602_5 * x,
        1.092_548_4 * x * y,
        1.092_548_4 * y * z,
        0.315_391_57 * (3.0 * z * z - 1.0),
        1.092_548_4 * x * z,
        0.546_274_2 * (x * x - y * y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_harmonics_are_orthonormal_on_the_sphere() {
        let mut products = [[0.0f64; HARMONICS]; HARMONICS];
        let (rings, sectors) = (200, 200);
        for ring in 0..rings {
            let z = (f64::from(ring) + 0.5) / f64::from(rings) * 2.0 - 1.0;
            for sector in 0..sectors {
                let (sin, cos) = (f64::from(sector) / f64::from(sectors) * std::f64::consts::TAU).sin_cos();
                let r = (1.0 - z * z).sqrt();
                let y = spherical_harmonics([(r * cos) as f32, (r * sin) as f32, z as f32]).map(f64::from);
                for i in 0..HARMONICS {
                    for j in 0..HARMONICS {
                        products[i][j] +=
                            y[i] * y[j] * 4.0 * std::f64::consts::PI / f64::from(rings * sectors);
                    }
                }
            }
        }
        for (i, row) in products.iter().enumerate() {
            for (j, product) in row.iter().enumerate() {
                let expected = f64::from(u8::from(i == j));
                assert!((product - expected).abs() < 1e-3, "<Y{i}, Y{j}> = {product}");
            }
        }
    }
}
