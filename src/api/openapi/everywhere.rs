//! What every operation has: a name of its own, and the refusals that any may answer with.

use utoipa::Modify;
use utoipa::openapi::path::{Operation, PathItem};
use utoipa::openapi::response::Response;
use utoipa::openapi::{Content, OpenApi, Ref};

/// Status and description of refusals that do not depend on the route.
const REFUSALS: [(&str, &str); 3] = [
    ("422", "A query parameter that the route does not have"),
    ("500", "The service's own mistake, or its data directory fails"),
    ("503", "Not finished in time, with Retry-After"),
];
/// A stream takes as long as its run.
const WITHOUT_TIME_LIMIT: &str = "/v1/executions/{id}/events";

/// Adds it.
pub(super) struct Everywhere;

impl Modify for Everywhere {
    fn modify(&self, document: &mut OpenApi) {
        for (path, item) in &mut document.paths.paths {
            for (method, operation) in operations(item) {
                operation.operation_id = Some(name(method, path));
                for (status, description) in REFUSALS {
                    if status == "503" && path == WITHOUT_TIME_LIMIT {
                        continue;
                    }
                    let problem = || {
                        let mut response = Response::new(description);
                        let content = Content::new(Some(Ref::from_schema_name("Problem")));
                        response.content.insert("application/problem+json".to_owned(), content);
                        response.into()
                    };
                    operation.responses.responses.entry(status.to_owned()).or_insert_with(problem);
                }
            }
        }
    }
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = (&'static str, &mut Operation)> {
    let all = [("get", &mut item.get), ("post", &mut item.post), ("delete", &mut item.delete)];
    all.into_iter().filter_map(|(method, operation)| Some((method, operation.as_mut()?)))
}

/// `get_plans_id` for GET /v1/plans/{id}: generated clients name their functions so.
fn name(method: &str, path: &str) -> String {
    let words = path.trim_start_matches("/v1").split(|c: char| !c.is_ascii_alphanumeric());
    std::iter::once(method).chain(words.filter(|word| !word.is_empty())).collect::<Vec<_>>().join("_")
}
