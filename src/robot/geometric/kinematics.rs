//! Kinematics of chains with a known structure.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::Matrix6xX;

use super::spare_joint::SpareJoint;
use super::structure::Structure;
use crate::geometry::Pose;
use crate::robot::numeric::{Bounds, Descent, NumericKinematics, descend, radical_inverse};
use crate::robot::postures::{Postures, sort_by_move};
use crate::robot::{
    Chain, InverseFailure, InverseSolutions, Joint, Kinematics, MAX_JOINTS, ReachBound, RobotError, Solver,
    UnreachableReason, nearest_wrap,
};

/// Residual under which a state counts as a solution, metres and radians.
const REACHED: f64 = 1e-9;

/// A state that misses by less may be polished, metres or radians: where the
/// structure is exact, and where it is not or the state only a guess.
const POLISHABLE: [f64; 2] = [1e-5, 0.2];

/// States closer than this in every joint are one solution, radians.
const SAME: f64 = 1e-6;

/// As [`SAME`] for arms with a joint to spare, whose solutions form curves.
const SAME_ON_CURVE: f64 = 0.2;

/// Most solutions of an arm with a joint to spare.
const MOST_ON_CURVES: usize = 16;

/// Angles of the spare joint that are tried, and those tried when they give nothing.
const SPARE_ANGLES: [u32; 2] = [24, 192];

/// States that break limits least from which a descent within the limits is tried.
const DESCENTS: usize = 8;

/// Angles on either side of a sample that are tried where no sample fits the limits.
const CLOSER: i32 = 12;

/// A joint state with room for the longest chain.
type State = [f64; MAX_JOINTS];

/// Kinematics of a chain whose structure has a closed form, or nearly.
#[derive(Debug, Clone)]
pub struct GeometricKinematics {
    chain: Chain,
    joints: Vec<Joint>,
    structure: Structure,
    flange_at_zero_from_base: Pose,
    numeric: NumericKinematics,
}

/// A state and by how much it misses.
#[derive(Debug, Clone, Copy)]
struct Measured {
    state: State,
    position_residual_m: f64,
    rotation_residual_rad: f64,
    held_by: Option<ReachBound>,
}

impl Measured {
    fn miss(&self) -> f64 {
        self.position_residual_m.max(self.rotation_residual_rad)
    }
}

impl From<Descent> for Measured {
    fn from(end: Descent) -> Self {
        Self {
            state: end.joints_rad,
            position_residual_m: end.position_residual_m,
            rotation_residual_rad: end.rotation_residual_rad,
            held_by: None,
        }
    }
}

impl GeometricKinematics {
    /// Kinematics of `chain` within the limits of `joints`, one a joint of the
    /// chain; `None` if the chain has none of the known structures.
    pub fn new(chain: Chain, joints: Vec<Joint>) -> Result<Option<Self>, RobotError> {
        let Some(structure) = Structure::of(&chain) else { return Ok(None) };
        let numeric = NumericKinematics::new(chain.clone(), joints.clone())?;
        let flange_at_zero_from_base = chain.forward(&[]).inverse();
        Ok(Some(Self { chain, joints, structure, flange_at_zero_from_base, numeric }))
    }

    fn solve(&self, base_from_flange: &Pose, seed: Option<&[f64]>) -> InverseSolutions {
        let position = base_from_flange.translation;
        let rotation = nalgebra::UnitQuaternion::new_normalize(*base_from_flange.rotation.quaternion());
        if !position.vector.iter().chain(rotation.coords.iter()).all(|v| v.is_finite()) {
            return InverseSolutions::not_finite();
        }
        let target = Pose::from_parts(position, rotation);
        let motion = target * self.flange_at_zero_from_base;
        let mut start = [0.0; MAX_JOINTS];
        for (i, (slot, joint)) in start.iter_mut().zip(&self.joints).enumerate() {
            let seeded = seed.and_then(|seed| seed.get(i)).copied().filter(|q| q.is_finite());
            *slot = seeded.unwrap_or_else(|| joint.middle_rad());
        }
        let six = [start[0], start[1], start[2], start[3], start[4], start[5]];
        match &self.structure {
            Structure::SphericalWrist(axes) => {
                let ways = axes.ways(&motion, &six).map(|way| (long(&way.joints_rad), way.held_by));
                self.pick(&target, ways, self.polishable(), seed)
            }
            Structure::OffsetWrist(wrist) => {
                let ways = wrist.candidates(&motion, &six).into_iter().map(|q| (long(&q), None));
                self.pick(&target, ways, POLISHABLE[1], seed)
            }
            Structure::SpareJoint(spare) => self.sample(&target, &motion, spare, &start, seed),
        }
    }

