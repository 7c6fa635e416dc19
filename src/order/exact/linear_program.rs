//! A linear programme that grows by rows: bounded dual simplex on an explicit inverse.
//!
//! `min cost x`, rows `a x = b` or `a x <= b`, every variable between two finite bounds. Since
//! all variables are boxed, any basis is dual feasible once its nonbasic variables sit at the
//! right bound, and stays so when a row is added: cutting planes are what this is for. Sizes are
//! a few hundred rows and columns, where a dense inverse is faster than a factorisation.

/// Basic variables may exceed their bounds by this much.
const FEASIBLE: f64 = 1e-9;
/// Entries of the pivot row below this are zero.
const PIVOT: f64 = 1e-8;
/// Pivots after which the inverse is computed afresh.
const REFRESH: usize = 400;

/// Where a variable stands.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Basic,
    Lower,
    Upper,
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Outcome {
    /// Feasible and optimal up to the tolerance.
    Optimal,
    /// No point satisfies the rows and bounds.
    Infeasible,
    /// The objective passed the cutoff: the optimum is at least that.
    Cutoff,
    /// Out of pivots.
    Unfinished,
}

/// A row: sum of `coefficient * x[column]`, `=` or `<=` the right-hand side.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub entries: Vec<(usize, f64)>,
    pub right: f64,
    pub equality: bool,
}

/// See the module. Variables are the columns, then one slack per row.
#[derive(Debug, Clone)]
pub(super) struct LinearProgram {
    columns: Vec<Vec<(u32, f64)>>,
    cost: Vec<f64>,
    right: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    place: Vec<Place>,
    value: Vec<f64>,
    reduced: Vec<f64>,
    /// Variable that is basic in each position.
    basis: Vec<usize>,
    /// One row of the basis' inverse per position.
    inverse: Vec<Vec<f64>>,
    since_refresh: usize,
    /// Multiplications done, to count work independently of the machine.
    pub work: u64,
}

impl LinearProgram {
    /// No rows yet; every column between 0 and 1.
    pub(super) fn new(cost: Vec<f64>) -> LinearProgram {
        let n = cost.len();
        let place: Vec<Place> =
            cost.iter().map(|&c| if c < 0.0 { Place::Upper } else { Place::Lower }).collect();
        let value = place.iter().map(|&p| if p == Place::Upper { 1.0 } else { 0.0 }).collect();
        LinearProgram {
            columns: vec![Vec::new(); n],
            reduced: cost.clone(),
            cost,
            right: Vec::new(),
            lower: vec![0.0; n],
            upper: vec![1.0; n],
            place,
            value,
            basis: Vec::new(),
            inverse: Vec::new(),
            since_refresh: 0,
            work: 0,
        }
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.basis.len()
    }

    /// Values of the columns.
    pub(super) fn values(&self) -> &[f64] {
        &self.value[..self.columns.len()]
    }

    /// Adds a row; its slack becomes basic.
    pub(super) fn add_row(&mut self, row: &Row) {
        let index = self.rows();
        let mut activity = 0.0;
        let mut in_basis = vec![0.0; index];
        let mut position_of = std::collections::HashMap::new();
        for (position, &variable) in self.basis.iter().enumerate() {
            position_of.insert(variable, position);
        }
        for &(column, coefficient) in &row.entries {
            self.columns[column].push((index as u32, coefficient));
            activity += coefficient * self.value[column];
            if let Some(&position) = position_of.get(&column) {
                in_basis[position] = coefficient;
            }
        }
        let mut last = vec![0.0; index + 1];
        for (position, &coefficient) in in_basis.iter().enumerate() {
            if coefficient != 0.0 {
                for (l, v) in last.iter_mut().zip(&self.inverse[position]) {
                    *l -= coefficient * v;
                }
            }
        }
        last[index] = 1.0;
        self.inverse.iter_mut().for_each(|r| r.push(0.0));
        self.inverse.push(last);
        self.basis.push(self.columns.len() + index);
        self.right.push(row.right);
        self.lower.push(0.0);
        self.upper.push(if row.equality { 0.0 } else { f64::INFINITY });
        self.place.push(Place::Basic);
        self.value.push(row.right - activity);
        self.reduced.push(0.0);
        self.work += (index * (index + 1)) as u64;
    }

