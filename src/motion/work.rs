//! Work of a computation: counted, bounded, and stopped from outside.
//!
//! What planning and checking take is nearly all distances between two parts of a cell, and how
//! many there are depends on the request in ways that no bound on its members holds down. So they
//! are counted as they are taken, each kind weighed by what it costs. Counts, unlike clocks, are
//! the same on every machine: a plan that runs out of work is still the same plan everywhere.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::robot::{ArmStructure, Kinematics};

/// What one step costs, in bounds between two balls: about 4 ns each (one core of a server, 2024).
pub(crate) mod cost {
    /// Two balls, or a ball and a box along the axes.
    pub const BOUND: u64 = 1;
    /// Two capsules, a capsule and a plane: formulas.
    pub const FORMULA: u64 = 4;
    /// A capsule and a box or cylinder: a search along the capsule.
    pub const SEARCH: u64 = 60;
    /// Two boxes or cylinders, by GJK or, where they overlap, EPA.
    pub const GJK: u64 = 1_000;
    /// Placing one body of the arm.
    pub const PLACE: u64 = 5;
    /// Time or travel of one leg.
    pub const LEG: u64 = 3;
    /// A descent to a pose from a state nearby.
    pub const DESCENT: u64 = 8_000;
}

/// Asks a computation to stop. Clones ask for the same.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks: whoever looks from now on stops.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether anyone has asked.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// How much work may be done, and who may stop it.
#[derive(Clone, Debug)]
pub struct Allowance {
    /// Most work, in bounds between two balls (some 4 ns each).
    pub most: u64,
    /// Stops it before.
    pub stop: Stop,
}

impl Allowance {
    /// Enough for any cell that is not made to be hard: some five seconds of one core.
    pub const PLAN: u64 = 2_000_000_000;

    /// As much as a plan may take.
    pub fn plan(stop: &Stop) -> Self {
        Self { most: Self::PLAN, stop: stop.clone() }
    }

    /// `share` of it, to one of several computations.
    pub fn share(&self, share: f64) -> Self {
        Self { most: (self.most as f64 * share.clamp(0.0, 1.0)) as u64, stop: self.stop.clone() }
    }

    /// Whether there is nothing left, or someone has asked to stop.
    pub fn is_over(&self) -> bool {
        self.most == 0 || self.stop.is_asked()
    }

    /// What is left after `spent`.
    pub fn less(&self, spent: u64) -> Self {
        Self { most: self.most.saturating_sub(spent), stop: self.stop.clone() }
    }
}

impl Default for Allowance {
    fn default() -> Self {
        Self::plan(&Stop::default())
    }
}

/// Work done under an allowance; without one it never ends.
#[derive(Clone, Debug)]
pub(crate) struct Work {
    spent: u64,
    most: u64,
    stop: Stop,
}

impl Work {
    pub fn new(allowance: &Allowance) -> Self {
        Self { spent: 0, most: allowance.most, stop: allowance.stop.clone() }
    }

    #[inline(always)]
    pub fn spend(&mut self, units: u64) {
        self.spent += units;
    }

    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Whether there is nothing left, or someone has asked to stop.
    #[inline]
    pub fn is_over(&self) -> bool {
        self.spent >= self.most || self.stop.is_asked()
    }

    pub fn is_stopped(&self) -> bool {
        self.stop.is_asked()
    }

    /// What is left.
    pub fn left(&self) -> u64 {
        self.most.saturating_sub(self.spent)
    }

    /// Allows `most` in all from now on.
    pub fn bound(&mut self, most: u64) {
        self.most = most;
    }
}

impl Default for Work {
    fn default() -> Self {
        Self { spent: 0, most: u64::MAX, stop: Stop::default() }
    }
}

/// What one call of the arm's inverse kinematics costs, in the units of [`Allowance`], about.
pub fn inverse_work(kinematics: &dyn Kinematics) -> u64 {
    let solver = kinematics.solver();
    let exact = match solver.structure {
        ArmStructure::ThreeParallel => 500,
        ArmStructure::SphericalWrist => 1_500,
        ArmStructure::OffsetWrist => 30_000,
        ArmStructure::SpareJoint => 60_000,
        ArmStructure::General => 250_000,
    };
    // Descents from the closed form's branches.
    if solver.exact || solver.structure == ArmStructure::General { exact } else { exact + 20_000 }
}
