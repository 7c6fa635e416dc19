//! What stands around the arm and hangs on its flange, and how its motion is timed.

use super::bounds::{
    LARGEST_MARGIN_M, LARGEST_YAW_RAD, MAX_KEEP_OUT, MAX_SOLIDS, SMALLEST_SHAPE_M, SMALLEST_SOLID_M,
    SOLID_IN_CELL_M, SOLID_ON_FLANGE_M,
};
use super::{Arm, PlanError, PlanRequest, Warning, keep_out, length};
use crate::motion::{Cell, CellObject, KeepOut, ObjectShape, Timing, default_camera_body, fixed_overlaps};
use crate::robot::LinkShape;

/// What a shape may stand out of the object's sphere, relatively: rounding of its diagonal.
const ROUNDING: f64 = 1e-6;

/// Solids of the cell besides arm, object and table.
#[derive(Clone, Debug, PartialEq)]
pub struct Surroundings {
    /// Regions nothing that moves may enter, in the base frame.
    pub keep_out: Vec<KeepOut>,
    /// Solids in the camera frame; `None` for a RealSense D435 and its bracket.
    pub camera_body: Option<Vec<LinkShape>>,
    /// Solids in the flange frame.
    pub tool: Vec<LinkShape>,
    /// Clearance kept from object, table and keep-out regions, metres.
    pub margin_m: f64,
}

impl Default for Surroundings {
    fn default() -> Self {
        Self { keep_out: Vec::new(), camera_body: None, tool: Vec::new(), margin_m: Cell::DEFAULT_MARGIN_M }
    }
}

/// The cell of `arm` in `request`.
pub fn cell(request: &PlanRequest, arm: &Arm) -> Cell {
    let object = request.object();
    let mount = arm.mount();
    let around = &arm.surroundings;
    let mut cell = Cell::new(arm.model.clone(), mount);
    cell.object = Some(CellObject {
        center_in_base: object.center_in_base,
        radius_m: object.radius_m,
        shape: object.shape,
    });
    cell.table_z_m = object.table_z_m;
    cell.camera_body = around.camera_body.clone().unwrap_or_else(|| default_camera_body(&mount));
    cell.tool.clone_from(&around.tool);
    cell.keep_out.clone_from(&around.keep_out);
    cell.margin_m = around.margin_m;
    cell
}

/// Checks the numbers of the surroundings and of the timing.
///
/// # Errors
/// The first that is out of its bound. Solids are checked where they are read.
pub(super) fn check(request: &PlanRequest, arm: &Arm) -> Result<Vec<Warning>, PlanError> {
    let around = &arm.surroundings;
    for (field, count, most) in [
        ("keep_out", around.keep_out.len(), MAX_KEEP_OUT),
        ("camera_body", around.camera_body.as_ref().map_or(0, Vec::len), MAX_SOLIDS),
        ("tool", around.tool.len(), MAX_SOLIDS),
    ] {
        if count > most {
            let bound = format!("at most {most} entries");
            return Err(PlanError::number("too_many", field, count as f64, bound));
        }
    }
    length("margin", around.margin_m, 0.0, LARGEST_MARGIN_M)?;
    check_timing(&arm.timing)?;
    let cell = cell(request, arm);
    let over_object = match &cell.object {
        Some(object) => keep_out::check(&around.keep_out, object),
        None => Vec::new(),
    };
    let overlaps = fixed_overlaps(&cell);
    let warning = |(part, region): (String, String)| {
        let text =
            format!("{part}, which does not move, stands in the keep-out region {region}: not looked at");
        Warning::new("base_in_keep_out", text)
    };
    Ok(over_object.into_iter().chain(overlaps.into_iter().map(warning)).chain(assumed_jerk(arm)).collect())
}

fn assumed_jerk(arm: &Arm) -> Option<Warning> {
    let without = arm.model.joints.iter().filter(|joint| joint.max_jerk_rad_per_s3.is_none());
    let names: Vec<&str> = without.map(|joint| joint.name.as_str()).collect();
    (arm.timing.jerk_limited && !names.is_empty()).then(|| {
        let text = format!(
            "no jerk limit is known of {}: one that reaches the acceleration limit in {} s is assumed",
            names.join(", "),
            Timing::ASSUMED_JERK_RISE_S
        );
        Warning::new("assumed_jerk", text)
    })
}

fn check_timing(timing: &Timing) -> Result<(), PlanError> {
    for (field, value, (least, most), unit) in [
        ("timing.speed_scale", timing.speed_scale, Timing::SPEED_SCALE, ""),
        ("timing.settle", timing.settle_s, Timing::SETTLE_S, " s"),
        ("timing.sample_period", timing.sample_period_s, Timing::SAMPLE_PERIOD_S, " s"),
    ] {
        if (least..=most).contains(&value) {
            continue;
        }
        let seconds = value / 1000.0;
        let hint = match !unit.is_empty() && value > most && (least..=most).contains(&seconds) {
            true => format!(" (milliseconds? {value} ms are {seconds} s)"),
            false => String::new(),
        };
        let code = if hint.is_empty() { "out_of_range" } else { "milliseconds" };
        return Err(PlanError::number(code, field, value, format!("from {least} to {most}{unit}{hint}")));
    }
    Ok(())
}

/// Whether `shape` has a size and stays within the enclosing sphere.
pub(super) fn check_shape(shape: &ObjectShape, sphere_radius_m: f64) -> Result<(), PlanError> {
    let largest = 2.0 * sphere_radius_m;
    let field = match shape {
        ObjectShape::Sphere => return Ok(()),
        ObjectShape::Cylinder { radius_m, height_m } => {
            length("object.shape.cylinder.radius", *radius_m, SMALLEST_SHAPE_M, largest)?;
            length("object.shape.cylinder.height", *height_m, SMALLEST_SHAPE_M, largest)?;
            "object.shape.cylinder"
        }
        ObjectShape::Cuboid { size_m, yaw_rad } => {
            for (axis, edge) in size_m.iter().enumerate() {
                length(&format!("object.shape.box.size[{axis}]"), *edge, SMALLEST_SHAPE_M, largest)?;
            }
            if !(yaw_rad.abs() <= LARGEST_YAW_RAD) {
                let bound = format!("within +-{LARGEST_YAW_RAD:.4} rad (degrees?)");
                return Err(PlanError::number("out_of_range", "object.shape.box.yaw", *yaw_rad, bound));
            }
            "object.shape.box"
        }
    };
    match shape.reach_m() {
        Some(reach_m) if !(reach_m <= sphere_radius_m * (1.0 + ROUNDING)) => {
            let bound = format!("at most object.radius, {sphere_radius_m} m, from the centre to its corners");
            Err(PlanError::number("shape_beyond_sphere", field, reach_m, bound))
        }
        _ => Ok(()),
    }
}

/// Checks the numbers of a solid that the request names `field`, before it becomes a shape:
/// `at` are coordinates by path, `sizes` edge lengths, radii and heights.
///
/// # Errors
/// 422 of the first that is out of its bound; millimetres are named.
pub fn check_solid(in_cell: bool, at: &[(String, f64)], sizes: &[(String, f64)]) -> Result<(), PlanError> {
    let (farthest, largest) = if in_cell { SOLID_IN_CELL_M } else { SOLID_ON_FLANGE_M };
    at.iter().try_for_each(|(field, value)| length(field, *value, -farthest, farthest))?;
    sizes.iter().try_for_each(|(field, value)| length(field, *value, SMALLEST_SOLID_M, largest))
}