    /// Drops the rows whose slack is basic and larger than `slack`, except the first `keep`.
    pub(super) fn drop_loose_rows(&mut self, keep: usize, slack: f64) {
        let columns = self.columns.len();
        let mut row = self.rows();
        while row > keep {
            row -= 1;
            let variable = columns + row;
            if self.place[variable] != Place::Basic || self.value[variable] <= slack {
                continue;
            }
            let Some(position) = self.basis.iter().position(|&v| v == variable) else { continue };
            self.basis.remove(position);
            self.inverse.remove(position);
            for inverse_row in &mut self.inverse {
                inverse_row.remove(row);
            }
            self.basis.iter_mut().filter(|v| **v > variable).for_each(|v| *v -= 1);
            for column in &mut self.columns {
                column.retain(|&(r, _)| r as usize != row);
                column.iter_mut().filter(|(r, _)| *r as usize > row).for_each(|(r, _)| *r -= 1);
            }
            self.right.remove(row);
            self.lower.remove(variable);
            self.upper.remove(variable);
            self.place.remove(variable);
            self.value.remove(variable);
            self.reduced.remove(variable);
        }
    }

    /// Narrows the bounds of a column to `value`.
    pub(super) fn fix(&mut self, column: usize, value: f64) {
        self.lower[column] = value;
        self.upper[column] = value;
        if self.place[column] != Place::Basic {
            let change = value - self.value[column];
            self.place[column] = if value > 0.5 { Place::Upper } else { Place::Lower };
            if change != 0.0 {
                self.value[column] = value;
                self.shift_basics(&[(column, change)]);
            }
        }
    }

    /// Runs the dual simplex for at most `pivots` pivots.
    pub(super) fn solve(&mut self, cutoff: f64, pivots: usize) -> Outcome {
        for _ in 0..pivots {
            if self.since_refresh >= REFRESH {
                self.refactor();
            }
            let Some((position, below)) = self.most_infeasible() else { return Outcome::Optimal };
            if !self.pivot(position, below) {
                return Outcome::Infeasible;
            }
            if self.objective() >= cutoff {
                return Outcome::Cutoff;
            }
        }
        Outcome::Unfinished
    }

    /// Cost of the present point; a lower bound as long as the duals are exact.
    fn objective(&self) -> f64 {
        self.cost.iter().zip(&self.value).map(|(c, v)| c * v).sum()
    }

    /// A lower bound that holds whatever rounding did to the inverse: any prices on the rows give
    /// one, if those on inequalities have the right sign. Also renews the reduced costs.
    pub(super) fn safe_bound(&mut self) -> f64 {
        let (rows, columns) = (self.rows(), self.columns.len());
        let mut prices = vec![0.0; rows];
        for (position, &variable) in self.basis.iter().enumerate() {
            let cost = if variable < columns { self.cost[variable] } else { 0.0 };
            if cost != 0.0 {
                prices.iter_mut().zip(&self.inverse[position]).for_each(|(p, v)| *p += cost * v);
            }
        }
        let mut bound = 0.0;
        for row in 0..rows {
            if self.upper[columns + row] > 0.0 {
                prices[row] = prices[row].min(0.0);
            }
            bound += prices[row] * self.right[row];
            if self.place[columns + row] != Place::Basic {
                self.reduced[columns + row] = -prices[row];
            }
        }
        for column in 0..columns {
            let mut reduced = self.cost[column];
            for &(row, coefficient) in &self.columns[column] {
                reduced -= prices[row as usize] * coefficient;
            }
            bound += (reduced * self.lower[column]).min(reduced * self.upper[column]);
            if self.place[column] != Place::Basic {
                self.reduced[column] = reduced;
            }
        }
        self.work += (rows * rows) as u64;
        bound
    }

