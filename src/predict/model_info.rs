//! What a model file says about itself, and whether this code can run it.

use ort::session::Session;

use ort::value::{Outlet, TensorElementType, ValueType};
use sha2::{Digest, Sha256};

use super::PredictError;
use super::crop::CROP_HALF_SIZE_M;
use super::interval::IntervalOffsets;

/// The name of the model's one input, `[images, 3, S, S]`.
pub(super) const INPUT: &str = "images";
/// The name of the model's answer, `[1]`.
pub(super) const VIEW_COUNT: &str = "view_count";
/// The name of the model's score of unlikeness, `[1]`.
pub(super) const NOVELTY: &str = "novelty";
/// Format of input, output and metadata that this code reads; `models/training` writes it.
const FORMAT: &str = "2";

/// What `models/training` wrote into the model's metadata (keys `prv.*`).
#[derive(Clone, Debug, PartialEq)]
pub struct ModelInfo {
    /// Side S of the square input images, pixels.
    pub input_size: u32,
    /// Smallest view count the model can answer.
    pub label_min: u32,
    /// Largest view count the model can answer.
    pub label_max: u32,
    /// The encoder's name.
    pub encoder: String,
    /// How many labelled objects it was trained on.
    pub trained_on: u32,
    /// Which objects were held out (`prvnet.splits`, `evaluate::held_out`), if the file says so.
    pub turn: Option<u32>,
    /// Mean absolute error on objects it was not trained on, views.
    pub held_out_l1: f64,
    /// Mean absolute error of the best constant on the same objects, views.
    pub best_constant_l1: f64,
    /// The interval around an answer that holds 80 % of labels.
    pub interval: IntervalOffsets,
    /// Radii of the objects it was trained on, least and largest, metres.
    pub radius_m: (f64, f64),
    /// SHA-256 of the model file, hexadecimal: tells two models apart.
    pub sha256: String,
}

impl ModelInfo {
    /// Reads the metadata of `session`, made from `model`, and checks its input and output against it.
    ///
    /// # Errors
    /// [`PredictError::Model`] names the first thing that does not fit.
    pub(super) fn read(session: &Session, model: &[u8]) -> Result<Self, PredictError> {
        let metadata = session
            .metadata()
            .map_err(|error| PredictError::Session { action: "load", reason: error.to_string() })?;
        let text = |key: &str| {
            let key = format!("prv.{key}");
            metadata.custom(&key).ok_or_else(|| wrong(&format!("metadata {key}"), "missing", "present"))
        };
        let count = |key: &str, low: u32, high: u32| {
            let value = text(key)?;
            value.parse().ok().filter(|count| (low..=high).contains(count)).ok_or_else(|| {
                wrong(&format!("metadata prv.{key}"), &value, &format!("an integer from {low} to {high}"))
            })
        };
        let error_figure =
            |key: &str| {
                let value = text(key)?;
                value.parse::<f64>().ok().filter(|figure| figure.is_finite() && *figure >= 0.0).ok_or_else(
                    || wrong(&format!("metadata prv.{key}"), &value, "a finite number of at least 0"),
                )
            };
        let format = text("format")?;
        if format != FORMAT {
            let bound = format!("{FORMAT}: export the model again with this version's models/training");
            return Err(wrong("metadata prv.format", &format, &bound));
        }
        let half_size = error_figure("crop_half_size_m")?;
        if (half_size - CROP_HALF_SIZE_M).abs() > 1e-9 {
            let bound = format!("{CROP_HALF_SIZE_M}, this version's window");
            return Err(wrong("metadata prv.crop_half_size_m", &half_size.to_string(), &bound));
        }
        let label_min = count("label_min", 1, 200)?;
        let within = |key: &str, low: f64, high: f64| {
            let value = text(key)?;
            value.parse::<f64>().ok().filter(|number| (low..=high).contains(number)).ok_or_else(|| {
                wrong(&format!("metadata prv.{key}"), &value, &format!("from {low} to {high}"))
            })
        };
        within("interval_level", IntervalOffsets::LEVEL, IntervalOffsets::LEVEL)?;
        let interval = IntervalOffsets {
            low: within("interval_low", -200.0, 0.0)?,
            high: within("interval_high", 0.0, 200.0)?,
        };
        let least_radius_m = within("radius_min_m", 1e-3, 1.0)?;
        let info = Self {
            input_size: count("input_size", 32, 1024)?,
            label_min,
            label_max: count("label_max", label_min, 200)?,
            encoder: text("encoder")?,
            trained_on: count("trained_on", 1, u32::MAX)?,
            turn: metadata.custom("prv.turn").is_some().then(|| count("turn", 0, 4)).transpose()?,
            held_out_l1: error_figure("held_out_l1")?,
            best_constant_l1: error_figure("best_constant_l1")?,
            interval,
            radius_m: (least_radius_m, within("radius_max_m", least_radius_m, 1.0)?),
            sha256: Sha256::digest(model).iter().map(|byte| format!("{byte:02x}")).collect(),
        };
        info.check_ports(session)?;
        Ok(info)
    }

    fn check_ports(&self, session: &Session) -> Result<(), PredictError> {
        let side = i64::from(self.input_size);
        let fits = |port: &Outlet, name: &str, wanted: &[i64]| {
            port.name() == name
                && matches!(port.dtype(), ValueType::Tensor { ty: TensorElementType::Float32, shape, .. }
                    if shape.iter().eq(wanted))
        };
        let refused = |field: &str, ports: &[Outlet], bound: String| {
            let found: Vec<_> = ports.iter().map(|port| (port.name(), port.dtype())).collect();
            Err(wrong(field, &format!("{found:?}"), &bound))
        };
        match session.inputs() {
            [images] if fits(images, INPUT, &[-1, 3, side, side]) => {}
            ports => {
                let bound = format!("one float tensor {INPUT:?} of [any, 3, {side}, {side}]");
                return refused("input", ports, bound);
            }
        }
        match session.outputs() {
            [count, novelty] if fits(count, VIEW_COUNT, &[1]) && fits(novelty, NOVELTY, &[1]) => {}
            ports => {
                let bound = format!("two float tensors of [1], {VIEW_COUNT:?} and {NOVELTY:?}");
                return refused("output", ports, bound);
            }
        }
        Ok(())
    }
}

fn wrong(field: &str, value: &str, bound: &str) -> PredictError {
    PredictError::Model { field: field.to_owned(), value: value.to_owned(), bound: bound.to_owned() }
}
