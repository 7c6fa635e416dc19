//! Mesh files that come with a URDF: the shapes that stand for its collision meshes.

use std::collections::{BTreeSet, HashMap};

use super::shapes::{LARGEST_M, listed};
use super::tree::element;
use crate::geometry::{Point, Pose};
use crate::robot::error::short;
use crate::robot::mesh::{fit, points};
use crate::robot::{LinkShape, Meshes, RobotError, RobotWarning};

/// Attached files and what became of them.
pub(super) struct AttachedMeshes<'a> {
    files: &'a Meshes,
    /// Shapes in their mesh's frame by file and scale: links share files, and fitting takes time.
    fitted: HashMap<(String, [u64; 3]), Option<LinkShape>>,
    /// Names that the URDF's collision meshes have, with and without a file.
    used: BTreeSet<String>,
    missing: BTreeSet<String>,
    warnings: Vec<RobotWarning>,
}

impl<'a> AttachedMeshes<'a> {
    pub(super) fn new(files: &'a Meshes) -> Self {
        Self {
            files,
            fitted: HashMap::new(),
            used: BTreeSet::new(),
            missing: BTreeSet::new(),
            warnings: Vec::new(),
        }
    }

    /// The shape that stands for a mesh, in the frame of `frame`'s parent; `None` with a warning
    /// without the file.
    pub(super) fn shape(
        &mut self,
        link: &str,
        filename: &str,
        scale: [f64; 3],
        frame: &Pose,
    ) -> Result<Option<LinkShape>, RobotError> {
        let (file, link) = (cut(filename), short(link));
        let Some(bytes) = self.files.get(filename) else {
            self.missing.insert(file.clone());
            self.warnings.push(RobotWarning::mesh_left_out(format!(
                "link {link:?}: its collision mesh {file:?} is left out; attach the file or describe the \
                 link by boxes, cylinders and spheres"
            )));
            return Ok(None);
        };
        self.used.insert(filename.to_owned());
        let key = (filename.to_owned(), scale.map(f64::to_bits));
        let fitted = match self.fitted.get(&key) {
            Some(shape) => shape.clone(),
            None => {
                let shape = fitted(filename, bytes, scale)?;
                self.fitted.insert(key, shape.clone());
                shape
            }
        };
        let Some(shape) = fitted else { return Ok(None) };
        let (kind, shape) = placed(frame, shape);
        self.warnings.push(RobotWarning::mesh_replaced(format!(
            "link {link:?}: a {kind} that holds it stands for the collision mesh {file:?}"
        )));
        Ok(Some(shape))
    }

    /// What the caller should know, files that nothing refers to included.
    pub(super) fn into_warnings(mut self) -> Vec<RobotWarning> {
        let mut unused: Vec<String> =
            self.files.keys().filter(|name| !self.used.contains(*name)).map(|name| cut(name)).collect();
        if unused.is_empty() {
            return self.warnings;
        }
        let mut wanted: Vec<String> = match self.missing.is_empty() {
            true => self.used.iter().map(|name| cut(name)).collect(),
            false => self.missing.into_iter().collect(),
        };
        let wanted = match wanted.is_empty() {
            true => "the URDF has none below its base".to_owned(),
            false => format!("the URDF's names are {}", listed(&mut wanted)),
        };
        self.warnings.push(RobotWarning::mesh_unused(format!(
            "attached files that no collision mesh names are not looked at: {}; {wanted}",
            listed(&mut unused)
        )));
        self.warnings
    }
}

/// The shape that holds a file's corners, in the mesh's frame.
fn fitted(filename: &str, bytes: &[u8], scale: [f64; 3]) -> Result<Option<LinkShape>, RobotError> {
    let refuse = |problem: String| element("mesh", filename, problem);
    if let Some(factor) = scale.iter().find(|factor| !(factor.abs() >= 1e-6 && factor.abs() <= 1e3)) {
        return Err(refuse(format!("its scale has {factor}, from 1e-6 to 1000 is taken")));
    }
    let [x, y, z] = scale;
    let mut points = points(bytes).map_err(refuse)?;
    points.iter_mut().for_each(|p| *p = Point::new(p.x * x, p.y * y, p.z * z));
    if let Some(far) = points.iter().flat_map(|p| p.iter()).find(|v| v.abs() > LARGEST_M) {
        let problem = format!(
            "a corner is at {far} m, at most {LARGEST_M} m are taken; a mesh in millimetres needs scale 0.001"
        );
        return Err(refuse(problem));
    }
    Ok(fit(&points))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn files(names: &[&str]) -> Meshes {
        let corners = b"v 0 0 0\nv 0.1 0 0\nv 0 0.04 0\nv 0.1 0.04 0.02\n".to_vec();
        names.iter().map(|name| ((*name).to_owned(), corners.clone())).collect()
    }

    #[test]
    fn a_file_that_two_links_share_is_fitted_once_a_scale() {
        let files = files(&["a.stl"]);
        let mut attached = AttachedMeshes::new(&files);
        let there = Pose::translation(1.0, 0.0, 0.0);
        let shapes = [Pose::identity(), there]
            .map(|frame| attached.shape("link", "a.stl", [1.0; 3], &frame).unwrap().unwrap());
        let Ok([a, b]) = <[Point; 2]>::try_from(
            shapes
                .iter()
                .map(|shape| match shape {
                    LinkShape::Cuboid { link_from_box, .. } => Point::from(link_from_box.translation.vector),
                    LinkShape::Capsule { from_in_link, .. } => *from_in_link,
                    LinkShape::Cylinder { link_from_cylinder, .. } => {
                        Point::from(link_from_cylinder.translation.vector)
                    }
                })
                .collect::<Vec<_>>(),
        ) else {
            panic!("two shapes")
        };
        assert!((b - a - crate::geometry::Vector::x()).norm() < 1e-12);
        assert_eq!(attached.fitted.len(), 1);
        attached.shape("link", "a.stl", [2.0; 3], &there).unwrap();
        assert_eq!(attached.fitted.len(), 2);
    }

    #[test]
    fn a_file_that_nothing_names_is_told_with_the_names_that_would_do() {
        let files = files(&["arm/a.stl", "b.stl"]);
        let mut attached = AttachedMeshes::new(&files);
        attached.shape("one", "package://arm/a.stl", [1.0; 3], &Pose::identity()).unwrap();
        attached.shape("two", "b.stl", [1.0; 3], &Pose::identity()).unwrap();
        let warnings = attached.into_warnings();
        let unused = warnings.iter().find(|w| w.code == "mesh_unused").unwrap();
        assert!(unused.message.contains("arm/a.stl; the URDF's names are package://arm/a.stl"), "{unused}");
    }

    #[test]
    fn files_that_are_all_used_are_no_matter() {
        let files = files(&["b.stl"]);
        let mut attached = AttachedMeshes::new(&files);
        attached.shape("two", "b.stl", [1.0; 3], &Pose::identity()).unwrap();
        assert!(attached.into_warnings().iter().all(|w| w.code != "mesh_unused"));
        let none = AttachedMeshes::new(&files);
        assert!(none.into_warnings()[0].message.contains("has none"));
    }
}
