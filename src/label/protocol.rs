//! What a label is made of: sizes, view sets, test views and the label camera.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sha2::{Digest, Sha256};

use crate::geometry::{Direction, Vector};
use crate::imaging::Camera;
use crate::views::{Band, ViewsError, tammes};

/// Distance of every view from the object's centre, metres (paper, section "Dataset Generation").
pub const VIEW_RADIUS_M: f64 = 0.3;
/// Smallest radius of the sphere around a labelled object, metres (same section).
pub const MIN_OBJECT_RADIUS_M: f64 = 0.07;
/// Largest radius of the sphere around a labelled object, metres (same section).
pub const MAX_OBJECT_RADIUS_M: f64 = 0.12;
/// The gradient threshold of the paper, dB per view.
pub const PAPER_ALPHA_DB: f64 = 0.02;
/// Views of the NeRF that stands for "as good as it gets".
pub const CEILING_VIEWS: usize = 100;
/// Novel views on which every NeRF is judged.
pub const TEST_VIEWS: usize = 100;
/// Side of a label image, pixels.
pub const IMAGE_SIZE_PX: u32 = 128;
/// Least share of a camera frame's pixels that the object must cover on average over the five
/// initial views, and how often another size is drawn for it (the authors' system).
pub const MIN_COVERAGE: f64 = 0.035;
/// Sizes drawn at most.
pub const SIZE_DRAWS: usize = 5;

/// The view counts of the curve: 3, 5, ..., 49, then [`CEILING_VIEWS`].
pub fn view_counts() -> Vec<usize> {
    (3..50).step_by(2).chain([CEILING_VIEWS]).collect()
}

/// The camera of label images: square, no distortion, and wide enough that the
/// largest object (a 0.12 m sphere at 0.3 m spans a tangent of 0.436) is seen whole.
pub fn label_camera() -> Camera {
    Camera::square(IMAGE_SIZE_PX, 0.45)
}

/// A 64-bit seed out of an object's key and the run's seed, the same on every machine.
pub fn seed_of(key: &str, run_seed: u64) -> u64 {
    let digest = Sha256::new().chain_update(run_seed.to_le_bytes()).chain_update(key.as_bytes()).finalize();
    digest.iter().take(8).fold(0, |seed, byte| (seed << 8) | u64::from(*byte))
}

/// The radii to try for an object, metres; the first that covers enough pixels is taken.
pub fn radius_draws(seed: u64) -> [f64; SIZE_DRAWS] {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    std::array::from_fn(|_| rng.random_range(MIN_OBJECT_RADIUS_M..MAX_OBJECT_RADIUS_M))
}

/// The novel test directions: the service's set of 101 views less its top view (which
/// every training set contains), turned about the vertical by a random angle.
///
/// # Errors
/// [`ViewsError`] when the set cannot be made.
pub fn test_directions(seed: u64) -> Result<Vec<Direction>, ViewsError> {
    let turn_rad = ChaCha8Rng::seed_from_u64(seed ^ 0x7e57).random_range(0.0..std::f64::consts::TAU);
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector::z_axis(), turn_rad);
    Ok(tammes(TEST_VIEWS + 1, Band::DEFAULT)?.directions.iter().skip(1).map(|d| turn * d).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_has_24_points_and_a_ceiling() {
        let counts = view_counts();
        assert_eq!(counts.len(), 25);
        assert_eq!((counts[0], counts[23], counts[24]), (3, 49, 100));
    }

    #[test]
    fn seeds_differ_by_object_and_by_run_and_are_stable() {
        assert_eq!(seed_of("chair", 0), seed_of("chair", 0));
        assert_ne!(seed_of("chair", 0), seed_of("chair", 1));
        assert_ne!(seed_of("chair", 0), seed_of("table", 0));
    }

    #[test]
    fn the_largest_object_fits_the_label_camera() {
        let widest = (MAX_OBJECT_RADIUS_M / VIEW_RADIUS_M).asin().tan();
        let camera = label_camera();
        assert!(widest < camera.cx / camera.fx);
    }

    #[test]
    fn test_views_are_novel() {
        let tests = test_directions(7).unwrap();
        assert_eq!(tests.len(), TEST_VIEWS);
        assert!(tests.iter().all(|d| d.z < 0.9999));
    }
}
