//! `application/problem+json` (RFC 9457): every refusal the service makes.

use std::ops::{Deref, DerefMut};

use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

/// Why a request was refused. `code` is stable; `field`, `value` and `bound` are there whenever
/// one member of the request is to blame.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[schema(as = Problem, example = json!({"type": "about:blank", "title": "Unprocessable Entity", "status": 422, "code": "out_of_range", "detail": "object.radius is -0.1, must be from 0.005 to 1 m", "field": "object.radius", "value": -0.1, "bound": "from 0.005 to 1 m"}))]
pub struct ProblemJson {
    /// Always `about:blank`: the `code` tells problems apart.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// The status in words.
    pub title: &'static str,
    /// The HTTP status.
    pub status: u16,
    /// Stable name of the problem.
    pub code: String,
    /// For people.
    pub detail: String,
    /// Path of the offending member, such as `object.center[2]` or `images[0]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
    /// The offending value, shortened.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<serde_json::Value>,
    /// What the value must be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<String>,
    /// Sent as `Retry-After`, seconds.
    #[serde(skip)]
    #[schema(ignore)]
    pub retry_after_s: Option<u32>,
}

/// A [`ProblemJson`] as an error: boxed, since results are passed around far more often than refused.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Problem(Box<ProblemJson>);

impl Deref for Problem {
    type Target = ProblemJson;

    fn deref(&self) -> &ProblemJson {
        &self.0
    }
}

impl DerefMut for Problem {
    fn deref_mut(&mut self) -> &mut ProblemJson {
        &mut self.0
    }
}

impl Problem {
    /// A problem without a field.
    pub fn new(status: StatusCode, code: &str, detail: impl Into<String>) -> Self {
        Self(Box::new(ProblemJson {
            kind: "about:blank",
            title: status.canonical_reason().unwrap_or("Error"),
            status: status.as_u16(),
            code: code.to_owned(),
            detail: detail.into(),
            field: None,
            value: None,
            bound: None,
            retry_after_s: None,
        }))
    }

    /// A refused member of the request: status 422.
    pub fn field(
        code: &str,
        field: impl Into<String>,
        value: impl Into<serde_json::Value>,
        bound: impl Into<String>,
    ) -> Self {
        let (field, value, bound) = (field.into(), shorten(value.into()), bound.into());
        let detail = match &value {
            serde_json::Value::Null => format!("{field} is missing, must be {bound}"),
            value => format!("{field} is {value}, must be {bound}"),
        };
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, code, detail).at(field, value, bound)
    }

    /// Names the member to blame.
    pub fn at(
        mut self,
        field: impl Into<String>,
        value: impl Into<serde_json::Value>,
        bound: impl Into<String>,
    ) -> Self {
        self.field = Some(field.into());
        self.value = Some(shorten(value.into()));
        self.bound = Some(bound.into());
        self
    }

    /// The same problem with its member named as another request names it, in its text too.
    pub fn rename(mut self, name: impl FnOnce(&str) -> String) -> Self {
        if let Some(field) = self.field.take() {
            let named = name(&field);
            if let Some(rest) = self.detail.strip_prefix(&field) {
                self.detail = format!("{named}{rest}");
            }
            self.field = Some(named);
        }
        self
    }

    /// Another status.
    pub fn with_status(mut self, status: StatusCode) -> Self {
        self.title = status.canonical_reason().unwrap_or("Error");
        self.status = status.as_u16();
        self
    }

    /// 404 for a resource.
    pub fn not_found(code: &str, field: &str, value: &str, bound: impl Into<String>) -> Self {
        Self::field(code, field, value, bound).with_status(StatusCode::NOT_FOUND)
    }

    /// 503 with the time to wait.
    pub fn unavailable(code: &str, detail: impl Into<String>, retry_after_s: Option<u32>) -> Self {
        let mut problem = Self::new(StatusCode::SERVICE_UNAVAILABLE, code, detail);
        problem.retry_after_s = retry_after_s;
        problem
    }

    /// 500: an error that no request should be able to cause.
    pub fn internal(detail: impl Into<String>) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "internal", detail)
    }
}

/// Values are echoed so that they can be recognised, not sent back whole. Whole numbers are
/// written as such: JSON knows no difference between 64 and 64.0, but readers do.
fn shorten(value: serde_json::Value) -> serde_json::Value {
    const LONGEST: usize = 80;
    const LARGEST_WHOLE: f64 = 1e15;
    match value {
        serde_json::Value::Number(number) => match number.as_f64() {
            Some(float) if number.is_f64() && float.fract() == 0.0 && float.abs() < LARGEST_WHOLE => {
                (float as i64).into()
            }
            _ => serde_json::Value::Number(number),
        },
        serde_json::Value::String(text) if text.chars().count() > LONGEST => {
            let head: String = text.chars().take(LONGEST).collect();
            serde_json::Value::String(format!("{head}... ({} characters)", text.chars().count()))
        }
        serde_json::Value::Array(items) if items.len() > 16 => format!("array of {}", items.len()).into(),
        serde_json::Value::Array(items) => items.into_iter().map(shorten).collect(),
        serde_json::Value::Object(members) if members.len() > 16 => {
            format!("object of {} members", members.len()).into()
        }
        serde_json::Value::Object(members) => {
            serde_json::Value::Object(members.into_iter().map(|(k, v)| (k, shorten(v))).collect())
        }
        other => other,
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        if self.status >= 500 {
            tracing::error!(code = %self.code, detail = %self.detail, "refused");
        }
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let body = serde_json::to_vec(&self).unwrap_or_default();
        let mut response = (status, body).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("application/problem+json"));
        if let Some(seconds) = self.retry_after_s {
            headers.insert(header::RETRY_AFTER, HeaderValue::from(seconds));
        }
        response
    }
}
