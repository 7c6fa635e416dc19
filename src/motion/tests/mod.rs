//! Scenarios of the whole room.

mod cells;
mod random_cells;
mod scenarios;
