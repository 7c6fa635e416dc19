//! Times of the arm's kinematics.

mod common;

use std::hint::black_box;

use common::{median_time, row};
use prv::geometry::Pose;
use prv::robot::{DhConvention, DhRow, RobotModel, UrParameters};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const POSES: usize = 1000;

/// Calls of one run: under a millisecond, so that most runs fit between two turns of other processes.
const BATCH: usize = 100;

/// Runs whose median counts.
const RUNS: usize = 501;

/// Random joint states within the limits and half a turn.
fn states(robot: &RobotModel) -> Vec<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let pi = std::f64::consts::PI;
    (0..POSES)
        .map(|_| {
            robot
                .joints
                .iter()
                .map(|j| random.random_range(j.lower_rad.max(-pi)..j.upper_rad.min(pi)))
                .collect()
        })
        .collect()
}

fn poses(robot: &RobotModel) -> Vec<Pose> {
    states(robot).iter().map(|q| robot.kinematics.forward(q)).collect()
}

fn main() {
    let ur5e = RobotModel::named("ur5e").expect("built in");
    let panda = RobotModel::named("panda").expect("built in");
    let parameters =
        UrParameters { d1_m: 0.1625, a2_m: -0.425, a3_m: -0.3922, d4_m: 0.1333, d5_m: 0.0997, d6_m: 0.0996 };
    let each = |seconds: f64| seconds * 1e6 / BATCH as f64;

    let targets = poses(&ur5e);
    let branches = median_time(RUNS, 1, || {
        for target in &targets[..BATCH] {
            black_box(parameters.branches(black_box(target), &[0.0; 6]));
        }
    });
    row("UR5e: 8 branches, each measured by forward kinematics", each(branches), "us", Some(3.0));
    row("  ur-analytic-ik, the same (published)", 3.0, "us", None);
    residuals(&ur5e);
    let inverse = median_time(RUNS, 1, || {
        for target in &targets[..BATCH] {
            black_box(ur5e.kinematics.inverse(black_box(target), &[]));
        }
    });
    row("UR5e: inverse() with limits, wraps and lists", each(inverse), "us", None);
    let angles = states(&ur5e);
    let forward = median_time(RUNS, 1, || {
        for q in &angles[..BATCH] {
            black_box(ur5e.kinematics.forward(black_box(q)));
        }
    });
    row("UR5e: forward()", each(forward), "us", None);
    let mut links = Vec::new();
    let link_poses = median_time(RUNS, 1, || {
        for q in &angles[..BATCH] {
            ur5e.kinematics.link_poses_into(black_box(q), &mut links);
            black_box(&links);
        }
    });
    row("UR5e: link_poses_into()", each(link_poses), "us", None);

    let industrial = RobotModel::from_dh(&irb_2400(), DhConvention::Standard).expect("a sound table");
    closed_form("ABB IRB 2400 from DH (spherical wrist)", &industrial, Some(10.0));
    closed_form("xArm6 (offset wrist)", &RobotModel::named("xarm6").expect("built in"), Some(1000.0));
    let fr3 = RobotModel::named("fr3").expect("built in");
    for (name, robot) in [("Panda", &panda), ("FR3", &fr3)] {
        unsolved(name, robot, 0.1);
        numeric(name, robot);
    }
    let bent = RobotModel::from_dh(&calibrated_ur5e(), DhConvention::Standard).expect("a sound table");
    numeric("UR5e, calibrated table", &bent);
}

/// The largest distance between a pose and that of any of its solutions.
fn residuals(robot: &RobotModel) {
    let (mut far_m, mut turned_rad) = (0.0f64, 0.0f64);
    for target in poses(robot) {
        for solution in robot.kinematics.inverse(&target, &[]).solutions {
            let reached = robot.kinematics.forward(&solution);
            far_m = far_m.max((reached.translation.vector - target.translation.vector).norm());
            turned_rad = turned_rad.max(reached.rotation.angle_to(&target.rotation));
        }
    }
    row("  largest residual of any solution, position", far_m * 1e12, "pm", Some(1000.0));
    row("  largest residual of any solution, rotation", turned_rad * 1e12, "prad", Some(1000.0));
}

/// An industrial arm: parallel axes 2 and 3, a spherical wrist (lengths of Brandstoetter et al. 2014).
fn irb_2400() -> [DhRow; 6] {
    let quarter = std::f64::consts::FRAC_PI_2;
    [
        DhRow::new(0.1, -quarter, 0.615, 0.0),
        DhRow::new(0.705, 0.0, 0.0, -quarter),
        DhRow::new(0.135, -quarter, 0.0, 0.0),
        DhRow::new(0.0, quarter, 0.755, 0.0),
        DhRow::new(0.0, -quarter, 0.0, 0.0),
        DhRow::new(0.0, 0.0, 0.085, 0.0),
    ]
}

