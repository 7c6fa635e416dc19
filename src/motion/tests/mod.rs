//! Scenarios of the whole room.

mod cells;
mod objective;
mod scenarios;
