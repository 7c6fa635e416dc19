//! Solids of the cell.

use std::collections::HashMap;

use super::pose;
use crate::api::problem::Problem;
use crate::api::wire::{BoxJson, CapsuleJson, CylinderJson, KeepOutJson, PoseJson, SolidJson, SphereJson};
use crate::geometry::Vector;
use crate::motion::KeepOut;
use crate::plan::check_solid;
use crate::robot::LinkShape;

/// Longest name of a keep-out region, characters.
pub const LONGEST_NAME: usize = 100;

/// The keep-out regions, in the base frame.
///
/// # Errors
/// 422 naming the member.
pub fn keep_out(regions: &[KeepOutJson]) -> Result<Vec<KeepOut>, Problem> {
    let mut bearers: HashMap<&str, usize> = HashMap::new();
    regions.iter().for_each(|region| *bearers.entry(&region.name).or_default() += 1);
    let region = |(index, json): (usize, &KeepOutJson)| {
        let path = format!("keep_out[{index}]");
        if json.name.trim().is_empty() || json.name.chars().count() > LONGEST_NAME {
            let bound = format!("1 to {LONGEST_NAME} characters, not all of them blank");
            return Err(Problem::field("out_of_range", format!("{path}.name"), json.name.clone(), bound));
        }
        let solid = Solid {
            cuboid: json.cuboid.as_ref(),
            sphere: json.sphere.as_ref(),
            capsule: json.capsule.as_ref(),
            cylinder: json.cylinder.as_ref(),
        };
        // An obstacle of several solids may have one name; a reason names the one it is about.
        let name = match bearers.get(json.name.as_str()) {
            Some(2..) => format!("{} ({path})", json.name),
            _ => json.name.clone(),
        };
        Ok(KeepOut { name, shape_in_base: solid.shape(&path, true)? })
    };
    regions.iter().enumerate().map(region).collect()
}

/// Solids on the flange, the request's member `field`.
///
/// # Errors
/// 422 naming the member.
pub fn mounted_solids(field: &str, solids: &[SolidJson]) -> Result<Vec<LinkShape>, Problem> {
    let shape = |(index, json): (usize, &SolidJson)| {
        let solid = Solid {
            cuboid: json.cuboid.as_ref(),
            sphere: json.sphere.as_ref(),
            capsule: json.capsule.as_ref(),
            cylinder: json.cylinder.as_ref(),
        };
        solid.shape(&format!("{field}[{index}]"), false)
    };
    solids.iter().enumerate().map(shape).collect()
}

/// The members that describe one solid.
struct Solid<'a> {
    cuboid: Option<&'a BoxJson>,
    sphere: Option<&'a SphereJson>,
    capsule: Option<&'a CapsuleJson>,
    cylinder: Option<&'a CylinderJson>,
}

impl Solid<'_> {
    fn shape(&self, path: &str, in_cell: bool) -> Result<LinkShape, Problem> {
        let check = |at: &[(&str, [f64; 3])], sizes: &[(&str, f64)]| {
            let at: Vec<(String, f64)> = at
                .iter()
                .flat_map(|(name, point)| {
                    let coordinate = move |(axis, value)| (format!("{path}.{name}[{axis}]"), value);
                    point.iter().copied().enumerate().map(coordinate)
                })
                .collect();
            let sizes: Vec<(String, f64)> =
                sizes.iter().map(|(name, value)| (format!("{path}.{name}"), *value)).collect();
            check_solid(in_cell, &at, &sizes)
        };
        match (self.cuboid, self.sphere, self.capsule, self.cylinder) {
            (Some(json), None, None, None) => {
                let [x, y, z] = json.size;
                check(
                    &[("box.center", json.center)],
                    &[("box.size[0]", x), ("box.size[1]", y), ("box.size[2]", z)],
                )?;
                let placed = PoseJson { position: json.center, orientation: json.orientation };
                Ok(LinkShape::Cuboid {
                    link_from_box: pose(&format!("{path}.box"), &placed)?,
                    half_extents_m: 0.5 * Vector::new(x, y, z),
                })
            }
            (None, Some(json), None, None) => {
                check(&[("sphere.center", json.center)], &[("sphere.radius", json.radius)])?;
                Ok(LinkShape::capsule(json.center, json.center, json.radius))
            }
            (None, None, Some(json), None) => {
                let ends = [("capsule.from", json.from), ("capsule.to", json.to)];
                check(&ends, &[("capsule.radius", json.radius)])?;
                Ok(LinkShape::capsule(json.from, json.to, json.radius))
            }
            (None, None, None, Some(json)) => {
                check(
                    &[("cylinder.center", json.center)],
                    &[("cylinder.radius", json.radius), ("cylinder.height", json.height)],
                )?;
                let placed = PoseJson { position: json.center, orientation: json.orientation };
                Ok(LinkShape::Cylinder {
                    link_from_cylinder: pose(&format!("{path}.cylinder"), &placed)?,
                    half_length_m: 0.5 * json.height,
                    radius_m: json.radius,
                })
            }
            (cuboid, sphere, capsule, cylinder) => {
                let given = [cuboid.is_some(), sphere.is_some(), capsule.is_some(), cylinder.is_some()];
                let given = given.iter().filter(|given| **given).count();
                Err(Problem::field(
                    "solid_description",
                    path,
                    format!("{given} of box, sphere, capsule, cylinder"),
                    "exactly one of box, sphere, capsule, cylinder",
                ))
            }
        }
    }
}
