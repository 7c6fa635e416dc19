//! Turns chosen states into collision-free legs, choosing anew where a leg has no way.
//!
//! Moves are checked only when the choice uses them. One that collides is
//! first made dearer, so that another branch, turn or roll may avoid it; if
//! the choice still wants it, a detour is searched; if there is none, it is
//! forbidden. A view that stays unreachable is left out.

use super::candidates::Candidate;
use super::choice::{Breadth, Chooser, Label, Layer, PricedMove};
use super::detour::{Search, detour};
use super::joints::Joints;
use super::metric::Metric;
use super::plan::{LegStart, SkipReason};
use super::scene::Scene;
use super::sweep::Sweeper;

/// What a colliding move costs before its detour is known: so many times its travel, and seconds on top.
const DETOUR_GUESS: (f64, f64) = (1.5, 0.5);
/// Colliding moves into a view that other states may avoid before detours are searched.
const MOST_AVOIDED: usize = 12;
/// Searches without success after which a view is left out.
const MOST_FAILED_SEARCHES: usize = 3;
/// Layers chosen beyond the leg that is looked at: a collision there has only these chosen anew.
const LOOK_AHEAD: usize = 6;
/// Iterations of one search for a detour.
const SEARCH_ITERATIONS: usize = 1500;
/// Iterations of all searches of a plan.
const ALL_ITERATIONS: usize = 30_000;

/// How much more work than [`Breadth::USUAL`] the other breadth may take, about.
const THOROUGH: u64 = 4;

/// A visited view with the way to it.
#[derive(Clone, Debug)]
pub(crate) struct Stop {
    pub view: usize,
    pub candidate: Candidate,
    pub joints: Joints,
    /// From the previous stop (or the start) to here; empty if the motion begins here.
    pub waypoints: Vec<Joints>,
}

/// The stops and the views left out for want of a way.
#[derive(Default)]
pub(crate) struct Resolved {
    pub stops: Vec<Stop>,
    pub dropped: Vec<(usize, SkipReason)>,
    /// Cost of the chosen states, seconds.
    cost: f64,
}

/// A view whose choice may have cost later ones.
#[derive(Default)]
struct Trap {
    /// A view, and the one left out right after it.
    suspect: Option<(usize, Layer)>,
    /// Views that came back once.
    restored: Vec<usize>,
}

/// The joint state the motion starts from.
#[derive(Clone, Copy)]
pub(crate) struct StartState {
    pub joints: Joints,
    /// By how much margins are undercut at the start: the first leg may undercut them as much.
    pub relief_m: f64,
}

/// A move that was looked at, with its way if it has one.
struct KnownMove {
    from: Joints,
    to: Joints,
    /// `None`: collides, no detour searched yet. `Some(empty)`: no way.
    waypoints: Option<Vec<Joints>>,
}

struct Resolver<'a> {
    scene: &'a Scene<'a>,
    sweeper: &'a mut Sweeper,
    metric: Metric,
    start: Option<StartState>,
    layers: Vec<Layer>,
    known: std::collections::HashMap<usize, Vec<KnownMove>>,
    failed_searches: std::collections::HashMap<usize, usize>,
    iterations_left: usize,
    seed: u64,
}

/// What to do after a leg was looked at.
enum Verdict {
    Passes(Vec<Joints>),
    Priced,
    NoWay,
}

/// Legs through `layers` in their order. Where the work of `sweeper` ends, the views after the
/// last one that was settled are left out.
pub(crate) fn resolve(
    scene: &Scene,
    sweeper: &mut Sweeper,
    metric: &Metric,
    layers: Vec<Layer>,
    start: Option<StartState>,
    seed: u64,
) -> Resolved {
    let before = sweeper.work().spent();
    let usual = resolve_with(scene, sweeper, metric, layers.clone(), start, seed, Breadth::USUAL);
    // A joint that unwinds may not have to, had the motion begun some turns away.
    let unwinds = |stop: &Stop| stop.waypoints.windows(2).any(turns_half);
    let again = THOROUGH * (sweeper.work().spent() - before);
    if !usual.stops.iter().any(unwinds) || again > sweeper.work().left() {
        return usual;
    }
    let thorough = resolve_with(scene, sweeper, metric, layers, start, seed, Breadth::ALL_TURNS);
    let rank = |r: &Resolved| (r.dropped.len(), r.cost);
    if rank(&thorough) < rank(&usual) { thorough } else { usual }
}

