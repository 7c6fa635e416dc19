//! Collision shapes of URDF links, gathered on the links that move.

use std::collections::HashMap;

use super::attached::AttachedMeshes;
use super::joints::origin;
use super::tree::{Tree, element};
use crate::geometry::{Point, Pose, Vector};
use crate::robot::error::short;
use crate::robot::{LinkShape, Meshes, RobotError, RobotWarning};

/// Most shapes of one arm.
const MOST_SHAPES: usize = 256;

/// Longest edge or radius, metres.
pub(super) const LARGEST_M: f64 = 5.0;

/// The shapes of an arm, one list for the base and one for each moving link.
pub(super) struct ArmShapes {
    pub shapes: Vec<Vec<LinkShape>>,
    pub warnings: Vec<RobotWarning>,
}

/// Gathers the shapes of all links below `base`. Links fixed to one of the
/// arm's moving links count as part of it; links behind other moving joints (fingers) are taken as
/// fixed with those joints at 0. `moving` maps the names of the arm's moving joints to their number.
pub(super) fn gather(
    tree: &Tree<'_>,
    base: usize,
    moving: &HashMap<&str, usize>,
    meshes: &Meshes,
) -> Result<ArmShapes, RobotError> {
    let mut arm = ArmShapes { shapes: vec![Vec::new(); moving.len() + 1], warnings: Vec::new() };
    let mut attached = AttachedMeshes::new(meshes);
    let mut frozen = Vec::new();
    let mut count = 0;
    // Every link has one joint above it, so each is visited once, except the base if it closes a cycle.
    let mut open = vec![(base, 0usize, Pose::identity())];
    while let Some((link, group, group_from_link)) = open.pop() {
        let Some(described) = tree.get(link) else { continue };
        for collision in &described.collision {
            count += 1;
            if count > MOST_SHAPES {
                return Err(RobotError::Urdf(format!("more than {MOST_SHAPES} collision shapes on the arm")));
            }
            let frame = group_from_link * origin("link", &described.name, &collision.origin)?;
            let shape = match &collision.geometry {
                urdf_rs::Geometry::Mesh { filename, scale } => {
                    let scale = scale.map_or([1.0; 3], |scale| scale.0);
                    attached.shape(&described.name, filename, scale, &frame)?
                }
                geometry => Some(primitive(&described.name, geometry, frame)?),
            };
            if let (Some(shape), Some(list)) = (shape, arm.shapes.get_mut(group)) {
                list.push(shape);
            }
        }
        for joint in tree.joints_below(link) {
            let child = tree.link(&joint.child.link)?;
            if child == base {
                return Err(element("link", &joint.child.link, "the joints below it lead back to it"));
            }
            match moving.get(joint.name.as_str()) {
                Some(number) => open.push((child, number + 1, Pose::identity())),
                None => {
                    if joint.joint_type != urdf_rs::JointType::Fixed {
                        frozen.push(short(&joint.name));
                    }
                    let link_from_child = origin("joint", &joint.name, &joint.origin)?;
                    open.push((child, group, group_from_link * link_from_child));
                }
            }
        }
    }
    arm.warnings.extend(attached.into_warnings());
    if !frozen.is_empty() {
        let names = listed(&mut frozen);
        let message = format!("joints beside the arm are taken as fixed at 0: {names}");
        arm.warnings.push(RobotWarning::description(message));
    }
    Ok(arm)
}

/// The first names in order, each once.
pub(super) fn listed(names: &mut Vec<String>) -> String {
    names.sort();
    names.dedup();
    let more = names.len().saturating_sub(16);
    let mut list = names.iter().take(16).map(String::as_str).collect::<Vec<_>>().join(", ");
    if more > 0 {
        list.push_str(&format!(" and {more} more"));
    }
    list
}

/// One shape other than a mesh in the frame of its moving link.
fn primitive(link: &str, geometry: &urdf_rs::Geometry, frame: Pose) -> Result<LinkShape, RobotError> {
    let size = |field: &str, value: f64| {
        // The comparison is false for NaN.
        if value > 0.0 && value <= LARGEST_M {
            return Ok(value);
        }
        let problem = format!("collision {field} is {value}, must be above 0 and at most {LARGEST_M} m");
        Err(element("link", link, problem))
    };
    Ok(match geometry {
        urdf_rs::Geometry::Box { size: edges } => {
            let [x, y, z] = edges.0;
            let half = Vector::new(size("box size", x)?, size("box size", y)?, size("box size", z)?) * 0.5;
            LinkShape::Cuboid { link_from_box: frame, half_extents_m: half }
        }
        urdf_rs::Geometry::Cylinder { radius, length } => LinkShape::Cylinder {
            link_from_cylinder: frame,
            half_length_m: 0.5 * size("cylinder length", *length)?,
            radius_m: size("cylinder radius", *radius)?,
        },
        urdf_rs::Geometry::Capsule { radius, length } => {
            let half = 0.5 * size("capsule length", *length)?;
            LinkShape::Capsule {
                from_in_link: frame * Point::new(0.0, 0.0, -half),
                to_in_link: frame * Point::new(0.0, 0.0, half),
                radius_m: size("capsule radius", *radius)?,
            }
        }
        urdf_rs::Geometry::Sphere { radius } => {
            let centre = frame * Point::origin();
            LinkShape::Capsule {
                from_in_link: centre,
                to_in_link: centre,
                radius_m: size("sphere radius", *radius)?,
            }
        }
        urdf_rs::Geometry::Mesh { .. } => return Err(element("link", link, "a mesh is no primitive")),
    })
}
