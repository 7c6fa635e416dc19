//! Good tours quickly: 2-opt and or-opt moves among near neighbours, repaired after random kicks.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::tour_problem::TourProblem;

/// Neighbours looked at from each node.
const NEIGHBOURS: usize = 8;
/// Longest stretch moved by an or-opt move.
const LONGEST_MOVE: usize = 3;
/// Longest stretch exchanged by a kick.
const LONGEST_KICK: usize = 30;

/// A closed tour that is being improved, under costs reduced by prices: prices change every
/// tour's cost by the same amount, but make near neighbours in a good tour cheap.
pub(super) struct TourSearch {
    nodes: usize,
    costs: Vec<f64>,
    neighbours: Vec<u32>,
    width: usize,
    tour: Vec<u32>,
    position: Vec<u32>,
    /// Nodes whose surroundings changed.
    queue: Vec<u32>,
    queued: Vec<bool>,
    least_gain: f64,
    spare: Vec<u32>,
    /// Distances looked up, to count work independently of the machine.
    pub work: u64,
}

impl TourSearch {
    /// Starts from `tour`.
    pub(super) fn new(problem: &TourProblem, prices: &[f64], tour: &[usize]) -> TourSearch {
        let n = problem.nodes;
        let mut costs = vec![0.0; n * n];
        let mut longest = 0.0f64;
        for i in 0..n {
            for j in 0..n {
                costs[i * n + j] = problem.cost(i, j) + prices[i] + prices[j];
                longest = longest.max(costs[i * n + j].abs());
            }
        }
        // The edge from home to the start belongs to every tour.
        let forced = -8.0 * longest;
        costs[problem.home() * n + problem.start] = forced;
        costs[problem.start * n + problem.home()] = forced;
        let width = NEIGHBOURS.min(n - 1);
        let mut neighbours = Vec::with_capacity(n * width);
        for i in 0..n {
            let row = &costs[i * n..(i + 1) * n];
            let mut others: Vec<u32> = (0..n as u32).filter(|&j| j as usize != i).collect();
            others.sort_by(|&a, &b| row[a as usize].total_cmp(&row[b as usize]));
            neighbours.extend_from_slice(&others[..width]);
        }
        let mut search = TourSearch {
            nodes: n,
            costs,
            neighbours,
            width,
            tour: tour.iter().map(|&k| k as u32).collect(),
            position: vec![0; n],
            queue: (0..n as u32).collect(),
            queued: vec![true; n],
            least_gain: 1e-12 * longest,
            spare: Vec::with_capacity(n),
            work: (n * n) as u64,
        };
        search.index();
        search
    }

    /// Improves until no move helps, then kicks and repairs `kicks` times, keeping what is better.
    pub(super) fn run(&mut self, kicks: usize) -> Vec<usize> {
        self.descend();
        let mut best = self.tour.clone();
        let mut best_cost = self.tour_cost();
        let mut rng = ChaCha8Rng::seed_from_u64(self.nodes as u64);
        for _ in 0..if self.nodes < 8 { 0 } else { kicks } {
            self.kick(&mut rng);
            self.descend();
            let cost = self.tour_cost();
            if cost <= best_cost {
                best_cost = cost;
                best.copy_from_slice(&self.tour);
            } else {
                self.tour.copy_from_slice(&best);
                self.index();
            }
        }
        best.into_iter().map(|k| k as usize).collect()
    }

    fn cost(&self, a: u32, b: u32) -> f64 {
        self.costs[a as usize * self.nodes + b as usize]
    }

    fn tour_cost(&self) -> f64 {
        let closing = self.cost(self.tour[self.nodes - 1], self.tour[0]);
        self.tour.windows(2).map(|pair| self.cost(pair[0], pair[1])).sum::<f64>() + closing
    }

    fn index(&mut self) {
        for (at, &node) in self.tour.iter().enumerate() {
            self.position[node as usize] = at as u32;
        }
    }

    fn enqueue(&mut self, node: u32) {
        if !self.queued[node as usize] {
            self.queued[node as usize] = true;
            self.queue.push(node);
        }
    }

    /// The node `by` places further along the tour.
    fn along(&self, node: u32, by: isize) -> u32 {
        let at = self.position[node as usize] as isize + by;
        self.tour[at.rem_euclid(self.nodes as isize) as usize]
    }

    fn descend(&mut self) {
        while let Some(node) = self.queue.pop() {
            self.queued[node as usize] = false;
            while self.improve(node) {}
        }
    }

