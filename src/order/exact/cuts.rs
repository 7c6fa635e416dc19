//! Inequalities that every tour satisfies and a fractional solution does not.

use super::held_karp::Edge;

/// A violation below this is not worth a row.
const VIOLATION: f64 = 1e-6;
/// Combs must be violated by more, they are found by guessing.
const COMB_VIOLATION: f64 = 1e-3;
/// An edge with at least this value counts as used.
const WHOLE: f64 = 1.0 - 1e-9;
/// Most times that touching teeth may change a handle; it could swing to and fro for ever.
const ADJUSTMENTS: usize = 10;

/// `sum over sets of x(edges inside the set) <= right`: with one set a subtour cut, with a handle
/// and teeth a comb.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cut {
    pub sets: Vec<Vec<bool>>,
    pub right: f64,
}

impl Cut {
    /// How often an edge counts.
    pub(super) fn coefficient(&self, edge: &Edge) -> f64 {
        self.sets.iter().filter(|set| set[edge.a] && set[edge.b]).count() as f64
    }

    fn violation(&self, edges: &[Edge], x: &[f64]) -> f64 {
        edges.iter().zip(x).map(|(edge, x)| self.coefficient(edge) * x).sum::<f64>() - self.right
    }

    /// At most `|set| - 1` edges inside the set; said of the smaller side.
    fn subtour(mut set: Vec<bool>) -> Cut {
        let size = set.iter().filter(|s| **s).count();
        let mut count = size;
        if 2 * size > set.len() {
            set.iter_mut().for_each(|s| *s = !*s);
            count = set.len() - size;
        }
        Cut { sets: vec![set], right: count as f64 - 1.0 }
    }
}

/// Cuts violated by `x`: components that are not connected, else cuts below 2, else combs.
pub(super) fn separate(nodes: usize, edges: &[Edge], x: &[f64]) -> Vec<Cut> {
    let support: Vec<(usize, usize, f64)> =
        edges.iter().zip(x).filter(|(_, x)| **x > 1e-9).map(|(e, x)| (e.a, e.b, *x)).collect();
    let parts = components(nodes, support.iter().map(|&(a, b, _)| (a, b)));
    if parts.len() > 1 {
        return parts.into_iter().map(Cut::subtour).collect();
    }
    let cuts = small_cuts(nodes, &support);
    if !cuts.is_empty() {
        return cuts;
    }
    combs(nodes, edges, x, &support)
}

