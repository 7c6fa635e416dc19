//! A network with what it may be judged on: the objects that its turn holds out.

use super::counts::Statistics;
use super::held_out::is_held_out;
use crate::label::record::LabelRecord;
use crate::predict::Predictor;

/// A network and the constants it is compared with, both of the objects that its turn does not hold out.
pub struct Turn {
    /// The network.
    pub predictor: Predictor,
    /// Mode, median and mean of the labels known to it.
    pub statistics: Statistics,
}

impl Turn {
    /// `None` when no label of `records` is known to the network.
    pub fn new(predictor: Predictor, records: &[LabelRecord]) -> Option<Turn> {
        let turn = predictor.info().turn;
        let known = records.iter().filter(|record| !is_held_out(record, turn));
        let statistics = Statistics::of(&known.filter_map(|record| record.reading.v_gain).collect::<Vec<_>>())?;
        Some(Turn { predictor, statistics })
    }

    /// Whether the network may be judged on this object.
    pub fn holds_out(&self, record: &LabelRecord) -> bool {
        is_held_out(record, self.predictor.info().turn)
    }

    /// What trials of this network have in common, as JSON.
    pub fn settings(&self) -> serde_json::Value {
        let Statistics { mode, median, mean } = self.statistics;
        let info = self.predictor.info();
        serde_json::json!({ "model": info.sha256, "turn": info.turn, "mode": mode, "median": median, "mean": mean })
    }
}
