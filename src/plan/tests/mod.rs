//! Scenarios of the whole room.

mod checks;
mod hard_requests;
mod requests;
mod slow_arms;
