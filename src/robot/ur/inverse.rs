//! Closed-form inverse kinematics of the UR arms: all eight branches.
//!
//! Own derivation from the DH chain. Axes 2, 3 and 4 are parallel; their common
//! direction is `u = (sin q1, -cos q1, 0)`. With `p5` the wrist point (target
//! minus `d6` along its z axis):
//!
//! - shoulder, two branches: `p5 . u = d4`;
//! - wrist, two branches: the target's axes have components
//!   `(sin q5 cos q6, -sin q5 sin q6, cos q5)` along `u`;
//! - `q2 + q3 + q4` follows from the target's rotation without `q5`, `q6`;
//! - elbow, two branches: a triangle of `a2`, `a3` and the wrist's distance in the arm's plane.
//!
//! Where a branch has no exact solution its sine or cosine is held at the end of its range, which
//! puts the flange at the right rotation and as near as the branch gets; forward kinematics then
//! measures by how much it misses.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::UrParameters;
use crate::geometry::Pose;
use crate::robot::{InverseFailure, ReachBound, UnreachableReason};

/// Residual under which a branch counts as solved, metres and radians.
pub const EXACT: f64 = 1e-9;

/// Sine of `q5` below which axes 4 and 6 count as parallel, so that `q6` is free.
const WRIST_SINGULAR: f64 = 1e-10;

/// Branches closer than this in every joint are one, radians.
const SAME: f64 = 1e-7;

/// One of the eight branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Joint angles in `(-pi, pi]`, radians.
    pub joints_rad: [f64; 6],
    /// Distance between its flange and the target, metres.
    pub position_residual_m: f64,
    /// Angle between its flange and the target, radians.
    pub rotation_residual_rad: f64,
    /// The bound of the workspace that holds the branch off the target, if one does.
    pub held_by: Option<ReachBound>,
}

/// All eight branches of a target pose, exact or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branches {
    branches: [Branch; 8],
}

impl Branches {
    /// All branches, coinciding ones included.
    pub fn all(&self) -> &[Branch] {
        &self.branches
    }

    /// The branches that reach the target, each once.
    pub fn exact(&self) -> impl Iterator<Item = &Branch> {
        self.branches.iter().enumerate().filter(|(i, b)| b.is_exact() && !self.repeats(*i)).map(|(_, b)| b)
    }

    /// The branch that comes nearest to the target.
    pub fn nearest(&self) -> &Branch {
        let mut nearest = &self.branches[0];
        for branch in &self.branches {
            if branch.position_residual_m < nearest.position_residual_m {
                nearest = branch;
            }
        }
        nearest
    }

    /// Whether axes 4 and 6 are parallel in a branch, so that its `q6` was
    /// free and another one may reach where this one does not.
    pub fn has_free_wrist(&self) -> bool {
        self.branches.iter().any(|b| b.joints_rad[4].sin().abs() < WRIST_SINGULAR)
    }

    /// Why no branch reaches the target: how far the nearest one stays away.
    pub fn failure(&self) -> InverseFailure {
        let nearest = self.nearest();
        InverseFailure {
            nearest: nearest.joints_rad.to_vec(),
            position_residual_m: nearest.position_residual_m,
            rotation_residual_rad: nearest.rotation_residual_rad,
            reason: UnreachableReason::OutOfReach {
                beyond_m: nearest.position_residual_m,
                bound: nearest.held_by.unwrap_or(ReachBound::TooFar),
            },
        }
    }

    fn repeats(&self, index: usize) -> bool {
        let q = &self.branches[index].joints_rad;
        self.branches[..index].iter().any(|b| {
            b.is_exact()
                && b.joints_rad.iter().zip(q).all(|(x, y)| {
                    let apart = (x - y).abs();
                    apart < SAME || (TAU - apart).abs() < SAME
                })
        })
    }
}

impl Branch {
    /// Whether forward kinematics puts the flange on the target.
    pub fn is_exact(&self) -> bool {
        self.position_residual_m <= EXACT && self.rotation_residual_rad <= EXACT
    }
}

