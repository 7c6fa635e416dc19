//! A network with what it may be judged on: the objects that it holds out.

use super::counts::Statistics;
use super::held_out::is_held_out;
use crate::label::record::LabelRecord;
use crate::predict::Predictor;

/// A network and the constants it is compared with, both of the objects that it does not hold out.
pub struct Candidate {
    /// The network.
    pub predictor: Predictor,
    /// Mode, median and mean of the labels known to it.
    pub statistics: Statistics,
    /// Which of the turns it holds out.
    pub turn: u32,
}

/// Why a network cannot be judged.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum CandidateError {
    /// Judged on objects that it may have learnt from, it would look better than it is.
    #[error("the model does not say which objects it holds out (metadata prv.turn): export it again")]
    UnknownTurn,
    /// There is nothing to take mode, median and mean of.
    #[error("no label of an object that the model does not hold out")]
    NoKnownLabel,
    /// Two networks for the same objects.
    #[error("two models hold out the objects of turn {0}")]
    SameTurn(u32),
}

impl Candidate {
    /// The networks, each to be judged on what it holds out of `records`.
    ///
    /// # Errors
    /// [`CandidateError`].
    pub fn all(
        predictors: Vec<Predictor>,
        records: &[LabelRecord],
    ) -> Result<Vec<Candidate>, CandidateError> {
        let mut candidates: Vec<Candidate> = Vec::new();
        for predictor in predictors {
            let turn = predictor.info().turn.ok_or(CandidateError::UnknownTurn)?;
            if candidates.iter().any(|other| other.turn == turn) {
                return Err(CandidateError::SameTurn(turn));
            }
            let known = records.iter().filter(|record| !is_held_out(&record.object, turn));
            let labels: Vec<u32> = known.filter_map(|record| record.reading.v_gain).collect();
            let statistics = Statistics::of(&labels).ok_or(CandidateError::NoKnownLabel)?;
            candidates.push(Candidate { predictor, statistics, turn });
        }
        Ok(candidates)
    }

    /// Whether the network may be judged on this object.
    pub fn holds_out(&self, record: &LabelRecord) -> bool {
        is_held_out(&record.object, self.turn)
    }

    /// What trials of this network have in common, as JSON.
    pub fn settings(&self) -> serde_json::Value {
        let Statistics { mode, median, mean } = self.statistics;
        let model = &self.predictor.info().sha256;
        serde_json::json!({ "model": model, "turn": self.turn, "mode": mode, "median": median, "mean": mean })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predict::model_bytes;

    #[test]
    fn a_network_is_judged_once_and_on_nothing_that_it_knows() {
        let shipped = || Predictor::load(&model_bytes(None).unwrap(), 1, 1).unwrap();
        let turn = shipped().info().turn.unwrap();
        let twice = Candidate::all(vec![shipped(), shipped()], &[]);
        assert_eq!(twice.err(), Some(CandidateError::NoKnownLabel));
        let records = crate::label::store::read_labels("models/labels.csv".as_ref()).unwrap();
        let twice = Candidate::all(vec![shipped(), shipped()], &records);
        assert_eq!(twice.err(), Some(CandidateError::SameTurn(turn)));
        let candidates = Candidate::all(vec![shipped()], &records).unwrap();
        let held_out = records.iter().filter(|record| candidates[0].holds_out(record)).count();
        assert!(
            (records.len() / 10..records.len() / 3).contains(&held_out),
            "{held_out} of {}",
            records.len()
        );
        assert!(candidates[0].predictor.info().trained_on as usize <= records.len() - held_out);
    }
}
