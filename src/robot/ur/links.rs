//! The UR arms' links as capsules.
//!
//! Approximations: segment ends from the DH lengths and from the housings'
//! published outlines (offsets of upper arm and forearm beside the arm's
//! plane), radii rounded up so that the capsules hold tubes, joint caps and the bends
//! of the cables close to the arm. Frames: link i turns with joint i, z along that joint's axis.

use super::parameters::UrParameters;
use crate::robot::{Link, LinkShape};

/// The thicknesses of one arm, metres.
pub(super) struct Girth {
    /// Offset of the upper arm along the shoulder's axis.
    pub upper_arm_offset_m: f64,
    /// Offset of the forearm along the elbow's axis.
    pub forearm_offset_m: f64,
    /// The shoulder's housing.
    pub shoulder_radius_m: f64,
    /// The upper arm's tube and its end caps.
    pub upper_arm_radius_m: f64,
    /// The forearm's tube and its end caps.
    pub forearm_radius_m: f64,
    /// Wrist housings and tool flange.
    pub wrist_radius_m: f64,
}

/// The thicknesses of the arm called `name`.
pub(super) fn girth(name: &str) -> Girth {
    let [
        upper_arm_offset_m,
        forearm_offset_m,
        shoulder_radius_m,
        upper_arm_radius_m,
        forearm_radius_m,
        wrist_radius_m,
    ] = match name {
        "ur3" | "ur3e" => [0.120, 0.027, 0.060, 0.052, 0.042, 0.034],
        "ur5" => [0.136, 0.017, 0.075, 0.060, 0.045, 0.040],
        "ur10" => [0.220, 0.049, 0.095, 0.080, 0.060, 0.046],
        "ur20" | "ur30" => [0.260, 0.043, 0.125, 0.100, 0.080, 0.060],
        "ur10e" | "ur16e" => [0.176, 0.039, 0.095, 0.080, 0.068, 0.046],
        _ => [0.138, 0.007, 0.075, 0.062, 0.050, 0.040],
    };
    Girth {
        upper_arm_offset_m,
        forearm_offset_m,
        shoulder_radius_m,
        upper_arm_radius_m,
        forearm_radius_m,
        wrist_radius_m,
    }
}

/// Base and the six moving links.
pub(super) fn links(p: &UrParameters, g: &Girth) -> Vec<Link> {
    let link = |name: &str, shapes: Vec<LinkShape>| Link { name: name.to_owned(), shapes };
    let (upper, fore) = (g.upper_arm_offset_m, g.forearm_offset_m);
    // The base is slimmer than the shoulder; the upper arm passes close beside it.
    let base_radius_m = 0.85 * g.shoulder_radius_m;
    vec![
        // Its foot ends 1 cm above the mounting plane so that a table at z = 0 does not touch it.
        link(
            "base",
            vec![LinkShape::capsule(
                [0.0, 0.0, base_radius_m + 0.01],
                [0.0, 0.0, p.d1_m - 0.02],
                base_radius_m,
            )],
        ),
        // The joint's frame stays in the base's origin, so the housing sits at d1, its cap reaches to the upper arm along -y.
        link(
            "shoulder_link",
            vec![LinkShape::capsule([0.0, 0.0, p.d1_m], [0.0, -0.5 * upper, p.d1_m], g.shoulder_radius_m)],
        ),
        link(
            "upper_arm_link",
            vec![LinkShape::capsule([0.0, 0.0, upper], [p.a2_m, 0.0, upper], g.upper_arm_radius_m)],
        ),
        link(
            "forearm_link",
            vec![
                // The elbow's cap reaches across to the upper arm.
                LinkShape::capsule([0.0, 0.0, fore], [0.0, 0.0, 0.5 * (fore + upper)], g.forearm_radius_m),
                LinkShape::capsule([0.0, 0.0, fore], [p.a3_m, 0.0, fore], g.forearm_radius_m),
            ],
        ),
        link(
            "wrist_1_link",
            vec![LinkShape::capsule([0.0, 0.0, 0.5 * (fore + p.d4_m)], [0.0, 0.0, p.d4_m], g.wrist_radius_m)],
        ),
        link("wrist_2_link", vec![LinkShape::capsule([0.0, 0.0, 0.0], [0.0, 0.0, p.d5_m], g.wrist_radius_m)]),
        // Ends a radius short of the flange, so that a tool there does not touch it.
        link(
            "wrist_3_link",
            vec![LinkShape::capsule(
                [0.0, 0.0, 0.0],
                [0.0, 0.0, (p.d6_m - g.wrist_radius_m).max(0.0)],
                g.wrist_radius_m,
            )],
        ),
    ]
}
