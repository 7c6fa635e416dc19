//! Kinds of made objects: one file each, and what they share.
//!
//! Sizes are natural ones in metres, z is up, fronts face -y.

mod animal;
mod basket;
mod bottle;
mod bowl;
mod bricks;
mod can;
mod carton;
mod clutter;
mod cup;
mod device;
mod fruit;
mod furniture;
mod lamp;
mod machine;
mod plant;
mod sculpture;
mod shoe;
mod style;
mod tool;
mod vase;
mod vehicle;
mod vessel;

use super::dice::Dice;
use super::shape::{Assembly, Built};
use crate::render::Mesh;

type Maker = fn(&mut Dice) -> Assembly;

/// Name, what it holds, how it is made; sorted by name.
const FAMILIES: [(&str, &str, Maker); 20] = [
    ("animal", "toy animals: four-legged, sitting, birds, fish", animal::make),
    ("basket", "baskets, crates and cages, empty or filled", basket::make),
    ("bottle", "bottles, jars and flasks with labels and caps", bottle::make),
    ("bowl", "bowls, pans and pots, empty or filled", bowl::make),
    ("bricks", "constructions of building bricks", bricks::make),
    ("can", "spray cans, food tins, drink cans, buckets", can::make),
    ("carton", "printed packages, open cartons, milk cartons, presents, parcels", carton::make),
    ("clutter", "two to five other objects, stacked or side by side", clutter::make),
    ("device", "remote controls, telephones, game controllers, cameras, radios", device::make),
    ("fruit", "fruit and vegetables, single or in bunches", fruit::make),
    ("furniture", "model chairs, tables, shelves and racks", furniture::make),
    ("lamp", "desk lamps, table lamps, lanterns", lamp::make),
    ("machine", "gears, flanges, pipes, heat sinks, engines", machine::make),
    ("mug", "mugs, cups, tumblers, jugs, with saucer or spoon", cup::make),
    ("plant", "potted plants, cacti, flowers, grass", plant::make),
    ("sculpture", "knots, columns, stones, crystals, lattices, spirals", sculpture::make),
    ("shoe", "shoes and boots, single or in pairs", shoe::make),
    ("tool", "hammers, screwdrivers, wrenches, pliers, brushes, saws", tool::make),
    ("vase", "vases and urns, with or without branches", vase::make),
    ("vehicle", "toy cars, trucks, locomotives, aeroplanes, boats", vehicle::make),
];

/// A kind of made object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family(usize);

impl Family {
    /// What keys call it.
    pub fn name(self) -> &'static str {
        FAMILIES.get(self.0).map_or("", |family| family.0)
    }

    /// What it holds, for people.
    pub fn description(self) -> &'static str {
        FAMILIES.get(self.0).map_or("", |family| family.1)
    }
}

/// All families, sorted by name.
pub fn families() -> impl Iterator<Item = Family> {
    (0..FAMILIES.len()).map(Family)
}

/// The object of a family and seed: textured, ready to be fitted. The same on every machine.
pub fn made_object(family: Family, seed: u64) -> Mesh {
    let mut mesh = built(family, seed, 1.0).mesh;
    mesh.repair();
    mesh
}

/// The object with its parts, before it gets normals; `detail` scales the textures.
pub(super) fn built(family: Family, seed: u64, detail: f64) -> Built {
    let Some((name, _, make)) = FAMILIES.get(family.0) else { return Assembly::new().finish(detail) };
    make(&mut Dice::of(name, seed)).finish(detail)
}
