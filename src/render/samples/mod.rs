//! Sample objects made by our own code: modelled and textured, no files needed.
//!
//! Sizes are natural ones in metres, z is up, the object stands on z = 0 and its front
//! faces -y. The same name and seed give the same bytes.

mod books;
mod bottle;
mod build;
mod globe;
mod house;
mod mug;
mod noise;
mod paint;
mod parcel;
mod plant;
mod robot;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::Mesh;

type Maker = fn(&mut ChaCha8Rng) -> Mesh;

const SAMPLES: [(&str, Maker); 8] = [
    ("books", books::make),
    ("bottle", bottle::make),
    ("globe", globe::make),
    ("house", house::make),
    ("mug", mug::make),
    ("parcel", parcel::make),
    ("plant", plant::make),
    ("robot", robot::make),
];

/// The sample objects' names, sorted.
pub fn sample_names() -> Vec<&'static str> {
    SAMPLES.iter().map(|(name, _)| *name).collect()
}

/// A sample object by name; `name:seed` with a whole number gives one in other colours and
/// proportions. `None` for a name or seed that is none.
pub fn sample_object(name: &str) -> Option<Mesh> {
    let (name, seed): (&str, u64) = match name.split_once(':') {
        Some((name, seed)) => (name, seed.parse().ok()?),
        None => (name, 0),
    };
    let index = SAMPLES.iter().position(|(known, _)| *known == name)?;
    let (_, make) = SAMPLES.get(index)?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    // A stream of its own for each kind, or all would come in the same colour.
    rng.set_stream(index as u64);
    let mut mesh = make(&mut rng);
    mesh.repair();
    Some(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_is_textured_stands_on_the_ground_and_is_reproducible() {
        for name in sample_names() {
            let mesh = sample_object(name).unwrap();
            assert!(mesh.warnings.is_empty(), "{name}: {:?}", mesh.warnings);
            assert!(mesh.has_texture() && mesh.triangles.len() >= 100, "{name}");
            let lowest = mesh.positions.iter().map(|p| p[2]).fold(f32::MAX, f32::min);
            assert!(lowest.abs() < 1e-3, "{name} starts at {lowest}");
        }
        assert_eq!(sample_object("robot").unwrap().positions, sample_object("robot").unwrap().positions);
    }

    #[test]
    fn seeds_change_the_object_and_unknown_names_are_none() {
        let bytes = |name: &str| {
            let mesh = sample_object(name).unwrap();
            mesh.materials
                .iter()
                .filter_map(|m| m.texture.clone())
                .map(|t| t.as_raw().clone())
                .collect::<Vec<_>>()
        };
        assert_ne!(bytes("mug"), bytes("mug:7"));
        assert!(sample_object("teapot").is_none() && sample_object("mug:x").is_none());
    }
}
