//! A linear programme that grows by rows: bounded dual simplex on an explicit inverse.
//!
//! `min cost x`, rows `a x = b` or `a x <= b`, every variable between two finite bounds. Since
//! all variables are boxed, any basis is dual feasible once its nonbasic variables sit at the
//! right bound, and stays so when a row is added: cutting planes are what this is for. Sizes are
//! a few hundred rows and columns, where a dense inverse is faster than a factorisation.

/// Basic variables may exceed their bounds by this much.
const FEASIBLE: f64 = 1e-9;
/// Pivots after which the inverse is computed afresh.
const REFRESH: usize = 400;

mod pivot;
mod refresh;
#[cfg(test)]
mod tests;

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
    /// Out of pivots or work.
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

    /// Runs the dual simplex for at most `pivots` pivots and about `work` multiplications.
    pub(super) fn solve(&mut self, cutoff: f64, pivots: usize, work: u64) -> Outcome {
        let most = self.work.saturating_add(work);
        for _ in 0..pivots {
            if self.work > most {
                break;
            }
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
        for (row, price) in prices.iter_mut().enumerate() {
            if self.upper[columns + row] > 0.0 {
                *price = price.min(0.0);
            }
            bound += *price * self.right[row];
            if self.place[columns + row] != Place::Basic {
                self.reduced[columns + row] = -*price;
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
}
