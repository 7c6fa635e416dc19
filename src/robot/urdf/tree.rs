//! The tree of links and joints, and the path through it that is the arm.

use std::collections::HashMap;

use urdf_rs::JointType;

use crate::robot::RobotError;
use crate::robot::error::short;

/// Most links, and most joints, of a URDF.
const MOST: usize = 512;

/// Names that URDFs give to the frame a tool is mounted to, the first one present is taken.
const TIP_NAMES: [&str; 5] = ["tool0", "flange", "tool_flange", "ee_link", "panda_link8"];

/// Links and joints by name and by place.
pub(super) struct Tree<'a> {
    robot: &'a urdf_rs::Robot,
    link_index: HashMap<&'a str, usize>,
    /// The joint above each link.
    joint_above: Vec<Option<usize>>,
    /// The joints below each link, in the order of the file.
    joints_below: Vec<Vec<usize>>,
}

pub(super) fn element(kind: &'static str, name: &str, problem: impl Into<String>) -> RobotError {
    RobotError::UrdfElement { kind, name: short(name), problem: problem.into() }
}

impl<'a> Tree<'a> {
    /// Checks names and references; every link has at most one joint above it.
    pub fn new(robot: &'a urdf_rs::Robot) -> Result<Self, RobotError> {
        if robot.links.len() > MOST || robot.joints.len() > MOST {
            let (links, joints) = (robot.links.len(), robot.joints.len());
            return Err(RobotError::Urdf(format!(
                "{links} links and {joints} joints, at most {MOST} each are read"
            )));
        }
        let mut link_index = HashMap::new();
        for (i, link) in robot.links.iter().enumerate() {
            if link_index.insert(link.name.as_str(), i).is_some() {
                return Err(element("link", &link.name, "there is another link of this name"));
            }
        }
        let mut joint_above = vec![None; robot.links.len()];
        let mut joints_below = vec![Vec::new(); robot.links.len()];
        for (i, joint) in robot.joints.iter().enumerate() {
            let find = |name: &str, role: &str| {
                let missing =
                    || element("joint", &joint.name, format!("its {role} link {:?} is missing", short(name)));
                link_index.get(name).copied().ok_or_else(missing)
            };
            let (parent, child) = (find(&joint.parent.link, "parent")?, find(&joint.child.link, "child")?);
            if let Some(slot) = joint_above.get_mut(child)
                && slot.replace(i).is_some()
            {
                return Err(element("link", &joint.child.link, "it is the child of two joints"));
            }
            if let Some(below) = joints_below.get_mut(parent) {
                below.push(i);
            }
        }
        Ok(Self { robot, link_index, joint_above, joints_below })
    }

    /// The link called `name`.
    pub fn link(&self, name: &str) -> Result<usize, RobotError> {
        self.link_index.get(name).copied().ok_or_else(|| element("link", name, "there is no such link"))
    }

    /// The joints under a link.
    pub fn joints_below(&self, link: usize) -> impl Iterator<Item = &'a urdf_rs::Joint> {
        let below = self.joints_below.get(link).map(Vec::as_slice).unwrap_or_default();
        below.iter().filter_map(|&joint| self.robot.joints.get(joint))
    }

    /// The name of a link.
    pub fn name(&self, link: usize) -> &'a str {
        self.robot.links.get(link).map_or("", |l| l.name.as_str())
    }

    /// A link by index.
    pub fn get(&self, link: usize) -> Option<&'a urdf_rs::Link> {
        self.robot.links.get(link)
    }

    /// The one link without a joint above it.
    pub fn root(&self) -> Result<usize, RobotError> {
        let roots: Vec<usize> =
            (0..self.robot.links.len()).filter(|&l| self.joint_above[l].is_none()).collect();
        match roots.as_slice() {
            [root] => Ok(*root),
            [] => Err(RobotError::Urdf(
                "no link is the root: the joints form a cycle, or there is no link".to_owned(),
            )),
            [first, second, ..] => Err(RobotError::Urdf(format!(
                "more than one root link, among them {:?} and {:?}; name the base link",
                short(self.name(*first)),
                short(self.name(*second))
            ))),
        }
    }

    /// The joints from `base` down to `tip`.
    pub fn path(&self, base: usize, tip: usize) -> Result<Vec<&'a urdf_rs::Joint>, RobotError> {
        let mut joints = Vec::new();
        let mut link = tip;
        while link != base {
            let above = self.joint_above.get(link).copied().flatten();
            let joint = above.and_then(|joint| self.robot.joints.get(joint));
            // More joints than links means going round in circles.
            let (Some(joint), true) = (joint, joints.len() <= self.robot.links.len()) else {
                let problem = format!("it is not below the base link {:?}", short(self.name(base)));
                return Err(element("link", self.name(tip), problem));
            };
            joints.push(joint);
            link = self.link(&joint.parent.link)?;
        }
        joints.reverse();
        Ok(joints)
    }

    /// The tip for callers that name none: a link of a customary name, else the
    /// one leaf with the most turning joints above it.
    pub fn likely_tip(&self, base: usize) -> Result<usize, RobotError> {
        let customary = TIP_NAMES.iter().filter_map(|name| self.link_index.get(name).copied());
        if let Some(tip) = customary.into_iter().find(|&tip| self.path(base, tip).is_ok()) {
            return Ok(tip);
        }
        let leaves = (0..self.robot.links.len()).filter(|&l| self.joints_below[l].is_empty());
        let ranked: Vec<(usize, usize)> = leaves
            .filter_map(|leaf| {
                let path = self.path(base, leaf).ok()?;
                Some((path.iter().filter(|j| turns(j)).count(), leaf))
            })
            .collect();
        let most = ranked.iter().map(|(turning, _)| *turning).max().unwrap_or(0);
        let best: Vec<usize> =
            ranked.iter().filter(|(turning, _)| *turning == most).map(|(_, leaf)| *leaf).collect();
        match best.as_slice() {
            [tip] => Ok(*tip),
            _ => {
                let names: Vec<String> = best.iter().take(8).map(|&leaf| short(self.name(leaf))).collect();
                Err(RobotError::Urdf(format!("name the tip link; candidates: {}", names.join(", "))))
            }
        }
    }
}

/// Whether a joint turns about an axis.
pub(super) fn turns(joint: &urdf_rs::Joint) -> bool {
    matches!(joint.joint_type, JointType::Revolute | JointType::Continuous)
}
