//! Solids between cross-sections.

use super::assembly::{Assembly, WHOLE};
use crate::objects::frame::V;

impl Assembly {
    /// A solid through rings of equally many points, closed by fans at both ends. The rings run anticlockwise
    /// as seen from the first end, looking at the last.
    pub(in crate::objects) fn loft(&mut self, rings: &[Vec<V>], side: u32, ends: u32) {
        self.part(true, |a| {
            a.skin(rings, true, WHOLE, side);
            if let (Some(first), Some(last)) = (rings.first(), rings.last()) {
                a.fan(first, true, WHOLE, ends);
                a.fan(last, false, WHOLE, ends);
            }
        });
    }
}
