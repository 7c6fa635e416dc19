use super::*;
use crate::geometry::Pose;
use crate::motion::Cell;
use crate::motion::joints::joints_from;
use crate::motion::scene::Scene;
use crate::robot::RobotModel;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Clusters of two or three states each, anywhere above a table that is not there.
fn random_layers(count: usize, rng: &mut ChaCha8Rng) -> Vec<Layer> {
    let layer = |view: usize, rng: &mut ChaCha8Rng| {
        let states = 2 + view % 2;
        let candidates = (0..states)
            .map(|_| {
                let q: Vec<f64> = (0..6).map(|_| rng.random_range(-0.5..0.5)).collect();
                Candidate { joints: joints_from(&q), roll_rad: 0.0 }
            })
            .collect();
        Layer { view, candidates, priced: Vec::new() }
    };
    (0..count).map(|view| layer(view, rng)).collect()
}

/// The least time over all orders that begin with cluster 0 and all states.
fn brute_force(table: &StateTable, tour: &mut Vec<usize>, left: &mut Vec<usize>, so_far: f32) -> f32 {
    if left.is_empty() {
        return so_far;
    }
    let mut best = f32::INFINITY;
    for i in 0..left.len() {
        let cluster = left.remove(i);
        for state in table.range(cluster) {
            let leg = tour.last().map_or(0.0, |last| table.time(*last, state));
            tour.push(state);
            best = best.min(brute_force(table, tour, left, so_far + leg));
            tour.pop();
        }
        left.insert(i, cluster);
    }
    best
}

#[test]
fn small_problems_are_solved_to_the_optimum_that_brute_force_finds() {
    let cell = Cell::new(RobotModel::named("ur5e").unwrap(), Pose::identity());
    let scene = Scene::new(&cell);
    for seed in 0..6 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let layers = random_layers(6, &mut rng);
        let table = StateTable::new(
            &cell.robot.joints,
            seed % 2 == 1,
            layers.iter().map(|layer| layer.candidates.as_slice()),
        );
        let first: Vec<usize> = (0..table.clusters()).map(|c| table.range(c).start).collect();
        // Colliding legs would cost extra; without a table and an object there are next to none,
        // and brute force does not know of them.
        let mut sweeper = Sweeper::default();
        let mut collisions = Collisions::new(&scene, &mut sweeper, usize::MAX, 10.0);
        let found = search(
            &table,
            &mut collisions,
            first,
            Effort { leg_times: 400_000, ..Effort::new(seed % 2 == 1, seed) },
        );
        let found_s = search::time_s(&table, &found) + collisions.known_extra_s(&found);
        let mut best_s = f32::INFINITY;
        for state in table.range(0) {
            best_s = best_s.min(brute_force(&table, &mut vec![state], &mut (1..6).collect(), 0.0));
        }
        let bound_s = lower_bound_s(&table).unwrap();
        assert!((found_s - best_s).abs() < 1e-4, "{found_s} against {best_s}");
        assert!(bound_s <= f64::from(best_s) + 1e-5);
    }
}
