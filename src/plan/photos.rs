//! Where photos are expected from, and whether they came from there.

use super::{ExpectedView, PlanError, PlanRequest, ViewSource, Warning};
use crate::geometry::{Pose, Vector};
use crate::views::{ViewSpace, initial_views_five};

/// Most photos of one prediction.
pub const MAX_PHOTOS: usize = crate::predict::MAX_IMAGES;

/// Directions may differ by this much from the expected ones, degrees.
const DIRECTION_TOLERANCE_DEG: f64 = 5.0;
/// Distances from the object's centre may differ by this share.
const DISTANCE_TOLERANCE: f64 = 0.1;

/// The poses of the first `count` initial views (top, left, front, right, back) in `space`.
pub fn expected_views(space: &ViewSpace, count: usize) -> Vec<ExpectedView> {
    initial_views_five()
        .iter()
        .take(count)
        .map(|view| ExpectedView { name: view.name, pose: space.pose(&view.direction, 0.0) })
        .collect()
}

/// Checks the photos' sizes and poses against what is expected.
pub(super) fn check(request: &PlanRequest) -> Result<Vec<Warning>, PlanError> {
    let ViewSource::Photos(images) = &request.source else {
        return match request.photo_poses {
            Some(_) => {
                Ok(vec![Warning::new("unused_image_poses", "image_poses without images are not used")])
            }
            None => Ok(Vec::new()),
        };
    };
    let camera = request.camera();
    for (index, image) in images.iter().enumerate() {
        if image.dimensions() != (camera.width, camera.height) {
            return Err(PlanError::Invalid {
                code: "image_size",
                field: format!("images[{index}]"),
                value: super::FieldValue::Text(format!("{}x{} pixels", image.width(), image.height())),
                bound: match request.camera {
                    Some(_) => format!(
                        "{}x{} pixels as camera.width and camera.height say",
                        camera.width, camera.height
                    ),
                    None => format!(
                        "{}x{} pixels, as of the RealSense D435 that is assumed where no camera is given; give camera",
                        camera.width, camera.height
                    ),
                },
            });
        }
    }
    match &request.photo_poses {
        None => Ok(Vec::new()),
        Some(poses) if poses.len() != images.len() => Err(PlanError::number(
            "image_pose_count",
            "image_poses",
            poses.len() as f64,
            format!("one pose an image, {}", images.len()),
        )),
        Some(poses) => Ok(compare(poses, &request.view_space())),
    }
}

/// One warning for each photo that was taken from elsewhere. The order of photos does not matter.
fn compare(poses: &[Pose], space: &ViewSpace) -> Vec<Warning> {
    let mut free = expected_views(space, poses.len());
    let mut warnings = Vec::new();
    for (index, pose) in poses.iter().enumerate() {
        let offset = pose.translation.vector - space.center_in_base.coords;
        let angle_to = |view: &ExpectedView| {
            let expected = view.pose.translation.vector - space.center_in_base.coords;
            offset.angle(&expected).to_degrees()
        };
        let nearest = free
            .iter()
            .enumerate()
            .min_by(|(_, a), (_, b)| angle_to(a).total_cmp(&angle_to(b)))
            .map(|(i, _)| i);
        let Some(nearest) = nearest else { break };
        let view = free.swap_remove(nearest);
        let direction_deg = angle_to(&view);
        let aim_deg = (pose.rotation * Vector::z()).angle(&-offset).to_degrees();
        let distance_m = offset.norm();
        let off = [
            (direction_deg > DIRECTION_TOLERANCE_DEG)
                .then(|| format!("{direction_deg:.1} deg from the expected direction")),
            (aim_deg > DIRECTION_TOLERANCE_DEG)
                .then(|| format!("looks {aim_deg:.1} deg past the object's centre")),
            ((distance_m / space.radius_m - 1.0).abs() > DISTANCE_TOLERANCE)
                .then(|| format!("at {distance_m:.3} m instead of {:.3} m from its centre", space.radius_m)),
        ];
        let off: Vec<String> = off.into_iter().flatten().collect();
        if !off.is_empty() {
            warnings.push(Warning::new(
                "unexpected_image_pose",
                format!(
                    "images[{index}] differs from the expected view \"{}\": {}",
                    view.name,
                    off.join(", ")
                ),
            ));
        }
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, look_at};
    use crate::views::Band;

    fn space() -> ViewSpace {
        ViewSpace { center_in_base: Point::new(0.4, 0.1, 0.1), radius_m: 0.3, band: Band::DEFAULT }
    }

    #[test]
    fn the_expected_poses_in_any_order_and_roll_give_no_warning() {
        let mut poses: Vec<Pose> = expected_views(&space(), 3).into_iter().map(|view| view.pose).collect();
        poses.reverse();
        poses[0].append_rotation_wrt_center_mut(&nalgebra::UnitQuaternion::identity());
        assert!(compare(&poses, &space()).is_empty());
    }

    #[test]
    fn a_photo_from_elsewhere_is_named_with_its_angle_and_distance() {
        let mut poses: Vec<Pose> = expected_views(&space(), 3).into_iter().map(|view| view.pose).collect();
        poses[1] = look_at(&Point::new(0.4, 0.6, 0.1), &space().center_in_base, 0.0);
        let warnings = compare(&poses, &space());
        assert_eq!(warnings.len(), 1);
        let text = &warnings[0].message;
        assert!(
            text.contains("images[1]") && text.contains("\"left\"") && text.contains("0.500 m"),
            "{text}"
        );
    }
}