    /// Fixes every column that no solution cheaper than `cutoff` can move from its bound, given
    /// the `bound` just computed. Returns how many were fixed.
    pub(super) fn fix_by_reduced_cost(&mut self, bound: f64, cutoff: f64) -> usize {
        let mut fixed = 0;
        for column in 0..self.columns.len() {
            if self.lower[column] == self.upper[column] {
                continue;
            }
            let reduced = self.reduced[column];
            match self.place[column] {
                Place::Lower if bound + reduced > cutoff => self.upper[column] = self.lower[column],
                Place::Upper if bound - reduced > cutoff => self.lower[column] = self.upper[column],
                _ => continue,
            }
            fixed += 1;
        }
        fixed
    }

    fn most_infeasible(&self) -> Option<(usize, bool)> {
        let mut worst = FEASIBLE;
        let mut found = None;
        for (position, &variable) in self.basis.iter().enumerate() {
            let value = self.value[variable];
            let (under, over) = (self.lower[variable] - value, value - self.upper[variable]);
            if under > worst {
                (worst, found) = (under, Some((position, true)));
            } else if over > worst {
                (worst, found) = (over, Some((position, false)));
            }
        }
        found
    }

    /// Entry of `inverse[position] * A` in the column of `variable`.
    fn tableau_entry(&self, price_row: &[f64], variable: usize) -> f64 {
        match self.columns.get(variable) {
            Some(column) => column.iter().map(|&(row, c)| price_row[row as usize] * c).sum(),
            None => price_row[variable - self.columns.len()],
        }
    }

    /// Moves the basic variable of `position` to the bound it exceeds. False if nothing can enter.
    fn pivot(&mut self, position: usize, below: bool) -> bool {
        let leaving = self.basis[position];
        let bound = if below { self.lower[leaving] } else { self.upper[leaving] };
        let price_row = std::mem::take(&mut self.inverse[position]);
        let sign = if below { -1.0 } else { 1.0 };
        let mut row: Vec<(usize, f64)> = Vec::with_capacity(self.place.len());
        let mut candidates: Vec<(f64, usize, f64)> = Vec::new();
        for variable in 0..self.place.len() {
            if self.place[variable] == Place::Basic {
                continue;
            }
            let entry = self.tableau_entry(&price_row, variable);
            if entry.abs() < PIVOT {
                continue;
            }
            row.push((variable, entry));
            if self.lower[variable] == self.upper[variable] {
                continue;
            }
            let signed = sign * entry;
            let helps = if self.place[variable] == Place::Lower { signed > 0.0 } else { signed < 0.0 };
            if helps {
                candidates.push(((self.reduced[variable] / signed).max(0.0), variable, entry));
            }
        }
        self.work += (row.len() * 4 + self.rows()) as u64;
        candidates.sort_unstable_by(|a, b| {
            a.0.total_cmp(&b.0).then(b.2.abs().total_cmp(&a.2.abs())).then(a.1.cmp(&b.1))
        });
        // Long step: as long as the row stays infeasible, candidates jump to their other bound.
        let mut slope = (self.value[leaving] - bound).abs();
        let mut flips = Vec::new();
        let mut entering = None;
        for &(_, variable, entry) in &candidates {
            let relief = entry.abs() * (self.upper[variable] - self.lower[variable]);
            if slope - relief > FEASIBLE {
                slope -= relief;
                flips.push(variable);
            } else {
                entering = Some((variable, entry));
                break;
            }
        }
        self.inverse[position] = price_row;
        let Some((entering, entry)) = entering else { return false };
        self.flip(&flips);

        let dual_step = self.reduced[entering] / entry;
        if dual_step != 0.0 {
            for &(variable, entry) in &row {
                self.reduced[variable] -= dual_step * entry;
            }
        }
        self.reduced[entering] = 0.0;
        self.reduced[leaving] = -dual_step;

        let column = self.basis_column(entering);
        let step = (self.value[leaving] - bound) / column[position];
        for (at, weight) in column.iter().enumerate() {
            self.value[self.basis[at]] -= step * weight;
        }
        self.value[entering] += step;
        self.value[leaving] = bound;
        self.place[leaving] = if below { Place::Lower } else { Place::Upper };
        self.place[entering] = Place::Basic;
        self.basis[position] = entering;
        self.eliminate(position, &column);
        self.since_refresh += 1;
        true
    }

