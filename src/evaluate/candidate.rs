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
    /// Labels that the statistics are of.
    pub known: usize,
}

/// Why a network cannot be judged.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum CandidateError {
    /// Judged on objects that it may have learnt from, it would look better than it is.
    #[error("the model does not say which objects it holds out (metadata prv.turn): export it again")]
    UnknownTurn,
    /// It has learnt from labels that the file lacks, so that what it holds out of the file tells nothing.
    #[error(
        "the model has learnt from {trained_on} labels, of those it may know the file has {known} in the first sizes that count"
    )]
    OtherLabels {
        /// Labels it has learnt from.
        trained_on: u32,
        /// Labels of the file that it does not hold out.
        known: usize,
    },
    /// There is nothing to take mode, median and mean of.
    #[error("no label of an object that the model does not hold out")]
    NoKnownLabel,
    /// Two networks for the same objects.
    #[error("two models hold out the objects of turn {0}")]
    SameTurn(u32),
}

impl Candidate {
    /// The networks, each to be judged on what it holds out of `records`, and compared with the statistics of the
    /// first `sizes` sizes of all other objects.
    ///
    /// # Errors
    /// [`CandidateError`].
    pub fn all(
        predictors: Vec<Predictor>,
        records: &[LabelRecord],
        sizes: u64,
    ) -> Result<Vec<Candidate>, CandidateError> {
        let mut candidates: Vec<Candidate> = Vec::new();
        for predictor in predictors {
            let turn = predictor.info().turn.ok_or(CandidateError::UnknownTurn)?;
            if candidates.iter().any(|other| other.turn == turn) {
                return Err(CandidateError::SameTurn(turn));
            }
            let known =
                records.iter().filter(|record| record.draw < sizes && !is_held_out(&record.object, turn));
            let labels: Vec<u32> = known.filter_map(|record| record.reading.v_gain).collect();
            let statistics = Statistics::of(&labels).ok_or(CandidateError::NoKnownLabel)?;
            let (trained_on, known) = (predictor.info().trained_on, labels.len());
            if trained_on as usize > known {
                return Err(CandidateError::OtherLabels { trained_on, known });
            }
            candidates.push(Candidate { predictor, statistics, turn, known });
        }
        Ok(candidates)
    }

    /// Whether the network may be judged on this label: of an object that it holds out, at its first size, since two
    /// sizes of an object are not independent.
    pub fn may_be_judged_on(&self, record: &LabelRecord) -> bool {
        record.draw == 0 && is_held_out(&record.object, self.turn)
    }

    /// What trials of this network have in common, as JSON.
    pub fn settings(&self) -> serde_json::Value {
        let Statistics { mode, median, mean } = self.statistics;
        let info = self.predictor.info();
        serde_json::json!({
            "model": info.sha256, "trained_on": info.trained_on, "turn": self.turn, "labels": self.known,
            "mode": mode, "median": median, "mean": mean,
        })
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
        let twice = Candidate::all(vec![shipped(), shipped()], &[], 1);
        assert_eq!(twice.err(), Some(CandidateError::NoKnownLabel));
        let records = crate::label::store::read_labels("models/labels.csv".as_ref()).unwrap();
        let twice = Candidate::all(vec![shipped(), shipped()], &records, 2);
        assert_eq!(twice.err(), Some(CandidateError::SameTurn(turn)));
        let few = Candidate::all(vec![shipped()], &records[..100], 2);
        assert!(matches!(few.err(), Some(CandidateError::OtherLabels { known: ..100, .. })));
        let first_sizes = records.iter().filter(|record| record.draw == 0).count();
        let one = Candidate::all(vec![shipped()], &records, 1);
        assert!(
            matches!(one.err(), Some(CandidateError::OtherLabels { known, .. }) if known < first_sizes),
            "it has learnt from both sizes"
        );

        let candidate = Candidate::all(vec![shipped()], &records, 2).unwrap().remove(0);
        let judged = records.iter().filter(|record| candidate.may_be_judged_on(record)).count();
        assert!((first_sizes / 10..first_sizes / 3).contains(&judged), "{judged} of {first_sizes}");
        let held_out = records.iter().filter(|record| is_held_out(&record.object, turn)).count();
        assert_eq!(candidate.known + held_out, records.len());
        assert!(
            records.iter().all(|record| !(record.draw == 1 && candidate.may_be_judged_on(record))),
            "two sizes of an object are not independent"
        );
    }
}
