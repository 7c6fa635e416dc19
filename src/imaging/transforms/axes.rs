//! Between our poses and the matrices of the file.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use crate::geometry::{Pose, Vector};

/// How far a matrix may be from a rotation, entry by entry.
const ROTATION_TOLERANCE: f64 = 1e-2;

/// Camera-to-world with OpenGL axes, four rows.
pub(super) fn matrix_of(world_from_camera: &Pose) -> Vec<Vec<f64>> {
    let m = world_from_camera.to_homogeneous();
    (0..4).map(|r| vec![m[(r, 0)], -m[(r, 1)], -m[(r, 2)], m[(r, 3)]]).collect()
}

/// The pose with OpenCV axes, or what is wrong with the matrix. Three or four rows
/// of four numbers; a rotation that is off by rounding is put right.
pub(super) fn pose_of(rows: &[Vec<f64>]) -> Result<Pose, String> {
    if !(3..=4).contains(&rows.len()) || rows.iter().any(|row| row.len() != 4) {
        let widths: Vec<usize> = rows.iter().map(Vec::len).collect();
        return Err(format!("has {} rows of {widths:?} numbers, must be 4 x 4", rows.len()));
    }
    let m = Matrix3::from_fn(|r, c| if c == 0 { rows[r][c] } else { -rows[r][c] });
    let t = Vector::new(rows[0][3], rows[1][3], rows[2][3]);
    if !m.iter().chain(t.iter()).all(|x| x.abs() < 1e6) {
        return Err("has a number that is not finite and less than 1e6 in size".to_owned());
    }
    let off = (m * m.transpose() - Matrix3::identity()).abs().max();
    if off > ROTATION_TOLERANCE || m.determinant() < 0.0 {
        return Err(format!(
            "is no rotation: off from orthonormal by {off:.2e} (at most {ROTATION_TOLERANCE}), determinant {:.3} (must be 1)",
            m.determinant()
        ));
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_eps(
        &m,
        1e-12,
        100,
        Rotation3::from_matrix_unchecked(m),
    ));
    Ok(Pose::from_parts(Translation3::from(t), rotation))
}