/// Whether any joint moves by half a turn or more.
fn turns_half(pair: &[Joints]) -> bool {
    matches!(pair, [a, b] if a.iter().zip(b).any(|(a, b)| (a - b).abs() > std::f64::consts::PI))
}

fn resolve_with(
    scene: &Scene,
    sweeper: &mut Sweeper,
    metric: &Metric,
    layers: Vec<Layer>,
    start: Option<StartState>,
    seed: u64,
    breadth: Breadth,
) -> Resolved {
    let mut resolver = Resolver {
        scene,
        sweeper,
        metric: metric.clone(),
        start,
        layers,
        known: Default::default(),
        failed_searches: Default::default(),
        iterations_left: ALL_ITERATIONS,
        seed,
    };
    let mut chooser = Chooser::new(metric.clone(), scene.limits(), start.map(|s| s.joints), breadth);
    let mut resolved = Resolved::default();
    let mut trap = Trap::default();
    let mut changed_from = 0;
    let mut looked_at = 0;
    'choose: while !resolver.layers.is_empty() {
        if resolver.sweeper.work().is_over() {
            resolver.give_up(&mut resolved);
            break;
        }
        let total = resolver.layers.len();
        let chosen = (looked_at + LOOK_AHEAD).min(total);
        let chain = match chooser.choose(&resolver.layers, changed_from, chosen, resolver.sweeper.work()) {
            Ok(chain) => chain,
            Err(index) => {
                changed_from = index.saturating_sub(2);
                resolver.drop_layer(index, &mut trap, &mut resolved);
                continue;
            }
        };
        changed_from = usize::MAX;
        // The end of the chain is not settled before later views are chosen.
        let settled = if chosen == total { total } else { looked_at + 1 };
        resolved.stops.clear();
        for index in 0..settled {
            match resolver.look_at(&chain, index) {
                Verdict::Passes(waypoints) => resolved.stops.extend(resolver.stop(&chain, index, waypoints)),
                Verdict::Priced => {
                    changed_from = index.saturating_sub(1);
                    continue 'choose;
                }
                Verdict::NoWay => {
                    changed_from = index.saturating_sub(2);
                    resolver.drop_layer(index, &mut trap, &mut resolved);
                    continue 'choose;
                }
            }
        }
        resolved.cost = chain.last().map_or(0.0, |label| label.cost);
        if settled == total {
            break;
        }
        looked_at = settled;
    }
    if resolver.layers.is_empty() {
        resolved.stops.clear();
    }
    resolved
}

