//! Scenarios of the whole room.

mod cells;
mod checking;
mod hard_cells;
mod objective;
mod scenarios;
