//! Arms from URDF text.
//!
//! The text comes from outside: its size, nesting and numbers are bounded
//! before anything is built from them.

mod arm;
mod attached;
mod guard;
mod joints;
mod shapes;
mod tree;

pub(super) use arm::from_urdf;

#[cfg(test)]
mod tests;