    fn polishable(&self) -> f64 {
        if self.structure.solver().exact { POLISHABLE[0] } else { POLISHABLE[1] }
    }

    /// The solutions among the finitely many `ways`.
    fn pick(
        &self,
        target: &Pose,
        ways: impl IntoIterator<Item = (State, Option<ReachBound>)>,
        polishable: f64,
        seed: Option<&[f64]>,
    ) -> InverseSolutions {
        let mut postures = Postures::new(&self.joints, seed);
        let mut known: Vec<State> = Vec::with_capacity(8);
        let mut nearest: Option<Measured> = None;
        for (state, held_by) in ways {
            let found =
                self.refined(target, Measured { held_by, ..self.measure(target, &state) }, polishable);
            if found.miss() > REACHED {
                nearest = Some(nearest.filter(|n| n.miss() <= found.miss()).unwrap_or(found));
            } else if !known.iter().any(|k| self.apart(k, &found.state) < SAME) {
                known.push(found.state);
                postures.add(self.cut(&found.state));
            }
        }
        if postures.within().is_empty() && matches!(self.structure, Structure::OffsetWrist(_)) {
            // Solutions that nearly fall together can hide between the samples of the search.
            let known: Vec<(f64, State)> = known.iter().map(|state| (0.0, *state)).collect();
            let nearest: Vec<(f64, State)> = nearest.iter().map(|n| (n.miss(), n.state)).collect();
            self.descend_within(target, &known, &nearest, &mut postures);
        }
        let exact = self.structure.solver().exact;
        match nearest {
            // The closed form is complete and its nearest state turns the flange right.
            Some(nearest) if exact && nearest.rotation_residual_rad < 1e-6 => {
                postures.finish(|| self.out_of_reach(&nearest))
            }
            // The search has been over the whole turn; more starts would find no more.
            Some(nearest) if postures.is_empty() && matches!(self.structure, Structure::OffsetWrist(_)) => {
                self.numeric.miss_from(target, Some(&nearest.state), known.len().max(1))
            }
            _ if postures.is_empty() => self.numeric.inverse(target, seed.map(<[f64]>::to_vec).as_slice()),
            _ => postures.finish(InverseFailure::unknown),
        }
    }

