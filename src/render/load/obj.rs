//! Wavefront OBJ with MTL.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

use image::RgbaImage;

use super::MeshError;
use super::files::Files;
use super::text::to_text;
use crate::imaging::{DEFAULT_MAX_PIXELS, decode_image};
use crate::render::{Material, Mesh, MeshWarning, srgb};

/// Loads an OBJ and turns it z-up.
pub(super) fn load(name: &str, bytes: &[u8], files: &dyn Files) -> Result<Mesh, MeshError> {
    let mut mesh = load_y_up(name, bytes, files)?;
    mesh.turn_y_up_to_z_up();
    Ok(mesh)
}

/// Loads an OBJ as it is in the file. Texture coordinates become top-left based.
pub(super) fn load_y_up(name: &str, bytes: &[u8], files: &dyn Files) -> Result<Mesh, MeshError> {
    let options =
        tobj::LoadOptions { single_index: true, triangulate: true, ignore_points: true, ignore_lines: true };
    let mut mesh = Mesh::default();
    let failed = RefCell::new(None);
    let text = to_text(bytes.to_vec());
    let (models, materials) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |path| {
        let wanted = path.to_string_lossy();
        let read = files.read(&wanted).map_err(|reason| failed.replace(Some(format!("{wanted}: {reason}"))));
        let bytes = read.map_err(|_| tobj::LoadError::OpenFileFailed)?;
        tobj::load_mtl_buf(&mut to_text(bytes).as_bytes())
    })
    .map_err(|e| MeshError::Broken { name: name.to_owned(), reason: e.to_string() })?;
    match materials {
        Ok(materials) => add_materials(&mut mesh, &materials, files),
        Err(e) => {
            let reason = failed.take().unwrap_or_else(|| e.to_string());
            mesh.warnings.push(MeshWarning::Materials { reason });
        }
    }
    // Faces without a material get a last, plain one.
    let plain = mesh.materials.len();
    mesh.materials.push(Material { name: "none".to_owned(), ..Material::default() });
    for model in &models {
        add_model(&mut mesh, &model.mesh, plain);
    }
    Ok(mesh)
}

fn add_model(mesh: &mut Mesh, part: &tobj::Mesh, plain: usize) {
    let first = mesh.positions.len() as u32;
    let (points, _) = part.positions.as_chunks::<3>();
    let (normals, _) = part.normals.as_chunks::<3>();
    let (uvs, _) = part.texcoords.as_chunks::<2>();
    mesh.positions.extend_from_slice(points);
    mesh.normals.extend_from_slice(normals);
    mesh.normals.resize(mesh.positions.len(), [0.0; 3]);
    // OBJ has v = 0 at the bottom.
    mesh.uvs.extend(uvs.iter().map(|[u, v]| [*u, 1.0 - *v]));
    mesh.uvs.resize(mesh.positions.len(), [0.0; 2]);
    let (triangles, _) = part.indices.as_chunks::<3>();
    mesh.triangles.extend(triangles.iter().map(|t| t.map(|i| i.saturating_add(first))));
    let material = part.material_id.unwrap_or(plain).min(plain) as u32;
    mesh.triangle_materials.resize(mesh.triangles.len(), material);
}

fn add_materials(mesh: &mut Mesh, materials: &[tobj::Material], files: &dyn Files) {
    let mut known: HashMap<String, Option<Arc<RgbaImage>>> = HashMap::new();
    for m in materials {
        let mut texture = None;
        if let Some(named) = m.diffuse_texture.as_deref() {
            let file = texture_file(named, files);
            texture = known
                .entry(file.to_owned())
                .or_insert_with(|| match texture_image(file, files) {
                    Ok(image) => Some(Arc::new(image)),
                    Err(reason) => {
                        mesh.warnings.push(MeshWarning::Texture {
                            material: m.name.clone(),
                            texture: named.to_owned(),
                            reason,
                        });
                        None
                    }
                })
                .clone();
        }
        let kd = m.diffuse.unwrap_or([0.8; 3]).map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 0.8 });
        // Exporters write a black colour beside a texture when they mean the texture alone.
        let black = kd.iter().all(|c| *c < 0.05);
        let kd = if texture.is_some() && black { [1.0; 3] } else { kd };
        mesh.materials.push(Material {
            name: m.name.clone(),
            color: kd.map(srgb::to_linear),
            opacity: m.dissolve.filter(|d| d.is_finite()).unwrap_or(1.0),
            texture,
            ..Material::default()
        });
    }
}