/// Time of all branches of an arm with a closed form, and of the same poses out of reach.
fn closed_form(name: &str, robot: &RobotModel, bound_us: Option<f64>) {
    let targets = poses(robot);
    let answers: Vec<_> = targets.iter().map(|t| robot.kinematics.inverse(t, &[]).solutions).collect();
    let unsolved = answers.iter().filter(|s| s.is_empty()).count();
    row(&format!("{name}: reachable poses without a solution"), unsolved as f64 / 10.0, "%", Some(0.0));
    let solutions = answers.iter().map(Vec::len).sum::<usize>() as f64 / POSES as f64;
    row(&format!("{name}: solutions a pose"), solutions, "", None);
    let all = median_time(51, 1, || {
        for target in &targets[..BATCH] {
            black_box(robot.kinematics.inverse(black_box(target), &[]));
        }
    });
    row(&format!("{name}: inverse(), all branches"), all * 1e6 / BATCH as f64, "us", bound_us);
    let lost = median_time(51, 1, || {
        for target in &targets[..BATCH] {
            let turned = Pose::translation(0.0, 0.0, -1.5) * target;
            black_box(robot.kinematics.inverse(black_box(&turned), &[]));
        }
    });
    row(&format!("{name}: inverse(), one and a half metres lower"), lost * 1e6 / BATCH as f64, "us", None);
}

/// A UR5e with small deviations in every row.
fn calibrated_ur5e() -> [DhRow; 6] {
    let quarter = std::f64::consts::FRAC_PI_2;
    [
        DhRow::new(0.0002, quarter + 0.0003, 0.1623, 0.0001),
        DhRow::new(-0.4252, 0.0012, 0.0, -0.002),
        DhRow::new(-0.3919, -0.0009, 0.0, 0.003),
        DhRow::new(0.0001, quarter - 0.0009, 0.1331, 0.0),
        DhRow::new(-0.0001, -quarter + 0.0006, 0.0998, 0.001),
        DhRow::new(0.0, 0.0, 0.0995, 0.0),
    ]
}

/// Share of ten thousand reachable poses that get no solution.
fn unsolved(name: &str, robot: &RobotModel, bound_percent: f64) {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let count = 10_000;
    let without = (0..count)
        .filter(|_| {
            let q: Vec<f64> =
                robot.joints.iter().map(|j| random.random_range(j.lower_rad..j.upper_rad)).collect();
            robot.kinematics.inverse(&robot.kinematics.forward(&q), &[]).solutions.is_empty()
        })
        .count();
    let percent = 100.0 * without as f64 / f64::from(count);
    row(&format!("{name}: of 10,000 reachable poses without a solution"), percent, "%", Some(bound_percent));
}

/// Times, share solved and number of solutions of a numeric arm.
fn numeric(name: &str, robot: &RobotModel) {
    let (targets, angles) = (poses(robot), states(robot));
    let few = 100;
    let answers: Vec<_> = targets.iter().map(|t| robot.kinematics.inverse(t, &[]).solutions).collect();
    let solved = answers.iter().filter(|s| !s.is_empty()).count();
    let solutions = answers.iter().map(Vec::len).sum::<usize>() as f64 / POSES as f64;
    row(
        &format!("{name}: reachable poses without a solution"),
        (POSES - solved) as f64 / 10.0,
        "%",
        Some(0.5),
    );
    row(&format!("{name}: solutions a pose"), solutions, "", None);
    let all = median_time(5, 1, || {
        for target in &targets[..few] {
            black_box(robot.kinematics.inverse(black_box(target), &[]));
        }
    });
    row(&format!("{name}: inverse(), all solutions found"), all * 1e3 / few as f64, "ms", Some(5.0));
    let near = median_time(5, 1, || {
        for (target, q) in targets[..few].iter().zip(&angles) {
            let previous: Vec<f64> = q.iter().map(|q| q + 0.1).collect();
            black_box(robot.kinematics.inverse_near(black_box(target), &previous));
        }
    });
    row(&format!("{name}: inverse_near(), 0.1 rad away"), near * 1e3 / few as f64, "ms", Some(1.0));
    let lost = median_time(5, 1, || {
        for target in &targets[..few] {
            let turned = Pose::translation(0.0, 0.0, -0.5) * target;
            black_box(robot.kinematics.inverse(black_box(&turned), &[]));
        }
    });
    row(&format!("{name}: inverse(), half a metre lower"), lost * 1e3 / few as f64, "ms", Some(10.0));
}