/// The target in the form the branches need.
struct Target {
    rotation: Matrix3<f64>,
    position: Vector3<f64>,
}

/// What the branches of one shoulder and wrist choice share.
struct Wrist {
    q5: f64,
    q6: f64,
    sum_234: f64,
    /// Wrist point in the arm's plane, shoulder at the origin.
    x: f64,
    z: f64,
    flange: FlangeFromWrist,
}

/// Forward kinematics of all that does not depend on `q2` and `q3` alone.
struct FlangeFromWrist {
    rotation_residual_rad: f64,
    /// Base to flange without upper arm and forearm, metres.
    offset: Vector3<f64>,
}

impl UrParameters {
    /// The eight branches for `base_from_flange`, each measured by forward
    /// kinematics. Where `q6` (or, on the first axis, `q1`) is free it takes
    /// `seed_rad`'s value. Allocates nothing. `None` if the pose is not finite.
    pub fn branches(&self, base_from_flange: &Pose, seed_rad: &[f64; 6]) -> Option<Branches> {
        let rotation = UnitQuaternion::new_normalize(*base_from_flange.rotation.quaternion());
        let position = base_from_flange.translation.vector;
        if !(rotation.coords.iter().chain(position.iter()).all(|v| v.is_finite())) {
            return None;
        }
        let target = Target { rotation: *rotation.to_rotation_matrix().matrix(), position };
        let wrist_point = target.position - target.rotation.column(2) * self.d6_m;
        let (shoulders, outside) = self.shoulders(&wrist_point, seed_rad[0]);
        let empty = Branch {
            joints_rad: [0.0; 6],
            position_residual_m: f64::INFINITY,
            rotation_residual_rad: f64::INFINITY,
            held_by: None,
        };
        let mut branches = [empty; 8];
        let mut slots = branches.iter_mut();
        for q1 in shoulders {
            let (s1, c1) = q1.sin_cos();
            for wrist_sign in [1.0, -1.0] {
                let wrist = self.wrist(&target, &wrist_point, (s1, c1), wrist_sign, seed_rad[5]);
                let (elbow, held) = self.elbow(&wrist);
                for q3 in [elbow, -elbow] {
                    if let Some(slot) = slots.next() {
                        *slot = self.branch(&target, q1, (s1, c1), q3, &wrist);
                        slot.held_by = if outside { Some(ReachBound::InsideShoulderColumn) } else { held };
                    }
                }
            }
        }
        Some(Branches { branches })
    }

    /// The two values of `q1`, and whether the wrist point is too near to the first axis for either.
    fn shoulders(&self, wrist_point: &Vector3<f64>, free_q1: f64) -> ([f64; 2], bool) {
        let (x, y, d4) = (wrist_point.x, wrist_point.y, self.d4_m);
        let squared = x * x + y * y;
        if squared < 1e-24 {
            return ([free_q1, free_q1], d4.abs() > EXACT);
        }
        let room = squared - d4 * d4;
        let r = room.max(0.0).sqrt();
        let shoulders = [r, -r].map(|r| (d4 * x + y * r).atan2(x * r - d4 * y));
        (shoulders, squared.sqrt() < d4.abs() - EXACT)
    }

