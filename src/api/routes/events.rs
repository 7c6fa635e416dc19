//! `/v1/executions/{id}/events`: a run as it happens.

use std::convert::Infallible;
use std::sync::Arc;

use axum::http::HeaderMap;
use axum::response::sse::{Event, KeepAlive, Sse};
use futures::stream::{Stream, unfold};
use tokio::sync::watch;

use super::refusals::RunRefusals;
use super::run::{FoundRun, RunId};
use crate::api::executions::Entry;
use crate::api::problem::Problem;

/// Where a listener stands.
struct Listener {
    entry: Arc<Entry>,
    changes: watch::Receiver<u64>,
    /// Index of the next stored event.
    next: usize,
    /// Progress has changed since it was last sent.
    progressed: bool,
}

/// A run as server-sent events.
///
/// `state` and `view` events are stored with the run and numbered from 1: a listener that comes back
/// with `Last-Event-ID` gets those it missed, also after a restart of the service. `progress` events
/// (the whole run, several times a second) carry no id. The stream ends with the run.
#[utoipa::path(
    get, path = "/v1/executions/{id}/events", tag = "executions",
    params(
        RunId,
        ("Last-Event-ID" = Option<u64>, Header, description = "The last event received"),
    ),
    responses(
        (status = 200, description = "Events state, view and progress", content_type = "text/event-stream"),
        RunRefusals,
    )
)]
pub async fn stream(
    FoundRun { entry, .. }: FoundRun,
    headers: HeaderMap,
) -> Result<Sse<impl Stream<Item = Result<Event, Infallible>>>, Problem> {
    let next = match headers.get("last-event-id") {
        None => 0,
        Some(value) => value.to_str().ok().and_then(|text| text.parse().ok()).ok_or_else(|| {
            let text = String::from_utf8_lossy(value.as_bytes()).into_owned();
            Problem::field("invalid_header", "Last-Event-ID", text, "the id of an event, a whole number")
        })?,
    };
    let listener = Listener { changes: entry.changes(), entry, next, progressed: true };
    Ok(Sse::new(unfold(listener, next_event)).keep_alive(KeepAlive::default()))
}

async fn next_event(mut listener: Listener) -> Option<(Result<Event, Infallible>, Listener)> {
    loop {
        let (stored, over) = listener.entry.event(listener.next);
        if let Some((name, data)) = stored {
            listener.next += 1;
            let event = Event::default().id(listener.next.to_string()).event(name).data(data.to_string());
            return Some((Ok(event), listener));
        }
        if over {
            return None;
        }
        if listener.progressed {
            listener.progressed = false;
            let data = serde_json::to_string(&listener.entry.execution()).unwrap_or_default();
            return Some((Ok(Event::default().event("progress").data(data)), listener));
        }
        listener.changes.changed().await.ok()?;
        listener.progressed = true;
    }
}
