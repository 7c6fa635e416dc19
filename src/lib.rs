//! View planning for robots that reconstruct objects they have never seen.
//!
//! `ARCHITECTURE.md` tells where everything lives; the modules below are listed
//! floor by floor, and a floor uses only floors above it in this list.
#![warn(missing_docs)]
#![deny(unsafe_op_in_unsafe_fn)]

pub mod files;
pub mod geometry;

pub mod draw;
pub mod imaging;
pub mod order;
pub mod views;

pub mod nerf;
pub mod render;
pub mod robot;

pub mod motion;

pub mod objects;
pub mod predict;

pub mod plan;

pub mod label;
pub mod simulate;

pub mod evaluate;

pub mod api;