/// Node sets connected by `links`, as membership vectors.
fn components(nodes: usize, links: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<bool>> {
    let mut label: Vec<usize> = (0..nodes).collect();
    for (a, b) in links {
        let (a, b) = (root(&mut label, a), root(&mut label, b));
        label[a.max(b)] = a.min(b);
    }
    let roots: Vec<usize> = (0..nodes).map(|k| root(&mut label, k)).collect();
    (0..nodes).filter(|&k| roots[k] == k).map(|k| roots.iter().map(|&r| r == k).collect()).collect()
}

fn root(label: &mut [usize], mut k: usize) -> usize {
    while label[k] != k {
        label[k] = label[label[k]];
        k = label[k];
    }
    k
}

/// Sets whose edges outwards sum to less than 2 (Stoer and Wagner's minimum cut, every phase's
/// cut looked at), after joining the ends of edges with value 1, which loses no such set.
fn small_cuts(nodes: usize, support: &[(usize, usize, f64)]) -> Vec<Cut> {
    let groups = components(nodes, support.iter().filter(|e| e.2 >= WHOLE).map(|&(a, b, _)| (a, b)));
    if groups.len() < 3 {
        return Vec::new();
    }
    let mut group_of = vec![0; nodes];
    for (g, members) in groups.iter().enumerate() {
        members.iter().enumerate().filter(|(_, m)| **m).for_each(|(k, _)| group_of[k] = g);
    }
    let n = groups.len();
    let mut weight = vec![0.0; n * n];
    for &(a, b, x) in support {
        let (a, b) = (group_of[a], group_of[b]);
        if a != b {
            weight[a * n + b] += x;
            weight[b * n + a] += x;
        }
    }
    let mut members = groups;
    let mut alive: Vec<usize> = (0..n).collect();
    let mut cuts: Vec<Cut> = Vec::new();
    while alive.len() > 1 {
        let mut joined = vec![false; n];
        let mut pull = vec![0.0f64; n];
        let (mut previous, mut last) = (alive[0], alive[0]);
        for _ in 0..alive.len() {
            let Some(&next) = alive
                .iter()
                .filter(|&&k| !joined[k])
                .max_by(|&&a, &&b| pull[a].total_cmp(&pull[b]).then(b.cmp(&a)))
            else {
                break;
            };
            joined[next] = true;
            (previous, last) = (last, next);
            for &k in &alive {
                if !joined[k] {
                    pull[k] += weight[next * n + k];
                }
            }
        }
        if pull[last] < 2.0 - VIOLATION {
            let cut = Cut::subtour(members[last].clone());
            if !cuts.contains(&cut) {
                cuts.push(cut);
            }
        }
        for &k in &alive {
            if k != previous && k != last {
                let joint = weight[previous * n + k] + weight[last * n + k];
                weight[previous * n + k] = joint;
                weight[k * n + previous] = joint;
            }
        }
        let moved = std::mem::take(&mut members[last]);
        members[previous].iter_mut().zip(moved).for_each(|(m, add)| *m |= add);
        alive.retain(|&k| k != last);
    }
    cuts
}

/// Combs whose teeth are single edges (2-matching inequalities): handles are the connected parts
/// of the fractional edges, teeth the edges of value near 1 that leave them (heuristic of Padberg
/// and Hong), tried for several notions of "fractional" and "near 1".
fn combs(nodes: usize, edges: &[Edge], x: &[f64], support: &[(usize, usize, f64)]) -> Vec<Cut> {
    let mut cuts: Vec<Cut> = Vec::new();
    for slack in [1e-9, 0.1, 0.2, 0.3] {
        let fractional = support.iter().filter(|e| e.2 > slack && e.2 < 1.0 - slack);
        for handle in components(nodes, fractional.map(|&(a, b, _)| (a, b))) {
            let size = handle.iter().filter(|h| **h).count();
            if size < 3 || size > nodes - 3 {
                continue;
            }
            let comb = comb_with_handle(handle, support);
            cuts.extend(comb.filter(|cut| cut.violation(edges, x) > COMB_VIOLATION && !cuts.contains(cut)));
        }
    }
    cuts
}

/// The best comb with this handle and single-edge teeth: an odd number of the edges that leave
/// it, each with a value above one half where possible.
fn comb_with_handle(mut handle: Vec<bool>, support: &[(usize, usize, f64)]) -> Option<Cut> {
    let nodes = handle.len();
    for _ in 0..ADJUSTMENTS {
        let mut leaving: Vec<(usize, usize, f64)> =
            support.iter().copied().filter(|&(a, b, _)| handle[a] != handle[b]).collect();
        leaving.sort_by(|p, q| q.2.total_cmp(&p.2).then((p.0, p.1).cmp(&(q.0, q.1))));
        let mut count = leaving.iter().filter(|e| e.2 > 0.5).count();
        if count % 2 == 0 {
            // One more or one fewer: whichever loses less.
            let gain = leaving.get(count).map_or(-1.0, |e| e.2 - 0.5);
            let loss = if count > 0 { 0.5 - leaving[count - 1].2 } else { -1.0 };
            if gain >= loss { count += 1 } else { count -= 1 }
        }
        if count < 3 || count > leaving.len() {
            return None;
        }
        let teeth = &leaving[..count];
        // Teeth must not touch. Two that meet outside put their meeting point into the handle,
        // two that meet inside take it out.
        let mut seen = vec![false; nodes];
        let mut shared = None;
        for &(a, b, _) in teeth {
            for k in [a, b] {
                if seen[k] {
                    shared = Some(k);
                }
                seen[k] = true;
            }
        }
        match shared {
            Some(k) if !handle[k] => handle[k] = true,
            Some(k) => {
                handle[k] = false;
                if handle.iter().filter(|h| **h).count() < 3 {
                    return None;
                }
            }
            None => {
                let size = handle.iter().filter(|h| **h).count();
                let mut sets = vec![handle];
                sets.extend(teeth.iter().map(|&(a, b, _)| {
                    let mut tooth = vec![false; nodes];
                    tooth[a] = true;
                    tooth[b] = true;
                    tooth
                }));
                return Some(Cut { sets, right: size as f64 + (count - 1) as f64 / 2.0 });
            }
        }
    }
    None
}
