//! A quick look at an OBJ: enough to tell whether it is worth loading, without its points and pixels.

use std::collections::BTreeSet;

use super::files::Files;
use super::obj::texture_file;
use super::text::to_text;

/// What an OBJ holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ObjSummary {
    /// Triangles, polygons counted as fans.
    pub(crate) triangles: usize,
    /// Materials in use whose texture is there and is PNG or JPEG by name.
    pub(crate) textured: usize,
    /// Different colours of the other materials in use.
    pub(crate) colours: usize,
}

/// Reads the face and material lines of an OBJ and its material files.
pub(crate) fn scan_obj(bytes: &[u8], files: &dyn Files) -> ObjSummary {
    let mut summary = ObjSummary::default();
    let mut used: BTreeSet<String> = BTreeSet::new();
    let mut current = String::new();
    let mut libraries = Vec::new();
    for line in bytes.split(|b| *b == b'\n') {
        let text = || String::from_utf8_lossy(line);
        let rest =
            || text().split_once(char::is_whitespace).map_or(String::new(), |(_, r)| r.trim().to_owned());
        if line.starts_with(b"f ") {
            let corners = line.split(u8::is_ascii_whitespace).filter(|part| !part.is_empty()).count() - 1;
            summary.triangles += corners.saturating_sub(2);
            if !used.contains(&current) {
                used.insert(current.clone());
            }
        } else if line.starts_with(b"usemtl") {
            current = rest();
        } else if line.starts_with(b"mtllib") {
            libraries.push(rest());
        }
    }
    let mut colours = BTreeSet::new();
    for library in libraries {
        let Ok(bytes) = files.read(&library) else { continue };
        let Ok((materials, _)) = tobj::load_mtl_buf(&mut to_text(bytes).as_bytes()) else { continue };
        for material in materials.iter().filter(|m| used.contains(&m.name)) {
            let has = |named: &String| {
                let file = texture_file(named, files);
                let ending = file.to_ascii_lowercase();
                [".png", ".jpg", ".jpeg"].iter().any(|e| ending.ends_with(e)) && files.has(file)
            };
            if material.diffuse_texture.as_ref().is_some_and(has) {
                summary.textured += 1;
            } else {
                colours
                    .insert(material.diffuse.unwrap_or([0.8; 3]).map(|c| (c.clamp(0.0, 1.0) * 255.0) as u8));
            }
        }
    }
    summary.colours = colours.len();
    summary
}
