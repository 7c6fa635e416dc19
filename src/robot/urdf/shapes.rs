//! Collision shapes of URDF links, gathered on the links that move.

use std::collections::HashMap;

use super::joints::origin;
use super::tree::{Tree, element};
use crate::geometry::{Point, Pose, Vector};
use crate::robot::error::short;
use crate::robot::{LinkShape, Meshes, RobotError, RobotWarning};

/// Most shapes of one arm.
const MOST_SHAPES: usize = 256;

/// Longest edge or radius, metres.
const LARGEST_M: f64 = 5.0;

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
                    mesh(&described.name, filename, scale, &frame, meshes, &mut arm.warnings)?
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
    if !frozen.is_empty() {
        let names = listed(&mut frozen);
        let message = format!("joints beside the arm are taken as fixed at 0: {names}");
        arm.warnings.push(RobotWarning::description(message));
    }
    Ok(arm)
}

/// The first names in order, each once.
fn listed(names: &mut Vec<String>) -> String {
    names.sort();
    names.dedup();
    let more = names.len().saturating_sub(16);
    let mut list = names.iter().take(16).map(String::as_str).collect::<Vec<_>>().join(", ");
    if more > 0 {
        list.push_str(&format!(" and {more} more"));
    }
    list
}

/// The shape that stands for a mesh; without the file the mesh is left out with a warning.
fn mesh(
    link: &str,
    filename: &str,
    scale: [f64; 3],
    frame: &Pose,
    meshes: &Meshes,
    warnings: &mut Vec<RobotWarning>,
) -> Result<Option<LinkShape>, RobotError> {
    let file = cut(filename);
    let link_name = short(link);
    let Some(bytes) = meshes.get(filename) else {
        warnings.push(RobotWarning::mesh_left_out(format!(
            "link {link_name:?}: its collision mesh {file:?} is left out; attach the file or describe the \
             link by boxes, cylinders and spheres"
        )));
        return Ok(None);
    };
    let refuse = |problem: String| element("mesh", filename, problem);
    if let Some(factor) = scale.iter().find(|factor| !(factor.abs() >= 1e-6 && factor.abs() <= 1e3)) {
        return Err(refuse(format!("its scale has {factor}, from 1e-6 to 1000 is taken")));
    }
    let [x, y, z] = scale;
    let mut points = crate::robot::mesh::points(bytes).map_err(refuse)?;
    points.iter_mut().for_each(|p| *p = Point::new(p.x * x, p.y * y, p.z * z));
    if let Some(far) = points.iter().flat_map(|p| p.iter()).find(|v| v.abs() > LARGEST_M) {
        let problem = format!(
            "a corner is at {far} m, at most {LARGEST_M} m are taken; a mesh in millimetres needs scale 0.001"
        );
        return Err(refuse(problem));
    }
    let Some(shape) = crate::robot::mesh::fit(&points) else { return Ok(None) };
    let (kind, shape) = placed(frame, shape);
    warnings.push(RobotWarning::mesh_replaced(format!(
        "link {link_name:?}: a {kind} that holds it stands for the collision mesh {file:?}"
    )));
    Ok(Some(shape))
}

/// A shape of a mesh's frame in its link's frame, and what it is called.
fn placed(link_from_mesh: &Pose, shape: LinkShape) -> (&'static str, LinkShape) {
    match shape {
        LinkShape::Capsule { from_in_link, to_in_link, radius_m } => (
            "capsule",
            LinkShape::Capsule {
                from_in_link: link_from_mesh * from_in_link,
                to_in_link: link_from_mesh * to_in_link,
                radius_m,
            },
        ),
        LinkShape::Cuboid { link_from_box, half_extents_m } => {
            ("box", LinkShape::Cuboid { link_from_box: link_from_mesh * link_from_box, half_extents_m })
        }
        LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m } => {
            let link_from_cylinder = link_from_mesh * link_from_cylinder;
            ("cylinder", LinkShape::Cylinder { link_from_cylinder, half_length_m, radius_m })
        }
    }
}

/// A file name of bounded length, its end kept: that is what tells files apart.
fn cut(filename: &str) -> String {
    let count = filename.chars().count();
    filename.chars().skip(count.saturating_sub(128)).collect()
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
