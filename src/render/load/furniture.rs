//! The catalogue inside a Sweet Home 3D furniture library.

use std::collections::BTreeMap;

use nalgebra::Matrix3;

use super::MeshError;
use super::archive::Archive;
use super::text::to_text;
use crate::render::Mesh;

/// One piece of furniture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FurnitureItem {
    /// Entry of the model's OBJ file.
    pub model: String,
    /// Name, English.
    pub name: String,
    /// Category, English.
    pub category: String,
    /// Who made it; empty if unknown.
    pub creator: String,
    /// The library's licence.
    pub licence: String,
    /// Width (x), height (y up) and depth (z) in metres, where all three are given.
    pub size_m: Option<[f32; 3]>,
    /// Turns the model, y up, before it is sized; row by row.
    pub rotation: Option<[f32; 9]>,
    /// A door, a window or a staircase.
    pub opening: bool,
}

impl FurnitureItem {
    /// Turns a y-up model and stretches its box to the catalogue's size.
    pub(super) fn place(&self, mesh: &mut Mesh) {
        if let Some(rows) = self.rotation {
            let map = Matrix3::from_row_slice(&rows);
            if map.determinant().abs() > 1e-3 {
                mesh.map_linear(&map);
            }
        }
        let Some(size) = self.size_m else { return };
        let corners = mesh.triangles.iter().flatten().filter_map(|i| mesh.positions.get(*i as usize));
        let mut bounds = [(f32::MAX, f32::MIN); 3];
        for p in corners {
            for ((low, high), v) in bounds.iter_mut().zip(p) {
                (*low, *high) = (low.min(*v), high.max(*v));
            }
        }
        let mut scale = [1.0; 3];
        for ((scale, wanted), (low, high)) in scale.iter_mut().zip(size).zip(bounds) {
            let has = high - low;
            // A flat model (a rug, a picture) has no extent to stretch along its normal.
            *scale = if has > 1e-9 && has.is_finite() { wanted / has } else { 0.01 };
        }
        mesh.map_linear(&Matrix3::from_diagonal(&scale.into()));
    }
}

/// Reads `PluginFurnitureCatalog.properties`, in the order of its numbers.
///
/// # Errors
/// [`MeshError`] when the library has no catalogue or it cannot be read.
pub fn catalogue(archive: &Archive) -> Result<Vec<FurnitureItem>, MeshError> {
    Ok(parse(&to_text(archive.read("PluginFurnitureCatalog.properties")?)))
}

fn parse(text: &str) -> Vec<FurnitureItem> {
    let mut licence = String::new();
    let mut fields: BTreeMap<u32, BTreeMap<String, String>> = BTreeMap::new();
    for (key, value) in properties(text) {
        match key.split_once('#') {
            Some((field, number)) => {
                if let Ok(number) = number.parse() {
                    fields.entry(number).or_default().insert(field.to_owned(), value);
                }
            }
            None if key == "license" => licence = value,
            None => {}
        }
    }
    let mut items = Vec::new();
    for mut item in fields.into_values() {
        let mut text = |field: &str| item.remove(field).unwrap_or_default();
        let (model, category, cut_out) = (text("model"), text("category"), text("staircaseCutOutShape"));
        let opening = text("doorOrWindow") == "true"
            || !cut_out.is_empty()
            || ["Doors and windows", "Staircases"].contains(&category.as_str());
        let centimetres = [text("width"), text("height"), text("depth")].map(|t| t.parse::<f32>().ok());
        let size_m = match centimetres {
            [Some(w), Some(h), Some(d)] if w.min(h).min(d) > 0.0 && w.max(h).max(d) < 1e6 => {
                Some([w, h, d].map(|v| v / 100.0))
            }
            _ => None,
        };
        let numbers: Vec<f32> = text("modelRotation").split_whitespace().flat_map(str::parse).collect();
        items.push(FurnitureItem {
            model: model.trim_start_matches('/').to_owned(),
            name: text("name"),
            category,
            creator: text("creator"),
            licence: licence.clone(),
            size_m,
            rotation: numbers.try_into().ok(),
            opening,
        });
    }
    items.retain(|item| !item.model.is_empty());
    items
}

/// Keys and values of a Java property file: comments, continued lines and \u escapes.
fn properties(text: &str) -> Vec<(String, String)> {
    let mut out = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let line = line.trim_start();
        if line.is_empty() || line.starts_with(['#', '!']) {
            continue;
        }
        let mut whole = line.to_owned();
        while whole.ends_with('\\') && !whole.ends_with("\\\\") {
            whole.pop();
            whole.push_str(lines.next().unwrap_or_default().trim_start());
        }
        if let Some((key, value)) = whole.split_once(['=', ':']) {
            out.push((key.trim().to_owned(), unescaped(value.trim())));
        }
    }
    out
}

fn unescaped(value: &str) -> String {
    let mut out = String::with_capacity(value.len());
    let mut rest = value.chars();
    while let Some(c) = rest.next() {
        match (c, c == '\\') {
            (_, false) => out.push(c),
            _ => match rest.next() {
                Some('u') => {
                    let digits: String = rest.by_ref().take(4).collect();
                    let code = u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32);
                    out.push(code.unwrap_or(char::REPLACEMENT_CHARACTER));
                }
                Some('n') => out.push('\n'),
                Some('t') => out.push('\t'),
                Some(other) => out.push(other),
                None => {}
            },
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_catalogue_gives_names_sizes_turns_and_what_is_a_door() {
        let items = parse(
            "# comment\nid=Some#Library\nlicense=CC0\n\nid#2=x\nname#2=Caf\\u00e9 \\\n   table\ncategory#2=Living room\n\
             model#2=/a/b.obj\nwidth#2=10.5\ndepth#2=20\nheight#2=30\nmodelRotation#2=0 0 1 0 1 0 -1 0 0\n\
             name#10=Gate\nmodel#10=/c/d.obj\ndoorOrWindow#10=true\nname#11=No model\n",
        );
        let [table, gate] = items.as_slice() else { panic!("{items:?}") };
        assert_eq!((table.name.as_str(), table.model.as_str()), ("Café table", "a/b.obj"));
        assert_eq!((table.licence.as_str(), table.size_m), ("CC0", Some([0.105, 0.3, 0.2])));
        assert_eq!(table.rotation, Some([0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]));
        assert!(!table.opening && gate.opening && gate.size_m.is_none());
    }

    #[test]
    fn a_model_is_turned_before_it_is_sized() {
        let item = FurnitureItem {
            size_m: Some([1.0, 2.0, 3.0]),
            rotation: Some([0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]),
            ..FurnitureItem::default()
        };
        let mut mesh = Mesh {
            positions: vec![[0.0; 3], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        item.place(&mut mesh);
        assert_eq!(mesh.positions, [[0.0; 3], [0.0, 0.0, -3.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0]]);
    }
}
