//! The solids of a cell as collision queries use them: those on links, and those that stay.

use super::broad::{AxisBox, Ball};
use super::cell::Cell;
use super::contact::ContactKind;
use super::joints::MAX_JOINTS;
use super::shape::{Core, carried_by, core};
use crate::geometry::Pose;
use crate::robot::LinkShape;

/// A shape on a link.
#[derive(Clone)]
pub(crate) struct Body {
    pub name: String,
    pub link: usize,
    /// Camera or tool.
    pub is_mounted: bool,
    pub shape: LinkShape,
    pub core: Core,
    /// Whether `core` is the shape itself.
    pub exact: bool,
    /// Radius of the ball around `core` about its middle, metres.
    pub ball_radius_m: f64,
}

/// A solid that does not move, in the base frame.
pub(crate) struct Fixed {
    pub kind: ContactKind,
    pub name: String,
    pub shape: LinkShape,
    pub core: Core,
    /// Whether `core` is the shape itself.
    pub exact: bool,
    pub around: AxisBox,
}

/// The solids that move and the base's.
pub(crate) fn bodies_of(cell: &Cell, dof: usize) -> Vec<Body> {
    let body = |name: &str, link: usize, is_mounted: bool, shape: LinkShape| Body {
        name: name.to_owned(),
        link,
        is_mounted,
        core: core(&shape),
        ball_radius_m: Ball::around(&core(&shape)).radius_m,
        exact: matches!(shape, LinkShape::Capsule { .. }),
        shape,
    };
    let kinematics = cell.robot.kinematics.as_ref();
    let zero = [0.0; MAX_JOINTS];
    let last_pose = kinematics.link_poses(&zero[..dof]).pop().unwrap_or_default();
    let last_from_flange = last_pose.inv_mul(&kinematics.forward(&zero[..dof]));
    let last_from_camera = last_from_flange * cell.flange_from_camera;
    let links = cell.robot.links.iter().enumerate().flat_map(|(i, link)| {
        link.shapes.iter().map(move |shape| body(&link.name, i.min(dof), false, shape.clone()))
    });
    let mounted = |name, last_from_frame: Pose, solids: &'_ [LinkShape]| -> Vec<Body> {
        solids.iter().map(|shape| body(name, dof, true, carried_by(&last_from_frame, shape))).collect()
    };
    let camera = mounted("camera", last_from_camera, &cell.camera_body);
    let tool = mounted("tool", last_from_flange, &cell.tool);
    links.chain(camera).chain(tool).collect()
}

/// The solids that do not move but for the base's, and the table.
pub(crate) fn fixed_of(cell: &Cell) -> Vec<Fixed> {
    let fixed = |kind, name: &str, shape: LinkShape| Fixed {
        kind,
        name: name.to_owned(),
        core: core(&shape),
        around: AxisBox::around(&shape),
        exact: matches!(shape, LinkShape::Capsule { .. }),
        shape,
    };
    let object = cell.object.iter().map(|o| fixed(ContactKind::Object, "object", o.solid_in_base()));
    let regions =
        cell.keep_out.iter().map(|k| fixed(ContactKind::Obstacle, &k.name, k.shape_in_base.clone()));
    object.chain(regions).collect()
}