    /// Looks for a move that replaces an edge at `a` by one to a near neighbour.
    fn improve(&mut self, a: u32) -> bool {
        for direction in [1isize, -1] {
            let b = self.along(a, direction);
            let removed = self.cost(a, b);
            for k in 0..self.width {
                let c = self.neighbours[a as usize * self.width + k];
                let gain = removed - self.cost(a, c);
                if gain <= self.least_gain {
                    break;
                }
                self.work += 8;
                let d = self.along(c, direction);
                if gain + self.cost(c, d) - self.cost(b, d) > self.least_gain {
                    self.reverse_between(a, b, c, d, direction);
                    [a, b, c, d].into_iter().for_each(|node| self.enqueue(node));
                    return true;
                }
                if self.move_stretch(a, b, c, gain, direction) {
                    return true;
                }
            }
        }
        false
    }

    /// 2-opt: edges a-b and c-d become a-c and b-d.
    fn reverse_between(&mut self, a: u32, b: u32, c: u32, d: u32, direction: isize) {
        let (from, to) = if direction > 0 { (b, c) } else { (a, d) };
        let n = self.nodes;
        let (mut i, mut j) = (self.position[from as usize] as usize, self.position[to as usize] as usize);
        let mut length = (j + n - i) % n + 1;
        if 2 * length > n {
            (i, j) = ((j + 1) % n, (i + n - 1) % n);
            length = n - length;
        }
        for _ in 0..length / 2 {
            self.tour.swap(i, j);
            self.position[self.tour[i] as usize] = i as u32;
            self.position[self.tour[j] as usize] = j as u32;
            i = (i + 1) % n;
            j = (j + n - 1) % n;
        }
        self.work += length as u64;
    }

    /// Or-opt: the stretch that begins at `a` (away from `b`) goes next to `c`, `a` touching `c`.
    fn move_stretch(&mut self, a: u32, b: u32, c: u32, gain: f64, direction: isize) -> bool {
        for length in 1..=LONGEST_MOVE.min(self.nodes - 3) {
            let last = self.along(a, -direction * (length as isize - 1));
            if last == c {
                return false;
            }
            let beyond = self.along(last, -direction);
            if beyond == b {
                return false;
            }
            let freed = gain + self.cost(last, beyond) - self.cost(b, beyond);
            for side in [1isize, -1] {
                let d = self.along(c, side);
                // The edge c-d must survive the removal of the stretch.
                if d == a || d == last {
                    continue;
                }
                if freed + self.cost(c, d) - self.cost(last, d) > self.least_gain {
                    self.insert_stretch(a, last, c, d, direction);
                    [a, b, c, d, last, beyond].into_iter().for_each(|node| self.enqueue(node));
                    return true;
                }
            }
        }
        false
    }

    fn insert_stretch(&mut self, a: u32, last: u32, c: u32, d: u32, direction: isize) {
        // Stretch from `a` to `last`, in the order of insertion between c and d.
        let mut stretch = [0u32; LONGEST_MOVE];
        let mut length = 0;
        let mut node = a;
        loop {
            stretch[length] = node;
            length += 1;
            if node == last || length == LONGEST_MOVE {
                break;
            }
            node = self.along(node, -direction);
        }
        let stretch = &stretch[..length];
        let c_first = self.along(c, 1) == d;
        let anchor = if c_first { c } else { d };
        self.spare.clear();
        for &node in &self.tour {
            if stretch.contains(&node) {
                continue;
            }
            self.spare.push(node);
            if node == anchor {
                if c_first {
                    self.spare.extend(stretch.iter());
                } else {
                    self.spare.extend(stretch.iter().rev());
                }
            }
        }
        std::mem::swap(&mut self.tour, &mut self.spare);
        self.index();
        self.work += self.nodes as u64;
    }

    /// Exchanges two stretches that follow each other (a double bridge).
    fn kick(&mut self, rng: &mut impl Rng) {
        let n = self.nodes;
        let left = rng.random_range(1..=LONGEST_KICK.min(n / 3));
        let right = rng.random_range(1..=LONGEST_KICK.min(n / 3));
        let first = rng.random_range(1..=n - 1 - left - right);
        for at in
            [first - 1, first, first + left - 1, first + left, first + left + right - 1, first + left + right]
        {
            let node = self.tour[at];
            self.enqueue(node);
        }
        self.tour[first..first + left + right].rotate_left(left);
        self.index();
    }
}
