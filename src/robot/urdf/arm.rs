//! From URDF text to a robot model.

use std::collections::HashMap;

use super::guard::check_text;
use super::joints::{axis, limits, origin};
use super::shapes::gather;
use super::tree::{Tree, element, turns};
use crate::geometry::Pose;
use crate::robot::bounds::JOINTS;
use crate::robot::described::{DEFAULT_RADIUS_M, kinematics_of, links_along};
use crate::robot::error::short;
use crate::robot::{Chain, Link, LinkShape, Meshes, RobotError, RobotModel, RobotWarning, Segment, Source};

/// The arm between two links of a URDF; see [`RobotModel::from_urdf`].
pub(in crate::robot) fn from_urdf(
    text: &str,
    base_link: Option<&str>,
    tip_link: Option<&str>,
    meshes: &Meshes,
) -> Result<RobotModel, RobotError> {
    check_text(text)?;
    let robot = urdf_rs::read_from_string(text).map_err(|error| RobotError::Urdf(cut(&error.to_string())))?;
    let tree = Tree::new(&robot)?;
    let base = base_link.map_or_else(|| tree.root(), |name| tree.link(name))?;
    let tip = tip_link.map_or_else(|| tree.likely_tip(base), |name| tree.link(name))?;
    let path = tree.path(base, tip)?;

    let mut warnings = Vec::new();
    let (mut joints, mut segments, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let mut moving: HashMap<&str, usize> = HashMap::new();
    let mut pending = Pose::identity();
    for joint in path {
        pending *= origin("joint", &joint.name, &joint.origin)?;
        if turns(joint) {
            if moving.insert(joint.name.as_str(), joints.len()).is_some() {
                return Err(element("joint", &joint.name, "there is another joint of this name"));
            }
            joints.push(limits(joint, &mut warnings)?);
            segments.push(Segment { previous_from_joint: pending, axis_in_joint: axis(joint)? });
            names.push(joint.child.link.as_str());
            pending = Pose::identity();
        } else if joint.joint_type != urdf_rs::JointType::Fixed {
            let kind = format!("{:?}", joint.joint_type).to_lowercase();
            let problem =
                format!("{kind} joints are not supported between base and tip, only turning and fixed ones");
            return Err(element("joint", &joint.name, problem));
        }
    }
    if !JOINTS.contains(&joints.len()) {
        return Err(RobotError::JointCount {
            found: joints.len(),
            least: *JOINTS.start(),
            most: *JOINTS.end(),
        });
    }
    let chain = Chain::new(segments, pending)?;
    let mut shapes = gather(&tree, base, &moving, meshes)?;
    warnings.append(&mut shapes.warnings);
    let names = std::iter::once(tree.name(base)).chain(names);
    let links = links_with_stand_ins(&chain, names, shapes.shapes, &mut warnings);
    Ok(RobotModel {
        name: if robot.name.is_empty() { "urdf".to_owned() } else { short(&robot.name) },
        kinematics: kinematics_of(chain, &joints)?,
        joints,
        links,
        base_frame: short(tree.name(base)),
        flange_frame: short(tree.name(tip)),
        dh: None,
        sources: Source::of_model([
            "the request's URDF.",
            "the request's URDF.",
            "the request's URDF; where it has none, assumed and listed in the warnings.",
            "assumed, 5 rad/s2 for every joint: URDF has none.",
            "the request's URDF: collision boxes, cylinders, capsules and spheres; links without any get \
             assumed capsules.",
        ]),
        warnings,
    })
}

/// The links with their shapes. A link without any, which a collision check
/// would not see, gets a capsule along the arm.
fn links_with_stand_ins<'a>(
    chain: &Chain,
    names: impl Iterator<Item = &'a str>,
    shapes: Vec<Vec<LinkShape>>,
    warnings: &mut Vec<RobotWarning>,
) -> Vec<Link> {
    let mut assumed = Vec::new();
    let links = names
        .zip(shapes)
        .zip(links_along(chain, DEFAULT_RADIUS_M))
        .map(|((name, shapes), stand_in)| {
            let name = short(name);
            if !shapes.is_empty() {
                return Link { name, shapes };
            }
            if !stand_in.shapes.is_empty() {
                assumed.push(name.clone());
            }
            Link { name, shapes: stand_in.shapes }
        })
        .collect();
    if !assumed.is_empty() {
        let names = assumed.join(", ");
        warnings.push(RobotWarning::description(format!(
            "capsules of {DEFAULT_RADIUS_M} m radius stand for links without shapes: {names}"
        )));
    }
    links
}

/// A parser's message of bounded length.
fn cut(message: &str) -> String {
    message.chars().take(300).collect()
}