    fn flip(&mut self, variables: &[usize]) {
        let mut changes = Vec::with_capacity(variables.len());
        for &variable in variables {
            let to_upper = self.place[variable] == Place::Lower;
            let target = if to_upper { self.upper[variable] } else { self.lower[variable] };
            changes.push((variable, target - self.value[variable]));
            self.value[variable] = target;
            self.place[variable] = if to_upper { Place::Upper } else { Place::Lower };
        }
        if !changes.is_empty() {
            self.shift_basics(&changes);
        }
    }

    /// What the basics do when nonbasic variables change.
    fn shift_basics(&mut self, changes: &[(usize, f64)]) {
        let mut load = vec![0.0; self.rows()];
        for &(variable, change) in changes {
            match self.columns.get(variable) {
                Some(column) => column.iter().for_each(|&(row, c)| load[row as usize] += c * change),
                None => load[variable - self.columns.len()] += change,
            }
        }
        for (position, &variable) in self.basis.iter().enumerate() {
            let shift: f64 = self.inverse[position].iter().zip(&load).map(|(v, l)| v * l).sum();
            self.value[variable] -= shift;
        }
        self.work += (self.rows() * self.rows()) as u64;
    }

    fn basis_column(&self, variable: usize) -> Vec<f64> {
        let slack = variable.checked_sub(self.columns.len());
        self.inverse
            .iter()
            .map(|inverse_row| match slack {
                Some(row) => inverse_row[row],
                None => self.columns[variable].iter().map(|&(row, c)| inverse_row[row as usize] * c).sum(),
            })
            .collect()
    }

    /// The inverse after the variable with this column took over `position`.
    fn eliminate(&mut self, position: usize, column: &[f64]) {
        let mut pivot_row = std::mem::take(&mut self.inverse[position]);
        let scale = 1.0 / column[position];
        pivot_row.iter_mut().for_each(|v| *v *= scale);
        for (at, row) in self.inverse.iter_mut().enumerate() {
            let factor = column[at];
            if at != position && factor != 0.0 {
                row.iter_mut().zip(&pivot_row).for_each(|(r, p)| *r -= factor * p);
                self.work += pivot_row.len() as u64;
            }
        }
        self.inverse[position] = pivot_row;
    }