impl Resolver<'_> {
    fn stop(&self, chain: &[Label], index: usize, waypoints: Vec<Joints>) -> Option<Stop> {
        let (layer, label) = (self.layers.get(index)?, chain.get(index)?);
        let candidate = *layer.candidates.get(label.candidate)?;
        Some(Stop { view: layer.view, candidate, joints: label.joints, waypoints })
    }

    /// The leg that ends at `chain[index]`.
    fn look_at(&mut self, chain: &[Label], index: usize) -> Verdict {
        let Some((to, view)) = chain.get(index).map(|l| l.joints).zip(self.layers.get(index).map(|l| l.view))
        else {
            return Verdict::Passes(Vec::new());
        };
        let (from, relief_m) = match (index.checked_sub(1).and_then(|i| chain.get(i)), &self.start) {
            (Some(label), _) => (label.joints, 0.0),
            (None, Some(start)) => (start.joints, start.relief_m),
            (None, None) => return Verdict::Passes(Vec::new()),
        };
        let known = self.known.entry(view).or_default();
        match known.iter().find(|m| m.from == from && m.to == to).map(|m| m.waypoints.clone()) {
            Some(Some(waypoints)) if !waypoints.is_empty() => return Verdict::Passes(waypoints),
            Some(_) => return self.search(index, view, &from, &to, relief_m),
            None => {}
        }
        if self.sweeper.is_free(self.scene, &from, &to, &[0.0; 8], relief_m) {
            known.push(KnownMove { from, to, waypoints: Some(vec![from, to]) });
            return Verdict::Passes(vec![from, to]);
        }
        known.push(KnownMove { from, to, waypoints: None });
        let avoided = known.iter().filter(|m| m.waypoints.is_none()).count();
        if avoided > MOST_AVOIDED {
            return self.search(index, view, &from, &to, relief_m);
        }
        let cost = DETOUR_GUESS.0 * self.metric.cost(&from, &to) + DETOUR_GUESS.1;
        self.price(index, &from, &to, cost);
        Verdict::Priced
    }

    fn search(&mut self, index: usize, view: usize, from: &Joints, to: &Joints, relief_m: f64) -> Verdict {
        let failed = self.failed_searches.get(&view).copied().unwrap_or(0);
        let seed = self.seed ^ (view as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (failed as u64) << 48;
        let search = Search { seed, iterations: SEARCH_ITERATIONS.min(self.iterations_left) };
        let (found, used) = detour(self.scene, self.sweeper, from, to, relief_m, &search);
        self.iterations_left -= used.min(self.iterations_left);
        match found {
            Some(waypoints) => {
                let cost = self.metric.path_cost(&waypoints);
                self.remember(view, from, to, waypoints.clone());
                self.price(index, from, to, cost);
                Verdict::Passes(waypoints)
            }
            None => {
                self.remember(view, from, to, Vec::new());
                self.price(index, from, to, f64::INFINITY);
                self.failed_searches.insert(view, failed + 1);
                if failed + 1 >= MOST_FAILED_SEARCHES { Verdict::NoWay } else { Verdict::Priced }
            }
        }
    }

    fn remember(&mut self, view: usize, from: &Joints, to: &Joints, waypoints: Vec<Joints>) {
        let known = self.known.entry(view).or_default();
        match known.iter_mut().find(|m| m.from == *from && m.to == *to) {
            Some(found) => found.waypoints = Some(waypoints),
            None => known.push(KnownMove { from: *from, to: *to, waypoints: Some(waypoints) }),
        }
    }

    fn price(&mut self, index: usize, from: &Joints, to: &Joints, cost: f64) {
        let Some(layer) = self.layers.get_mut(index) else { return };
        match layer.priced.iter_mut().find(|p| p.from == *from && p.to == *to) {
            Some(priced) => priced.cost = cost,
            None => layer.priced.push(PricedMove { from: *from, to: *to, cost }),
        }
    }

    /// Leaves out the view of layer `index`, which cannot be reached from the one before.
    ///
    /// If the view before had already cost another one, it is itself the
    /// trap: it goes instead, and the other one comes back (once).
    fn drop_layer(&mut self, index: usize, trap: &mut Trap, resolved: &mut Resolved) {
        let Some(before) = index.checked_sub(1).and_then(|i| self.layers.get(i)).map(|l| l.view) else {
            self.leave_out(index, LegStart::Start, resolved);
            return;
        };
        let Trap { suspect, restored } = trap;
        let trapped = suspect.take_if(|(view, lost)| *view == before && !restored.contains(&lost.view));
        if let Some((_, lost)) = trapped {
            restored.push(lost.view);
            self.failed_searches.remove(&lost.view);
            resolved.dropped.retain(|(view, _)| *view != lost.view);
            if let Some(layer) = self.layers.get(index) {
                self.failed_searches.remove(&layer.view);
            }
            let to = LegStart::View(lost.view);
            self.layers.insert(index, lost);
            self.leave_out(index - 1, to, resolved);
            return;
        }
        if let Some(layer) = self.leave_out(index, LegStart::View(before), resolved) {
            *suspect = Some((before, layer));
        }
    }

    /// Leaves out all views that are not settled.
    fn give_up(&mut self, resolved: &mut Resolved) {
        // Stops from the first whose view has fallen out are not connected.
        let stands = |(stop, layer): &(&Stop, &Layer)| stop.view == layer.view;
        let standing = resolved.stops.iter().zip(&self.layers).take_while(stands).count();
        resolved.stops.truncate(standing);
        let settled: Vec<usize> = resolved.stops.iter().map(|stop| stop.view).collect();
        let open = self.layers.iter().map(|layer| layer.view).filter(|view| !settled.contains(view));
        resolved.dropped.extend(open.map(|view| (view, SkipReason::WorkLimit)));
    }

    fn leave_out(&mut self, index: usize, from: LegStart, resolved: &mut Resolved) -> Option<Layer> {
        if index >= self.layers.len() {
            return None;
        }
        let layer = self.layers.remove(index);
        let attempts = self
            .known
            .get(&layer.view)
            .map_or(0, |k| k.iter().filter(|m| m.waypoints.as_ref().is_none_or(Vec::is_empty)).count());
        resolved.dropped.push((layer.view, SkipReason::NoPath { from, attempts }));
        Some(layer)
    }
}
