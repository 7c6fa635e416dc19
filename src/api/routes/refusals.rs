//! Refusals that several routes share, as the API description lists them.

use utoipa::IntoResponses;

use crate::api::problem::ProblemJson;

/// What a route that reads a JSON body and computes may answer instead.
#[derive(IntoResponses)]
#[allow(dead_code, reason = "described, never built")]
pub enum BodyRefusals {
    /// No JSON
    #[response(status = 400, content_type = "application/problem+json")]
    Malformed(ProblemJson),
    /// Body over 32 MiB
    #[response(status = 413, content_type = "application/problem+json")]
    TooLarge(ProblemJson),
    /// Not application/json in UTF-8, or packed (Content-Encoding)
    #[response(status = 415, content_type = "application/problem+json")]
    OtherType(ProblemJson),
    /// A member is refused: field, value and bound tell
    #[response(status = 422, content_type = "application/problem+json")]
    Refused(ProblemJson),
    /// Overloaded or not finished in time, with Retry-After; or photos were given and there is no model
    #[response(status = 503, content_type = "application/problem+json")]
    Unavailable(ProblemJson),
}

/// What a route that is about a run may answer instead.
#[derive(IntoResponses)]
#[allow(dead_code, reason = "described, never built")]
pub enum RunRefusals {
    /// No such run, or what is asked of it is not there (yet)
    #[response(status = 404, content_type = "application/problem+json")]
    Unknown(ProblemJson),
}
