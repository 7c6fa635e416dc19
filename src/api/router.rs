//! Routes and what surrounds them.

use std::any::Any;
use std::time::Duration;

use axum::Router;
use axum::extract::{Request, State};
use axum::http::{Method, StatusCode, Uri};
use axum::middleware::{Next, from_fn, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use tower::ServiceBuilder;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, RequestId, SetRequestIdLayer};
use tower_http::trace::TraceLayer;
use utoipa_swagger_ui::{Config, SwaggerUi};

use super::extract::refuse_query;
use super::openapi::openapi_json;
use super::problem::Problem;
use super::routes::{
    checks, events, executions, health, images, json_bytes, objects, plans, predictions, reachability,
    robots, view_spaces,
};
use super::state::AppState;

/// The service's router.
pub fn router(app: AppState) -> Router {
    let plain = Router::new()
        .route("/v1/plans", post(plans::create).get(plans::list))
        .route("/v1/plans/{id}", get(plans::get).delete(plans::delete))
        .route("/v1/plans/{id}/request", get(plans::request))
        .route("/v1/checks", post(checks::create))
        .route("/v1/predictions", post(predictions::create))
        .route("/v1/robots", get(robots::list))
        .route("/v1/robots/{model}", get(robots::get))
        .route("/v1/objects", get(objects::list))
        .route("/v1/executions", post(executions::create).get(executions::list))
        .route("/v1/executions/{id}", get(executions::get).delete(executions::delete))
        .route("/v1/executions/{id}/cancel", post(executions::cancel))
        .route("/v1/executions/{id}/images", get(images::list))
        .route("/v1/executions/{id}/images/{view}", get(images::get))
        .route("/v1/executions/{id}/transforms.json", get(images::transforms))
        .route("/livez", get(health::live))
        .route("/readyz", get(health::ready))
        .route("/openapi.json", get(|| async { json_bytes(openapi_json()) }))
        .route_layer(from_fn(refuse_query));
    // These check their query parameters themselves.
    let with_query = Router::new()
        .route("/v1/reachability", post(reachability::create))
        .route("/v1/view-spaces/{n}", get(view_spaces::get));
    let timed = plain.merge(with_query).layer(from_fn_with_state(app.config.request_timeout, time_limit));
    // A stream of events lasts as long as its run.
    let streams = Router::new()
        .route("/v1/executions/{id}/events", get(events::stream))
        .route_layer(from_fn(refuse_query));
    let docs: Router<AppState> = SwaggerUi::new("/docs").config(Config::from("/openapi.json")).into();
    let around = ServiceBuilder::new()
        .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
        .layer(TraceLayer::new_for_http().make_span_with(span))
        .layer(PropagateRequestIdLayer::x_request_id())
        .layer(CatchPanicLayer::custom(panicked));
    Router::new()
        .merge(timed)
        .merge(streams)
        .merge(docs)
        .fallback(no_route)
        .method_not_allowed_fallback(wrong_method)
        .with_state(app)
        .layer(around)
}

async fn time_limit(State(limit): State<Duration>, request: Request, next: Next) -> Response {
    match tokio::time::timeout(limit, next.run(request)).await {
        Ok(response) => response,
        Err(_) => {
            // What was under way has been asked to stop.
            let text = format!(
                "not finished within {} s and stopped; ask for less (fewer views or roll samples), again when the \
                 service is less busy, or start it with a longer --request-timeout-s",
                limit.as_secs_f64()
            );
            Problem::unavailable("timeout", text, Some(5)).into_response()
        }
    }
}

fn span(request: &axum::http::Request<axum::body::Body>) -> tracing::Span {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok());
    tracing::info_span!(
        "request",
        method = %request.method(),
        path = %request.uri().path(),
        id = id.unwrap_or("-")
    )
}

/// The last resort: nothing that a request can hold should get here.
fn panicked(panic: Box<dyn Any + Send>) -> Response {
    let text = panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("unknown");
    tracing::error!(panic = text, "a handler panicked");
    Problem::internal("the service made a mistake; it is in its log").into_response()
}

async fn no_route(uri: Uri) -> Problem {
    Problem::not_found("no_such_route", "path", uri.path(), "a route of /openapi.json (to read: /docs)")
}

async fn wrong_method(method: Method, uri: Uri) -> Problem {
    let bound = format!("a method that /openapi.json lists for {}", uri.path());
    Problem::field("wrong_method", "method", method.as_str(), bound)
        .with_status(StatusCode::METHOD_NOT_ALLOWED)
}
