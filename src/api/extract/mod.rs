//! Extractors whose rejections are problems.

mod body;
mod json;
mod member;
mod parameters;

pub use body::{BodyBytes, MAX_BODY_BYTES};
pub use json::{JsonBody, parse_json};
pub use parameters::{PathParam, QueryParams};