    /// Computes inverse, values and reduced costs afresh.
    fn refactor(&mut self) {
        self.since_refresh = 0;
        let (rows, columns) = (self.rows(), self.columns.len());
        // Start from the slacks and pivot the basic columns in, each where it is largest.
        let wanted: Vec<usize> = self.basis.iter().copied().filter(|&v| v < columns).collect();
        let mut taken = vec![false; rows];
        for (position, row) in self.inverse.iter_mut().enumerate() {
            row.fill(0.0);
            row[position] = 1.0;
        }
        for &variable in &self.basis {
            if let Some(row) = variable.checked_sub(columns) {
                taken[row] = true;
            }
        }
        let mut basis: Vec<usize> = (columns..columns + rows).collect();
        for variable in wanted {
            let column = self.basis_column(variable);
            let best = (0..rows)
                .filter(|&row| !taken[row])
                .max_by(|&a, &b| column[a].abs().total_cmp(&column[b].abs()));
            match best {
                Some(row) if column[row].abs() > 1e-10 => {
                    taken[row] = true;
                    basis[row] = variable;
                    self.eliminate(row, &column);
                }
                // Dependent by rounding: the variable leaves, a slack stays in its place.
                _ => {
                    self.place[variable] = Place::Lower;
                    self.value[variable] = self.lower[variable];
                }
            }
        }
        for &variable in &basis {
            self.place[variable] = Place::Basic;
        }
        self.basis = basis;
        self.safe_bound();
        // Nonbasic variables go to the bound that their reduced cost asks for.
        for variable in 0..columns {
            if self.place[variable] != Place::Basic {
                let up = self.reduced[variable] < 0.0;
                self.place[variable] = if up { Place::Upper } else { Place::Lower };
                self.value[variable] = if up { self.upper[variable] } else { self.lower[variable] };
            }
        }
        for position in 0..rows {
            self.reduced[self.basis[position]] = 0.0;
        }
        let mut load = self.right.clone();
        for variable in 0..self.place.len() {
            if self.place[variable] == Place::Basic || self.value[variable] == 0.0 {
                continue;
            }
            let value = self.value[variable];
            match self.columns.get(variable) {
                Some(column) => column.iter().for_each(|&(row, c)| load[row as usize] -= c * value),
                None => load[variable - columns] -= value,
            }
        }
        for position in 0..rows {
            let value = self.inverse[position].iter().zip(&load).map(|(v, l)| v * l).sum();
            self.value[self.basis[position]] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn row(entries: &[(usize, f64)], right: f64, equality: bool) -> Row {
        Row { entries: entries.to_vec(), right, equality }
    }

    proptest! {
        #[test]
        fn a_knapsack_is_filled_greedily(gains in prop::collection::vec((0.1..5.0f64, 0.1..5.0f64), 1..12), room in 0.0..20.0f64) {
            // The fractional knapsack has a closed solution: best gain per weight first.
            let mut lp = LinearProgram::new(gains.iter().map(|&(gain, _)| -gain).collect());
            let entries: Vec<_> = gains.iter().enumerate().map(|(k, &(_, weight))| (k, weight)).collect();
            lp.add_row(&row(&entries, room, false));
            prop_assert_eq!(lp.solve(f64::INFINITY, 1000), Outcome::Optimal);
            let mut sorted = gains.clone();
            sorted.sort_by(|a, b| (b.0 / b.1).total_cmp(&(a.0 / a.1)));
            let (mut left, mut best) = (room, 0.0);
            for (gain, weight) in sorted {
                let share = (left / weight).clamp(0.0, 1.0);
                best += share * gain;
                left -= share * weight;
            }
            prop_assert!((lp.safe_bound() + best).abs() < 1e-9);
        }
    }

    #[test]
    fn contradicting_rows_are_infeasible() {
        let mut lp = LinearProgram::new(vec![1.0, 1.0]);
        lp.add_row(&row(&[(0, 1.0), (1, 1.0)], 1.5, true));
        assert_eq!(lp.solve(f64::INFINITY, 100), Outcome::Optimal);
        lp.add_row(&row(&[(0, 1.0), (1, 1.0)], 1.0, false));
        assert_eq!(lp.solve(f64::INFINITY, 100), Outcome::Infeasible);
    }

    #[test]
    fn a_fresh_inverse_changes_nothing() {
        let mut lp = LinearProgram::new(vec![1.0, 2.0, -1.0, 0.5]);
        lp.add_row(&row(&[(0, 1.0), (1, 1.0), (2, 1.0)], 1.5, true));
        lp.add_row(&row(&[(1, 1.0), (2, 1.0), (3, 2.0)], 1.2, false));
        assert_eq!(lp.solve(f64::INFINITY, 100), Outcome::Optimal);
        let before = (lp.safe_bound(), lp.values().to_vec());
        lp.refactor();
        assert_eq!(lp.solve(f64::INFINITY, 100), Outcome::Optimal);
        assert!((lp.safe_bound() - before.0).abs() < 1e-12);
        assert!(lp.values().iter().zip(&before.1).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
