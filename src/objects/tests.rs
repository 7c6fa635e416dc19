//! What every made object must be.

use std::collections::HashMap;

use rayon::prelude::*;
use sha2::{Digest, Sha256};

use super::families::{built, families, made_object};
use super::shape::Built;
use super::*;

/// An edge by the bits of its two corners, the lesser first, so that equal positions meet whatever their index.
type Edge = ([u32; 3], [u32; 3]);

/// How often each edge of a part's triangles is run along forwards less backwards, and at all; six volumes.
fn edges_and_volume(built: &Built, part: &super::shape::Part) -> (HashMap<Edge, (i32, u32)>, f64) {
    let mut edges = HashMap::new();
    let mut volume = 0.0;
    for triangle in &built.mesh.triangles[part.triangles.clone()] {
        let p = triangle.map(|i| built.mesh.positions[i as usize]);
        let bits = p.map(|p| p.map(|v| (v + 0.0).to_bits()));
        for k in 0..3 {
            let (from, to) = (bits[k], bits[(k + 1) % 3]);
            let edge: &mut (i32, u32) = edges.entry((from.min(to), from.max(to))).or_default();
            edge.0 += if from < to { 1 } else { -1 };
            edge.1 += 1;
        }
        let [a, b, c] = p.map(|p| frame::V::from(p.map(f64::from)));
        volume += a.dot(&b.cross(&c));
    }
    (edges, volume)
}

/// Twenty objects of a family, textures small.
fn twenty(family: Family) -> impl Iterator<Item = (String, Built)> {
    (0..20).map(move |seed| (format!("{}/{seed}", family.name()), built(family, seed, 0.01)))
}

