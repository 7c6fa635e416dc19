//! The service: the only room that knows HTTP and JSON.
//!
//! `wire` is the JSON, `convert` its meaning, `errors` the refusals, `routes` the handlers, `store`
//! the files, `executions` the runs. [`Planner`] serves the command line too.

mod checker;
mod config;
mod convert;
mod drawing;
mod errors;
mod executions;
mod extract;
mod heavy;
mod openapi;
mod planner;
mod problem;
mod router;
mod routes;
mod server;
mod state;
mod store;
mod wire;

pub use checker::check_plan;
pub use config::ServiceConfig;
pub use convert::{coverage_json, robot_details, warnings_json};
pub use drawing::{plan_panel, reach_map};
pub use extract::{MAX_BODY_BYTES, parse_json};
pub use openapi::openapi_json;
pub use planner::{Planner, ResolvedRequest, reachability_of};
pub use problem::{Problem, ProblemJson};
pub use server::serve;
pub use wire::{
    CheckAnswer, CheckedPlanJson, CoverageReportJson, PlanAnswer, PlanRequestJson, ReachabilityAnswer,
    WarningJson,
};