/// The file named in a `map_Kd` line, whose options (`-s 1 1 1 file.png`) come first.
pub(super) fn texture_file<'a>(named: &'a str, files: &dyn Files) -> &'a str {
    let named = named.trim();
    if !named.starts_with('-') || files.has(named) {
        return named;
    }
    named.rsplit_once(char::is_whitespace).map_or(named, |(_, last)| last)
}

fn texture_image(file: &str, files: &dyn Files) -> Result<RgbaImage, String> {
    decode_image(&files.read(file)?, DEFAULT_MAX_PIXELS).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files in memory.
    struct Fake(HashMap<&'static str, Vec<u8>>);

    impl Files for Fake {
        fn read(&self, name: &str) -> Result<Vec<u8>, String> {
            self.0.get(name).cloned().ok_or_else(|| "no such file".to_owned())
        }

        fn has(&self, name: &str) -> bool {
            self.0.contains_key(name)
        }
    }

    const QUAD: &[u8] = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        usemtl wood\nf 1/1 2/2 3/3 4/4\n";

    #[test]
    fn a_quad_becomes_two_upright_textured_triangles() {
        let mut png = Vec::new();
        let image = RgbaImage::from_pixel(2, 2, image::Rgba([200, 10, 10, 255]));
        image.write_to(&mut std::io::Cursor::new(&mut png), image::ImageFormat::Png).unwrap();
        let files = Fake(HashMap::from([
            ("m.mtl", b"newmtl wood\nKd 0 0 0\nmap_Kd -s 1 1 1 wood.png\n".to_vec()),
            ("wood.png", png),
        ]));
        let mut mesh = load("quad", QUAD, &files).unwrap();
        mesh.repair();
        assert_eq!(mesh.warnings, []);
        assert_eq!(mesh.triangles.len(), 2);
        assert!(mesh.has_texture());
        assert_eq!(mesh.materials[0].color, [1.0; 3]);
        let top_left = mesh.positions.iter().position(|p| *p == [0.0, 0.0, 1.0]).unwrap();
        assert_eq!(mesh.uvs[top_left], [0.0, 0.0]);
        assert!(mesh.normals.iter().all(|n| n[1] < -0.99), "the front faces -y");
    }

    #[test]
    fn a_missing_texture_and_a_missing_library_are_warnings() {
        let files = Fake(HashMap::from([("m.mtl", b"newmtl wood\nKd 1 0 0\nmap_Kd gone.png\n".to_vec())]));
        let mesh = load("quad", QUAD, &files).unwrap();
        assert!(mesh.warnings[0].to_string().contains("gone.png"), "{:?}", mesh.warnings);
        assert_eq!(mesh.materials[0].color, [1.0, 0.0, 0.0]);
        let mesh = load("quad", QUAD, &Fake(HashMap::new())).unwrap();
        assert!(mesh.warnings[0].to_string().contains("m.mtl"), "{:?}", mesh.warnings);
        assert_eq!(mesh.triangles.len(), 2);
    }

    proptest::proptest! {
        #[test]
        fn damaged_files_never_panic(cuts in proptest::collection::vec((0usize..120, 0u8..), 1..6)) {
            let mut bytes = QUAD.to_vec();
            for (at, byte) in cuts {
                let at = at % bytes.len();
                bytes[at] = byte;
            }
            if let Ok(mut mesh) = load("damaged", &bytes, &Fake(HashMap::new())) {
                mesh.repair();
                let n = mesh.positions.len();
                proptest::prop_assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < n));
            }
        }
    }
}
