//! How far off a prediction may be.

/// Least and largest number of views an interval names; the service plans no more.
const COUNTS: (f64, f64) = (1.0, 200.0);

/// What to add to an answer to get the ends of the interval that holds [`Self::LEVEL`] of all labels.
///
/// `models/training` takes both from errors on objects that the network answering was not trained on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntervalOffsets {
    /// To the lower end, views; at most 0.
    pub low: f64,
    /// To the upper end, views; at least 0.
    pub high: f64,
}

impl IntervalOffsets {
    /// Share of labels inside the interval.
    pub const LEVEL: f64 = 0.8;

    /// The whole numbers within the offsets of `raw`, and at least `raw` rounded: `[low, high]`, 1 to 200.
    pub fn around(&self, raw: f64) -> [u32; 2] {
        let whole = |value: f64| value.clamp(COUNTS.0, COUNTS.1) as u32;
        let rounded = whole(raw.round());
        [whole((raw + self.low).ceil()).min(rounded), whole((raw + self.high).floor()).max(rounded)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_ends_are_the_outermost_whole_numbers_inside() {
        let offsets = IntervalOffsets { low: -7.5, high: 10.2 };
        assert_eq!(offsets.around(30.4), [23, 40]);
        assert_eq!(offsets.around(2.0), [1, 12]);
        assert_eq!(offsets.around(195.0), [188, 200]);
    }

    proptest! {
        #[test]
        fn the_rounded_answer_is_always_inside(raw in 1.0..200.0_f64, low in -60.0..=0.0_f64, high in 0.0..60.0_f64) {
            let [from, to] = IntervalOffsets { low, high }.around(raw);
            let rounded = raw.round() as u32;
            prop_assert!(1 <= from && from <= rounded && rounded <= to && to <= 200);
        }
    }
}
