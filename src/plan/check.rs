//! Bounds of a request's numbers, and the usual mistakes behind values outside them.

use super::bounds::{FARTHEST_M, OBJECT_RADIUS_M, SHELL_RADIUS_M};
use super::{
    Arm, ObjectSphere, PlanError, PlanRequest, UnreachableViews, ViewSource, Warning, hand_eye, photos,
    surroundings, work_bound,
};
use crate::views::{Band, MAX_VIEWS};

/// The shell's radius over the object's: a camera closer than that is in the object.
const SHELL_OVER_OBJECT: f64 = 1.05;

/// Checks every number of `request` and collects what is suspicious but possible.
///
/// # Errors
/// The first member that is out of its bound, in the order of the request's documentation.
pub fn check(request: &PlanRequest) -> Result<Vec<Warning>, PlanError> {
    let mut warnings = Vec::new();
    match request.camera {
        Some(camera) => camera.check()?,
        None => warnings.push(Warning::new(
            "default_camera",
            "no camera given: a RealSense D435's colour camera (1280x720, fx 915.607) is assumed",
        )),
    }
    check_source(&request.source)?;
    match &request.object {
        Some(object) => check_object(object)?,
        None if request.arm.is_some() || matches!(request.source, ViewSource::Photos(_)) => {
            return Err(PlanError::missing("object", "given with a robot or with images"));
        }
        None => warnings.push(Warning::new(
            "default_object",
            "no object given: a sphere of 0.1 m at the origin without table is assumed",
        )),
    }
    check_shell(request)?;
    let (band, usual) = (request.shell.band, Band::DEFAULT);
    // Up to the rounding of degrees.
    let is_usual = (band.min_elevation_rad - usual.min_elevation_rad).abs() < 1e-9
        && (band.max_elevation_rad - usual.max_elevation_rad).abs() < 1e-9;
    if matches!(request.source, ViewSource::Initial { .. }) && !is_usual {
        warnings.push(Warning::new(
            "unused_band",
            "the initial views have elevations of their own: those of view_space are not used",
        ));
    }
    let skips = request.arm.as_ref().is_some_and(|arm| arm.unreachable_views == UnreachableViews::Skip);
    if matches!(request.source, ViewSource::Initial { .. }) && skips {
        warnings.push(Warning::new(
            "unused_unreachable_views",
            "the initial views are never replaced: unreachable_views is not used",
        ));
    }
    warnings.extend(photos::check(request)?);
    if let Some(arm) = &request.arm {
        warnings.extend(check_arm(arm)?);
        warnings.extend(surroundings::check(request, arm)?);
        work_bound::check(request, arm)?;
    }
    Ok(warnings)
}

fn check_source(source: &ViewSource) -> Result<(), PlanError> {
    match source {
        ViewSource::Count(count) if !(1..=MAX_VIEWS).contains(count) => Err(PlanError::number(
            "out_of_range",
            "view_count",
            *count as f64,
            format!("from 1 to {MAX_VIEWS}"),
        )),
        ViewSource::Photos(images) if !(1..=photos::MAX_PHOTOS).contains(&images.len()) => {
            Err(PlanError::number(
                "image_count",
                "images",
                images.len() as f64,
                format!("1 to {} images", photos::MAX_PHOTOS),
            ))
        }
        _ => Ok(()),
    }
}

fn check_object(object: &ObjectSphere) -> Result<(), PlanError> {
    for (axis, value) in object.center_in_base.iter().enumerate() {
        length(&format!("object.center[{axis}]"), *value, -FARTHEST_M, FARTHEST_M)?;
    }
    length("object.radius", object.radius_m, OBJECT_RADIUS_M.0, OBJECT_RADIUS_M.1)?;
    surroundings::check_shape(&object.shape, object.radius_m)?;
    let Some(table_z_m) = object.table_z_m else { return Ok(()) };
    length("object.table_z", table_z_m, -FARTHEST_M, FARTHEST_M)?;
    if object.center_in_base.z < table_z_m {
        return Err(PlanError::number(
            "object_below_table",
            "object.center[2]",
            object.center_in_base.z,
            format!("at least object.table_z, {table_z_m} m"),
        ));
    }
    Ok(())
}

fn check_shell(request: &PlanRequest) -> Result<(), PlanError> {
    request.shell.band.validate()?;
    let radius_m = request.shell.radius_m;
    length("view_space.radius", radius_m, SHELL_RADIUS_M.0, SHELL_RADIUS_M.1)?;
    let least_m = SHELL_OVER_OBJECT * request.object().radius_m;
    if radius_m < least_m {
        return Err(PlanError::number(
            "camera_inside_object",
            "view_space.radius",
            radius_m,
            format!("at least {SHELL_OVER_OBJECT} times object.radius, {least_m} m"),
        ));
    }
    Ok(())
}

fn check_arm(arm: &Arm) -> Result<Vec<Warning>, PlanError> {
    let mut warnings: Vec<Warning> = arm
        .model
        .warnings
        .iter()
        .map(|warning| Warning::new(warning.code, warning.message.clone()))
        .collect();
    match &arm.flange_from_camera {
        Some(pose) => warnings.extend(hand_eye::check(pose)?),
        None => warnings.push(Warning::new(
            "default_hand_eye",
            "no flange_from_camera given: the camera is assumed 0.05 m in front of the flange, looking along \
             its z axis",
        )),
    }
    if let Some(start_rad) = &arm.start_rad {
        if let Some(index) = start_rad.iter().position(|angle| !angle.is_finite()) {
            let value = start_rad.get(index).copied().unwrap_or(f64::NAN);
            return Err(PlanError::number("not_finite", format!("start[{index}]"), value, "a finite angle"));
        }
        let (_, clamped) = arm.model.clamp_start(start_rad)?;
        warnings.extend(clamped.iter().map(|joint| Warning::new("start_clamped", joint.to_string())));
    }
    Ok(warnings)
}

/// A length within its bounds; one that would fit if it were millimetres is said to be.
///
/// # Errors
/// `not_finite`, `millimetres` or `out_of_range`, naming `field`, value and bounds.
pub fn length(field: &str, value: f64, least: f64, most: f64) -> Result<(), PlanError> {
    if !value.is_finite() {
        return Err(PlanError::number("not_finite", field, value, format!("from {least} to {most} m")));
    }
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let metres = value / 1000.0;
    if value.abs() > most && (least..=most).contains(&metres) {
        let bound = format!("from {least} to {most} m (millimetres? {value} mm are {metres} m)");
        return Err(PlanError::number("millimetres", field, value, bound));
    }
    Err(PlanError::number("out_of_range", field, value, format!("from {least} to {most} m")))
}
