//! Reversing stretches of a tour (2-opt) while that makes it faster; states stay.

use super::states::StateTable;

/// Smallest gain that counts, as a share of the legs it comes from: less is rounding.
const LEAST_GAIN: f32 = 1e-5;

/// Reverses stretches until none is left whose reversal gains. The first entry stays.
pub(super) fn reverse_while_it_gains(table: &StateTable, tour: &mut [usize]) {
    let mut gained = true;
    while gained {
        gained = false;
        for i in 1..tour.len() {
            for k in i + 1..tour.len() {
                let (before, first, last) = (tour[i - 1], tour[i], tour[k]);
                let (mut now_s, mut then_s) = (table.time(before, first), table.time(before, last));
                if let Some(after) = tour.get(k + 1) {
                    now_s += table.time(last, *after);
                    then_s += table.time(first, *after);
                }
                if now_s - then_s > LEAST_GAIN * now_s {
                    tour[i..=k].reverse();
                    gained = true;
                }
            }
        }
    }
}
