//! From a request's JSON to an answer's, the same for the service and the command line.

use std::path::Path;
use std::time::Instant;

use sha2::{Digest, Sha256};

use super::convert;
use super::problem::Problem;
use super::wire::{PlanAnswer, PlanRequestJson, PredictionAnswer, PredictionRequest, ReachabilityAnswer};
use crate::motion::Stop;
use crate::plan::{self, expected_views, make_plan_until, predict_count};
use crate::predict::{Predictor, model_bytes};

/// A request in its canonical form: requests that mean the same are the same, and so are their plans.
#[derive(Clone, Debug)]
pub struct ResolvedRequest(PlanRequestJson);

impl From<PlanRequestJson> for ResolvedRequest {
    fn from(json: PlanRequestJson) -> Self {
        Self(convert::canonical(json))
    }
}

impl ResolvedRequest {
    /// The request without its photos, which are not kept.
    pub fn without_images(self) -> PlanRequestJson {
        PlanRequestJson { images: None, ..self.0 }
    }
}

/// Plans requests with one model, or without when none can be had.
pub struct Planner {
    predictor: Result<Predictor, String>,
}

impl Planner {
    /// Loads the model of `file`, or the shipped one. A model that cannot be loaded is no error
    /// here: plans with a given number of views need none. [`Planner::missing`] tells.
    pub fn load(file: Option<&Path>, threads: usize, pool: usize) -> Self {
        let load = || Predictor::load(&model_bytes(file)?, threads, pool);
        Self { predictor: load().map_err(|error| error.to_string()) }
    }

    /// Why there is no prediction, if there is none.
    pub fn missing(&self) -> Option<&str> {
        self.predictor.as_ref().err().map(String::as_str)
    }

    /// SHA-256 of the model, `none` without one.
    pub fn model_hash(&self) -> &str {
        self.predictor.as_ref().map_or("none", |predictor| &predictor.info().sha256)
    }

    /// The id of a request's plan: a hash of what it means, this version and the model.
    ///
    /// # Errors
    /// None that a request can cause.
    pub fn plan_id(&self, request: &ResolvedRequest) -> Result<String, Problem> {
        let canonical = convert::identity(&request.0).map_err(|e| Problem::internal(e.to_string()))?;
        let mut hash = Sha256::new();
        for part in [env!("CARGO_PKG_VERSION").as_bytes(), self.model_hash().as_bytes(), &canonical] {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part);
        }
        Ok(hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect())
    }

    /// Plans a request.
    ///
    /// # Errors
    /// A [`Problem`] for what cannot be planned.
    pub fn plan(&self, resolved: &ResolvedRequest) -> Result<PlanAnswer, Problem> {
        self.plan_until(resolved, &Stop::default())
    }

    /// [`Planner::plan`], which ends with a problem soon after `stop` is asked for.
    ///
    /// # Errors
    /// A [`Problem`] for what cannot be planned.
    pub fn plan_until(&self, resolved: &ResolvedRequest, stop: &Stop) -> Result<PlanAnswer, Problem> {
        let begin = Instant::now();
        let id = self.plan_id(resolved)?;
        let request = convert::plan_request(&resolved.0)?;
        let decoded = begin.elapsed();
        let predictor = self.predictor.as_ref().map_err(String::as_str);
        let mut plan = make_plan_until(&request, predictor, stop)?;
        // From here the total includes hashing and decoding the request.
        plan.timings.retain(|(name, _)| *name != "total");
        plan.timings.extend([("decode", decoded), ("total", begin.elapsed())]);
        Ok(convert::plan_answer(id, plan))
    }

    /// Predicts the number of views.
    ///
    /// # Errors
    /// A [`Problem`] for what cannot be predicted.
    pub fn predict(&self, json: &PredictionRequest) -> Result<PredictionAnswer, Problem> {
        let begin = Instant::now();
        let request = convert::prediction_request(json)?;
        let decoded = begin.elapsed();
        let mut warnings = plan::check(&request)?;
        let predictor =
            self.predictor.as_ref().map_err(|cause| plan::PlanError::NoPredictor { cause: cause.clone() })?;
        let (prediction, doubts) = predict_count(&request, predictor)?;
        warnings.extend(doubts);
        let timings =
            [("decode", decoded), ("predict", begin.elapsed() - decoded), ("total", begin.elapsed())];
        Ok(PredictionAnswer {
            predicted: prediction.rounded,
            raw: prediction.raw,
            interval: prediction.interval,
            novelty: prediction.novelty,
            model: self.model_hash().to_owned(),
            expected_image_poses: convert::expected_views(&expected_views(
                &request.view_space(),
                json.images.len(),
            )),
            warnings: convert::warnings_json(&warnings),
            timings_ms: convert::timings_json(&timings),
        })
    }
}

/// Answers `POST /v1/reachability`: see [`plan::reachability`].
///
/// # Errors
/// A [`Problem`] for what cannot be asked.
pub fn reachability_of(
    json: &PlanRequestJson,
    elevations: Option<usize>,
    azimuths: Option<usize>,
    stop: &Stop,
) -> Result<ReachabilityAnswer, Problem> {
    let request = convert::reachability_request(json)?;
    Ok(convert::reachability_answer(&plan::reachability_until(&request, elevations, azimuths, stop)?))
}
