//! One pivot of the dual simplex, and the updates it needs.

use super::{FEASIBLE, LinearProgram, Place};

/// Entries of the pivot row below this are zero.
const PIVOT: f64 = 1e-8;

impl LinearProgram {
    /// Position of the basic variable furthest outside its bounds, and whether it is below them.
    pub(super) fn most_infeasible(&self) -> Option<(usize, bool)> {
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
    pub(super) fn pivot(&mut self, position: usize, below: bool) -> bool {
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
        // Every column is looked at, and each of those in the row several times.
        self.work += (self.place.len() * 4 + row.len() * 4 + self.rows()) as u64;
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
    pub(super) fn shift_basics(&mut self, changes: &[(usize, f64)]) {
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

    /// `inverse * column`: how the basics depend on a variable.
    pub(super) fn basis_column(&self, variable: usize) -> Vec<f64> {
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
    pub(super) fn eliminate(&mut self, position: usize, column: &[f64]) {
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
}
