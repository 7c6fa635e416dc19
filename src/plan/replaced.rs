//! What is said where views were replaced.

use std::collections::BTreeMap;

use super::{CoverageReport, ViewStatus, Warning};
use crate::motion::Roll;

/// The warning: `statuses` are those of the set as it was.
pub(super) fn warning(report: &CoverageReport, statuses: &[ViewStatus], roll: Roll) -> Warning {
    let CoverageReport { before, after, reachable_fraction } = report;
    let lost = statuses.len() - before.views;
    let share = reachable_fraction.map_or(String::new(), |share| format!(" {:.0} % of the", 100.0 * share));
    let hint = if roll == Roll::Fixed { "; roll \"free\" may reach more" } else { "" };
    Warning::new(
        "views_replaced",
        format!(
            "{lost} of {} views of the set cannot be taken ({}): {} views are spread over the reachable{share} \
             band instead, separation {:.1} deg and largest hole {:.1} deg, where leaving views out would plan {} \
             with {:.1} and {:.1} deg{hint}",
            statuses.len(),
            counts(statuses),
            after.views,
            after.separation_rad.to_degrees(),
            after.largest_hole_rad.to_degrees(),
            before.views,
            before.separation_rad.to_degrees(),
            before.largest_hole_rad.to_degrees(),
        ),
    )
}

/// `3 no_ik, 4 self_collision`.
fn counts(statuses: &[ViewStatus]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for status in statuses {
        if let ViewStatus::Skipped(reason) = status {
            *counts.entry(reason.code).or_default() += 1;
        }
    }
    counts.iter().map(|(code, count)| format!("{count} {code}")).collect::<Vec<_>>().join(", ")
}
