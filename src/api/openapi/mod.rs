//! The OpenAPI document: routes and schemas out of the code, bounds out of the constants that are checked.

mod bounds;
mod everywhere;
mod table;

use bounds::Bounds;
use everywhere::Everywhere;
use utoipa::OpenApi;

use super::problem::ProblemJson;
use super::routes::{
    checks, events, executions, health, images, objects, plans, predictions, reachability, robots,
    view_spaces,
};

/// All routes; schemas follow from them.
#[derive(OpenApi)]
#[openapi(
    info(
        title = "prv",
        description = "View planning for robots that reconstruct objects they have never seen: how many views, \
            where, and one joint-space path through them.\n\nSI units, degrees only where a name ends in _deg. \
            Quaternions are x, y, z, w. Cameras have OpenCV axes: x right, y down, z forward. Poses are \
            `base_from_camera` unless named otherwise; for Universal Robots `base` is the controller's base frame \
            (`base_link` of ROS is turned by pi about z). Every refusal is an application/problem+json document \
            with a stable code; 422 names field, value and bound.",
    ),
    paths(
        plans::create, plans::list, plans::get, plans::delete, plans::request, checks::create, predictions::create, reachability::create, view_spaces::get, robots::list, robots::get,
        executions::create, executions::list, executions::get, executions::delete, executions::cancel, events::stream, images::list,
        images::get, images::transforms, objects::list, health::live, health::ready,
    ),
    components(schemas(ProblemJson)),
    modifiers(&Bounds, &Everywhere),
    tags(
        (name = "plans", description = "Plan views, order and motion"),
        (name = "views", description = "View sets"),
        (name = "robots", description = "The robots known by name"),
        (name = "executions", description = "The simulated arm and camera"),
        (name = "health", description = "For those who run the service"),
    )
)]
pub struct ApiDocument;

/// The document as committed in `openapi/openapi.json`.
pub fn openapi_json() -> String {
    let mut document = ApiDocument::openapi();
    // The port is whatever the reader has reached the document on.
    document.servers = None;
    let mut text = document.to_pretty_json().unwrap_or_default();
    text.push('\n');
    text
}