    /// `q5`, `q6`, `q2 + q3 + q4` and what follows from them.
    fn wrist(
        &self,
        target: &Target,
        wrist_point: &Vector3<f64>,
        (s1, c1): (f64, f64),
        sign: f64,
        free_q6: f64,
    ) -> Wrist {
        let r = &target.rotation;
        // Components of the target's axes along u, and along the arm's plane.
        let along_u = |column: usize| r[(0, column)] * s1 - r[(1, column)] * c1;
        let along_x = |column: usize| r[(0, column)] * c1 + r[(1, column)] * s1;
        let (ux, uy, uz) = (along_u(0), along_u(1), along_u(2));
        let sine = ux.hypot(uy);
        let q5 = sign * sine.atan2(uz);
        let q6 = if sine < WRIST_SINGULAR { free_q6 } else { (-sign * uy).atan2(sign * ux) };
        let (s5, c5) = q5.sin_cos();
        let (s6, c6) = q6.sin_cos();
        // Axis x of frame 4 in flange axes is (c5 c6, -c5 s6, -s5).
        let (kx, ky, kz) = (c5 * c6, -c5 * s6, -s5);
        let cos_sum = kx * along_x(0) + ky * along_x(1) + kz * along_x(2);
        let sin_sum = kx * r[(2, 0)] + ky * r[(2, 1)] + kz * r[(2, 2)];
        let sum_234 = sin_sum.atan2(cos_sum);
        let (s, c) = sum_234.sin_cos();
        let x4 = Vector3::new(c1 * c, s1 * c, s);
        let y4 = Vector3::new(s1, -c1, 0.0);
        let z4 = Vector3::new(c1 * s, s1 * s, -c);
        let x5 = x4 * c5 + y4 * s5;
        let z6 = y4 * c5 - x4 * s5;
        let rotation = Matrix3::from_columns(&[x5 * c6 - z4 * s6, -x5 * s6 - z4 * c6, z6]);
        // For rotations t apart the Frobenius norm of the difference is sqrt(8) sin(t / 2).
        let rotation_residual_rad = (rotation - r).norm() * std::f64::consts::FRAC_1_SQRT_2;
        let in_plane = wrist_point - z4 * self.d5_m;
        Wrist {
            q5,
            q6,
            sum_234,
            x: in_plane.x * c1 + in_plane.y * s1,
            z: in_plane.z - self.d1_m,
            flange: FlangeFromWrist {
                rotation_residual_rad,
                offset: y4 * self.d4_m + z4 * self.d5_m + z6 * self.d6_m + Vector3::z() * self.d1_m,
            },
        }
    }

    /// `|q3|`, and the bound that holds it if the wrist is out of the triangle's range.
    fn elbow(&self, wrist: &Wrist) -> (f64, Option<ReachBound>) {
        let (a2, a3) = (self.a2_m, self.a3_m);
        let squared = wrist.x * wrist.x + wrist.z * wrist.z;
        let cosine = (squared - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
        if cosine > 1.0 {
            (0.0, Some(ReachBound::TooFar))
        } else if cosine < -1.0 {
            (PI, Some(ReachBound::TooClose))
        } else {
            (((1.0 - cosine) * (1.0 + cosine)).sqrt().atan2(cosine), None)
        }
    }

    /// The branch with this shoulder, wrist and elbow, measured against the target.
    fn branch(&self, target: &Target, q1: f64, (s1, c1): (f64, f64), q3: f64, wrist: &Wrist) -> Branch {
        let (a2, a3) = (self.a2_m, self.a3_m);
        let (s3, c3) = q3.sin_cos();
        let (along, across) = (a2 + a3 * c3, a3 * s3);
        // One arc tangent for the difference of two: the wrist's direction less the triangle's angle.
        let q2 = (wrist.z * along - wrist.x * across).atan2(wrist.x * along + wrist.z * across);
        let q4 = within_half_turn(wrist.sum_234 - q2 - q3);
        let (s2, c2) = q2.sin_cos();
        let (s23, c23) = (q2 + q3).sin_cos();
        let (x, z) = (a2 * c2 + a3 * c23, a2 * s2 + a3 * s23);
        let position = wrist.flange.offset + Vector3::new(c1 * x, s1 * x, z);
        Branch {
            joints_rad: [q1, q2, q3, q4, wrist.q5, wrist.q6],
            position_residual_m: (position - target.position).norm(),
            rotation_residual_rad: wrist.flange.rotation_residual_rad,
            held_by: None,
        }
    }
}

/// The angle less the whole turns that bring it into `[-pi, pi]`.
fn within_half_turn(angle: f64) -> f64 {
    angle - (angle / TAU).round() * TAU
}