    /// Solutions at samples of the spare joint's angle.
    fn sample(
        &self,
        target: &Pose,
        motion: &Pose,
        spare: &SpareJoint,
        start: &State,
        seed: Option<&[f64]>,
    ) -> InverseSolutions {
        let mut postures = Postures::new(&self.joints, seed);
        let Some(held) = self.joints.get(spare.held_joint()) else { return InverseSolutions::not_finite() };
        let width = (held.upper_rad - held.lower_rad).min(TAU);
        let angle = |i: u32| held.middle_rad() + width * (radical_inverse(i, 2) - 0.5);
        let mut nearest: Vec<(f64, State)> = Vec::new();
        let mut beyond: Vec<(f64, State)> = Vec::new();
        let seeded = held.contains(start[spare.held_joint()]).then_some(start[spare.held_joint()]);
        let [coarse, fine] = SPARE_ANGLES;
        let mut tried = 0;
        for held_rad in seeded.into_iter().chain((1..=fine).map(angle)) {
            if (tried > coarse && !postures.within().is_empty()) || postures.within().len() >= MOST_ON_CURVES
            {
                break;
            }
            tried += 1;
            for state in spare.ways(motion, held_rad, start) {
                if postures.within().len() >= MOST_ON_CURVES {
                    break;
                }
                let over = self.beyond_limits(&state);
                if over > 0.0 && tried > coarse {
                    // Beyond the limits it is of use only as the nearest there is.
                    keep_least(&mut beyond, over, &state);
                    continue;
                }
                let found = self.refined(target, self.measure(target, &state), self.polishable());
                if found.miss() > REACHED {
                    keep_least(&mut nearest, found.miss(), &found.state);
                } else if over > 0.0 {
                    keep_least(&mut beyond, over, &found.state);
                } else if !postures.within().iter().any(|k| self.apart(k, &found.state) < SAME_ON_CURVE) {
                    postures.add(self.cut(&found.state));
                }
            }
        }
        if postures.within().is_empty() {
            self.look_closer(target, motion, spare, start, width / f64::from(fine), &beyond, &mut postures);
        }
        if postures.within().is_empty() {
            self.descend_within(target, &beyond, &nearest, &mut postures);
        }
        if postures.is_empty() {
            return self.numeric.miss_from(target, nearest.first().map(|(_, state)| state), tried as usize);
        }
        postures.finish(InverseFailure::unknown)
    }

    /// Solutions at held angles up to `reach_rad` beside those that break the limits least: the
    /// range that fits all limits may be narrower than the distance of the samples.
    #[allow(clippy::too_many_arguments)]
    fn look_closer(
        &self,
        target: &Pose,
        motion: &Pose,
        spare: &SpareJoint,
        start: &State,
        reach_rad: f64,
        beyond: &[(f64, State)],
        postures: &mut Postures<'_>,
    ) {
        for (_, state) in beyond {
            for i in -CLOSER..=CLOSER {
                let held_rad = state[spare.held_joint()] + reach_rad * f64::from(i) / f64::from(CLOSER);
                for state in spare.ways(motion, held_rad, start) {
                    if self.beyond_limits(&state) > 0.0 {
                        continue;
                    }
                    let found = self.refined(target, self.measure(target, &state), self.polishable());
                    if found.miss() <= REACHED {
                        postures.add(self.cut(&found.state));
                        return;
                    }
                }
            }
        }
    }

    /// Solutions between the samples: descents within the limits from what breaks them
    /// least; else what breaks them, for the reason.
    fn descend_within(
        &self,
        target: &Pose,
        beyond: &[(f64, State)],
        nearest: &[(f64, State)],
        postures: &mut Postures<'_>,
    ) {
        for (_, state) in beyond.iter().chain(nearest) {
            let mut from = *state;
            for (slot, joint) in from.iter_mut().zip(&self.joints) {
                let wrapped = nearest_wrap(joint, *slot, joint.middle_rad());
                *slot = wrapped.unwrap_or_else(|| slot.max(joint.lower_rad).min(joint.upper_rad));
            }
            let end = Measured::from(descend(&self.chain, Bounds::Limits(&self.joints), target, &from));
            if end.miss() <= REACHED {
                postures.add(self.cut(&end.state));
            }
        }
        if !postures.within().is_empty() {
            return;
        }
        for (_, state) in beyond {
            if self.measure(target, state).miss() <= REACHED {
                postures.add(self.cut(state));
            }
        }
    }

    fn measure(&self, target: &Pose, state: &State) -> Measured {
        let pose = self.chain.forward(self.cut(state));
        let turn = pose.rotation.inverse() * target.rotation;
        Measured {
            state: *state,
            position_residual_m: (pose.translation.vector - target.translation.vector).norm(),
            // The angle itself, not its cosine: small ones keep their digits.
            rotation_residual_rad: 2.0 * turn.imag().norm().atan2(turn.w.abs()),
            held_by: None,
        }
    }

