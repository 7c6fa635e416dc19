//! Everything that pivots update, computed afresh from the basis.

use super::{LinearProgram, Place};

impl LinearProgram {
    /// Computes inverse, values and reduced costs afresh.
    pub(super) fn refactor(&mut self) {
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
