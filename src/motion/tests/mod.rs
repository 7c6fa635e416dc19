//! Scenarios of the whole room.

mod cells;
mod scenarios;