    /// The state, or what a descent from it finds if that is worth a try.
    fn refined(&self, target: &Pose, found: Measured, polishable: f64) -> Measured {
        let miss = found.miss();
        if miss <= REACHED || !(miss <= polishable) {
            return found;
        }
        let end = Measured::from(descend(&self.chain, Bounds::Free, target, &found.state));
        if end.miss() <= REACHED { end } else { found }
    }

    fn out_of_reach(&self, nearest: &Measured) -> InverseFailure {
        InverseFailure {
            nearest: self.cut(&nearest.state).to_vec(),
            position_residual_m: nearest.position_residual_m,
            rotation_residual_rad: nearest.rotation_residual_rad,
            reason: UnreachableReason::OutOfReach {
                beyond_m: nearest.position_residual_m,
                bound: nearest.held_by.unwrap_or(ReachBound::TooFar),
            },
        }
    }

    /// By how much a state breaks the limits in all, radians, whole turns aside.
    fn beyond_limits(&self, state: &State) -> f64 {
        let each = self.joints.iter().zip(state).map(|(joint, &q)| {
            let turns = ((joint.middle_rad() - q) / TAU).round();
            joint.violation_rad(q + turns * TAU)
        });
        each.sum()
    }

    /// The largest difference of two states in any joint, whole turns aside, radians.
    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let each = a.iter().zip(b).map(|(x, y)| ((x - y) - ((x - y) / TAU).round() * TAU).abs());
        each.take(self.joints.len()).fold(0.0, f64::max)
    }

    fn cut<'a>(&self, state: &'a [f64]) -> &'a [f64] {
        state.get(..self.joints.len()).unwrap_or(state)
    }
}

/// A state of six joints in the longer array.
fn long(six: &[f64; 6]) -> State {
    std::array::from_fn(|i| six.get(i).copied().unwrap_or(0.0))
}

/// Keeps the few states of least cost, the least first.
fn keep_least(list: &mut Vec<(f64, State)>, cost: f64, state: &State) {
    if !cost.is_finite() || (list.len() >= DESCENTS && list.last().is_some_and(|(worst, _)| *worst <= cost)) {
        return;
    }
    let at = list.partition_point(|(known, _)| *known <= cost);
    list.insert(at, (cost, *state));
    list.truncate(DESCENTS);
}

impl Kinematics for GeometricKinematics {
    fn dof(&self) -> usize {
        self.chain.dof()
    }

    fn solver(&self) -> Solver {
        self.structure.solver()
    }

    fn forward(&self, joints_rad: &[f64]) -> Pose {
        self.chain.forward(joints_rad)
    }

    fn link_poses_into(&self, joints_rad: &[f64], poses: &mut Vec<Pose>) {
        self.chain.link_poses_into(joints_rad, poses);
    }

    fn jacobian(&self, joints_rad: &[f64]) -> Matrix6xX<f64> {
        self.chain.jacobian(joints_rad)
    }

    fn with_joints(&self, joints: Vec<Joint>) -> Result<Arc<dyn Kinematics>, RobotError> {
        let numeric = NumericKinematics::new(self.chain.clone(), joints.clone())?;
        Ok(Arc::new(Self { joints, numeric, ..self.clone() }))
    }

    fn inverse(&self, base_from_flange: &Pose, seeds: &[Vec<f64>]) -> InverseSolutions {
        self.solve(base_from_flange, seeds.first().map(Vec::as_slice))
    }

    fn inverse_near(&self, base_from_flange: &Pose, previous: &[f64]) -> InverseSolutions {
        if matches!(self.structure, Structure::SpareJoint(_)) {
            // The nearest of a curve of solutions is where a descent from there ends.
            let near = self.numeric.descend_from(base_from_flange, previous);
            if let Some(state) = near {
                return InverseSolutions::found(vec![state]);
            }
        }
        let mut answer = self.solve(base_from_flange, Some(previous));
        sort_by_move(&mut answer.solutions, previous);
        answer
    }

    fn inverse_from(&self, base_from_flange: &Pose, previous: &[f64]) -> Option<Vec<f64>> {
        self.numeric.descend_from(base_from_flange, previous)
    }
}
