//! The service as its users meet it: a real process on a free port. One file a scenario.

mod adapted_views;
mod bad_requests;
mod cancel;
mod capture;
mod cell_bounds;
mod checks;
mod determinism;
mod events;
mod execution_refusals;
mod garbage;
mod harness;
mod objective;
mod offline_plan;
mod online_workflow;
mod openapi_drift;
mod overload;
mod prediction;
mod reachability;
mod reading;
mod refusals;
mod restart;
mod robot_limits;
mod robots_described;
mod skip_reasons;
mod skipped_views;
mod surroundings;
