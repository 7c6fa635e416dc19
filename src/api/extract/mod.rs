//! Extractors whose rejections are problems.

mod body;
mod json;
mod media;
mod member;
mod parameters;
mod twice;

pub use body::{BodyBytes, MAX_BODY_BYTES};
pub use json::{JsonBody, parse_json};
pub use parameters::{PathParam, QueryParams, refuse_query};
