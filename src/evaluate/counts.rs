//! How many views each method gives an object.

use std::collections::BTreeMap;

/// A way to choose the number of views (paper, section "Comparison to Statistic Methods").
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// The object's own label.
    Label,
    /// The most frequent label of the training objects, the smallest of several.
    Mode,
    /// Their median, rounded.
    Median,
    /// Their mean, rounded.
    Mean,
    /// The network's answer to the three initial photos.
    PrvNet,
}

impl Method {
    /// All, in the order of the paper's table.
    pub const ALL: [Method; 5] = [Method::Label, Method::Mode, Method::Median, Method::Mean, Method::PrvNet];

    /// The word in files.
    pub fn word(self) -> &'static str {
        match self {
            Method::Label => "label",
            Method::Mode => "mode",
            Method::Median => "median",
            Method::Mean => "mean",
            Method::PrvNet => "prvnet",
        }
    }

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Method::Label => "GT label",
            Method::Mode => "Mode",
            Method::Median => "Median",
            Method::Mean => "Mean",
            Method::PrvNet => "PRVNet",
        }
    }
}

/// What one number for every object would be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Statistics {
    /// Most frequent label.
    pub mode: u32,
    /// Median, rounded.
    pub median: u32,
    /// Mean, rounded.
    pub mean: u32,
}

impl Statistics {
    /// Of the labels of the training objects; `None` without any.
    pub fn of(labels: &[u32]) -> Option<Statistics> {
        let mut sorted = labels.to_vec();
        sorted.sort_unstable();
        let upper = *sorted.get(sorted.len() / 2)?;
        let lower = *sorted.get((sorted.len() - 1) / 2)?;
        let mut counts = BTreeMap::<u32, usize>::new();
        sorted.iter().for_each(|label| *counts.entry(*label).or_default() += 1);
        let most = counts.values().copied().max()?;
        let mode = counts.into_iter().find(|(_, count)| *count == most)?.0;
        let sum: f64 = sorted.iter().map(|&label| f64::from(label)).sum();
        Some(Statistics {
            mode,
            median: (f64::from(lower + upper) / 2.0).round() as u32,
            mean: (sum / sorted.len() as f64).round() as u32,
        })
    }

    /// The count of `method` for an object with this label and this prediction.
    pub fn count(&self, method: Method, label: u32, predicted: u32) -> u32 {
        match method {
            Method::Label => label,
            Method::Mode => self.mode,
            Method::Median => self.median,
            Method::Mean => self.mean,
            Method::PrvNet => predicted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_a_skewed_set_differ() {
        let statistics = Statistics::of(&[20, 20, 30, 31, 40, 70]).unwrap();
        assert_eq!(statistics, Statistics { mode: 20, median: 31, mean: 35 });
        assert_eq!(Statistics::of(&[]), None);
        assert_eq!(statistics.count(Method::Mean, 1, 2), 35);
        assert_eq!(statistics.count(Method::PrvNet, 1, 2), 2);
    }
}
