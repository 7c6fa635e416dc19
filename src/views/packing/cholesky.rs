//! Cholesky factorisation of a symmetric matrix whose rows are empty left of some column.

/// Lower half of a symmetric positive definite matrix; row `i` is stored from column `first[i]`.
/// The factor fills nothing in left of it, so neighbours numbered close together keep it small.
pub(super) struct Envelope {
    first: Vec<usize>,
    start: Vec<usize>,
    values: Vec<f64>,
}

impl Envelope {
    /// A zero matrix with these row beginnings.
    pub(super) fn new(first: Vec<usize>) -> Envelope {
        let mut start = Vec::with_capacity(first.len() + 1);
        let mut total = 0;
        for (row, &column) in first.iter().enumerate() {
            start.push(total);
            total += row + 1 - column;
        }
        start.push(total);
        Envelope { first, start, values: vec![0.0; total] }
    }

    /// Sets all entries to zero.
    pub(super) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds to an entry of the lower half, `first[row] <= column <= row`.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.values[self.start[row] + column - self.first[row]] += value;
    }

    /// Replaces the matrix by its factor. Pivots that are not positive (rounding) become `floor`.
    pub(super) fn factor(&mut self, floor: f64) {
        for i in 0..self.first.len() {
            let (done, rest) = self.values.split_at_mut(self.start[i]);
            let row = &mut rest[..i + 1 - self.first[i]];
            let begin = self.first[i];
            for j in begin..i {
                let other = &done[self.start[j]..self.start[j + 1]];
                let from = begin.max(self.first[j]);
                let sum: f64 = row[from - begin..j - begin]
                    .iter()
                    .zip(&other[from - self.first[j]..])
                    .map(|(a, b)| a * b)
                    .sum();
                row[j - begin] = (row[j - begin] - sum) / other[j - self.first[j]];
            }
            let square: f64 = row[..i - begin].iter().map(|v| v * v).sum();
            row[i - begin] = (row[i - begin] - square).max(floor).sqrt();
        }
    }

    /// Solves with the factor, in place.
    pub(super) fn solve(&self, x: &mut [f64]) {
        for i in 0..self.first.len() {
            let row = &self.values[self.start[i]..self.start[i + 1]];
            let begin = self.first[i];
            let sum: f64 = row[..i - begin].iter().zip(&x[begin..i]).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - sum) / row[i - begin];
        }
        for i in (0..self.first.len()).rev() {
            let row = &self.values[self.start[i]..self.start[i + 1]];
            let begin = self.first[i];
            x[i] /= row[i - begin];
            let value = x[i];
            x[begin..i].iter_mut().zip(row).for_each(|(x, v)| *x -= value * v);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solved_system_reproduces_its_right_hand_side() {
        // Rows reach back to columns 0, 0, 1, 0, 3.
        let first = vec![0, 0, 1, 0, 3];
        let mut full = [[0.0; 5]; 5];
        let mut matrix = Envelope::new(first.clone());
        for i in 0..5 {
            #[expect(clippy::needless_range_loop, reason = "i and j are row and column of one matrix")]
            for j in first[i]..=i {
                let value = if i == j { 6.0 + i as f64 } else { 1.0 + (i * j) as f64 * 0.3 };
                matrix.add(i, j, value);
                full[i][j] = value;
                full[j][i] = value;
            }
        }
        matrix.factor(1e-30);
        let right = [1.0, -2.0, 3.0, 0.5, 4.0];
        let mut x = right;
        matrix.solve(&mut x);
        for i in 0..5 {
            let product: f64 = (0..5).map(|j| full[i][j] * x[j]).sum();
            assert!((product - right[i]).abs() < 1e-12);
        }
    }
}