#[test]
fn every_family_makes_sound_meshes_whose_solids_are_closed() {
    let all: Vec<Family> = families().collect();
    let wrong: Vec<String> = all
        .into_par_iter()
        .flat_map_iter(|family| {
            twenty(family).flat_map(|(what, built)| {
                let faults = unsound(&built).into_iter().chain(open_solids(&built));
                faults.map(|fault| format!("{what}: {fault}")).collect::<Vec<_>>()
            })
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is wrong with a mesh, triangles apart from their neighbours.
fn unsound(built: &Built) -> Vec<String> {
    let mut faults = Vec::new();
    let mut mesh = built.mesh.clone();
    let triangles = mesh.triangles.len();
    if !(60..=120_000).contains(&triangles) {
        faults.push(format!("{triangles} triangles"));
    }
    if !mesh.positions.iter().flatten().all(|c| c.abs() < 1.0) {
        faults.push("corners that are not finite or far away".to_owned());
    }
    if !mesh.uvs.iter().flatten().all(|c| c.abs() < 50.0) {
        faults.push("texture coordinates that are not finite or large".to_owned());
    }
    if built.parts.last().map(|part| part.triangles.end) != Some(triangles) {
        faults.push("triangles of no part".to_owned());
    }
    mesh.repair();
    faults.extend(mesh.warnings.iter().map(ToString::to_string));
    if (mesh.normals.len(), mesh.uvs.len()) != (mesh.positions.len(), mesh.positions.len()) {
        faults.push("vertices without normal or texture coordinates".to_owned());
    }
    let squared = |i: &u32| mesh.normals[*i as usize].iter().map(|c| c * c).sum::<f32>();
    let bad = mesh.triangles.iter().flatten().filter(|i| (squared(i) - 1.0).abs() > 1e-3).count();
    if bad > 0 {
        faults.push(format!("{bad} normals are no unit vectors"));
    }
    faults
}

/// Parts that promise to be solids and are not.
fn open_solids(built: &Built) -> Vec<String> {
    let mut faults = Vec::new();
    for (index, part) in built.parts.iter().enumerate().filter(|(_, part)| part.closed) {
        let (edges, volume) = edges_and_volume(built, part);
        let open = edges.values().filter(|e| **e != (0, 2)).count();
        if open > 0 || !(volume > 0.0) {
            let (parts, edges) = (built.parts.len(), edges.len());
            faults.push(format!(
                "part {index} of {parts}: {open} of {edges} edges are open, volume {volume:e}"
            ));
        }
    }
    faults
}

#[test]
fn a_key_gives_the_same_bytes_again_and_another_seed_another_object() {
    for family in families() {
        let bytes = |seed: u64| {
            let built = built(family, seed, 0.1);
            let textures: Vec<Vec<u8>> = built
                .mesh
                .materials
                .iter()
                .filter_map(|m| Some(m.texture.as_ref()?.as_raw().clone()))
                .collect();
            (built.mesh.positions, built.mesh.triangles, built.mesh.uvs, textures)
        };
        let (first, second) = (bytes(1), bytes(2));
        assert!(first == bytes(1), "{}", family.name());
        assert!(first.0 != second.0 && first.3 != second.3, "{}", family.name());
    }
}

/// The first eight bytes of the SHA-256 of each family's object 7 with small textures.
const DIGESTS: &[(&str, &str)] = &[
    ("animal", "6f1a1f36e9bc5909"),
    ("basket", "0045b32dcef706c1"),
    ("bottle", "1417bbcb7dc1b6fc"),
    ("bowl", "5fc0295d4f38a0e8"),
    ("bricks", "8ecc7f703db43356"),
    ("can", "98fed47e6188aaf6"),
    ("carton", "e8591b36fc95401f"),
    ("clutter", "c64f9c5eb243e74f"),
    ("device", "6a394c459a0eb7d2"),
    ("fruit", "e47f8c8e3d89fc2b"),
    ("furniture", "4b03739044599537"),
    ("lamp", "aae143ff5de5942f"),
    ("machine", "a4f042a33683598c"),
    ("mug", "ed00b49b545662b1"),
    ("plant", "0b419813e46db302"),
    ("sculpture", "8bc68e0095a16b36"),
    ("shoe", "78133c09ff14c1f7"),
    ("tool", "89272a8112c477aa"),
    ("vase", "a5cb5a8502c6ba44"),
    ("vehicle", "02a5caade1d0f11d"),
];

/// Labels stand for what their keys made when they were measured: a change here makes labels of made objects wrong.
#[test]
fn keys_mean_what_they_meant_when_objects_were_labelled() {
    let all: Vec<Family> = families().collect();
    let digests: Vec<(String, String)> = all
        .into_par_iter()
        .map(|family| {
            let mesh = built(family, 7, 0.1).mesh;
            let mut digest = Sha256::new();
            mesh.positions.iter().flatten().for_each(|c| digest.update(c.to_le_bytes()));
            mesh.uvs.iter().flatten().for_each(|c| digest.update(c.to_le_bytes()));
            mesh.triangles.iter().flatten().for_each(|i| digest.update(i.to_le_bytes()));
            mesh.triangle_materials.iter().for_each(|i| digest.update(i.to_le_bytes()));
            mesh.materials.iter().filter_map(|m| m.texture.clone()).for_each(|t| digest.update(t.as_raw()));
            let hexadecimal = digest.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect();
            (family.name().to_owned(), hexadecimal)
        })
        .collect();
    let wanted: Vec<(String, String)> =
        DIGESTS.iter().map(|(name, digest)| ((*name).to_owned(), (*digest).to_owned())).collect();
    assert_eq!(digests, wanted);
}

#[test]
fn made_objects_are_textured_finely() {
    for name in ["bottle", "carton", "mug"] {
        let family = families().find(|family| family.name() == name).unwrap();
        let mesh = made_object(family, 3);
        let widest = mesh.materials.iter().filter_map(|m| Some(m.texture.as_ref()?.width())).max();
        assert!(widest.is_some_and(|w| (512..=1536).contains(&w)), "{name}: {widest:?}");
    }
}

#[test]
fn a_variant_keeps_the_shape_and_changes_the_textures() {
    let entry = object_at("made:mug/4").unwrap();
    let (plain, first, second) =
        (entry.load().unwrap(), entry.variant(1).load().unwrap(), entry.variant(2).load().unwrap());
    let textures = |mesh: &crate::render::Mesh| -> Vec<Vec<u8>> {
        mesh.materials.iter().filter_map(|m| Some(m.texture.as_ref()?.as_raw().clone())).collect()
    };
    let corners = |mesh: &crate::render::Mesh| -> Vec<[f32; 3]> {
        mesh.triangles.iter().flatten().map(|i| mesh.positions[*i as usize]).collect()
    };
    assert_eq!(corners(&plain), corners(&first));
    assert!(textures(&plain) != textures(&first) && textures(&first) != textures(&second));
    assert_eq!(textures(&first), textures(&entry.variant(1).load().unwrap()));
}

#[test]
fn selections_name_ranges_lists_and_variants_once_each() {
    let keys = |texts: &[&str]| -> Vec<String> {
        select_objects(texts).unwrap().into_iter().map(|entry| entry.key).collect()
    };
    assert_eq!(keys(&["made:mug/2..4", "made:mug/3"]), ["made:mug/2", "made:mug/3"]);
    assert_eq!(keys(&["made:mug/2~texture=0..2"]), ["made:mug/2~texture=0", "made:mug/2~texture=1"]);
    assert_eq!(keys(&["made:*/7"]).len(), families().count());
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.txt");
    std::fs::write(&list, "# some\nmade:plant/1\n\nmade:mug/0..2~texture=5\n").unwrap();
    let list = list.to_string_lossy().into_owned();
    assert_eq!(keys(&[&list]), ["made:plant/1", "made:mug/0~texture=5", "made:mug/1~texture=5"]);
    std::fs::write(&list, &list).unwrap();
    assert!(select_objects(&[&list]).is_err(), "a list that names itself");
    for bad in ["made:teapot/1", "made:mug", "made:mug/x", "made:mug/1~texture=a", "/nowhere/at/all"] {
        assert!(select_objects(&[bad]).is_err(), "{bad}");
    }
    assert!(object_at("made:mug/0..2").is_err() && object_at("made:*/1").is_err());
}

#[test]
fn label_keys_are_found_again() {
    let lookup = ObjectLookup::new::<&str>(&[]).unwrap();
    let entry = lookup.get("made:mug/17~texture=3").unwrap();
    assert_eq!(
        (entry.key.as_str(), entry.texture, entry.licence.as_str()),
        ("made:mug/17~texture=3", Some(3), MADE_LICENCE)
    );
    assert_eq!(lookup.get("made:mug/17"), Some(object_at("made:mug/17").unwrap()));
    assert!(lookup.get("made:mug/1..3").is_none() && lookup.get("Scopia/oven").is_none());
}

#[test]
fn a_contact_sheet_has_a_picture_in_each_cell_and_tells_what_is_missing() {
    let mut entries = select_objects(&["made:mug/0..2"]).unwrap();
    entries.push(object_at("/nowhere/thing.obj").unwrap());
    let settings = SheetSettings { cell_px: 32, columns: 2, ..SheetSettings::default() };
    let (sheet, failures) = contact_sheet(&entries, &settings, || ());
    assert_eq!((sheet.width(), sheet.height(), failures.len()), (64, 64, 1));
    let drawn = |cell: u32| {
        let (x0, y0) = (cell % 2 * 32, cell / 2 * 32);
        (0..32 * 32).any(|i| sheet.get_pixel(x0 + i % 32, y0 + i / 32).0 != [255; 4])
    };
    assert!(drawn(0) && drawn(1) && !drawn(2));
}
