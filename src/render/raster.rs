//! Which triangle each coverage sample sees.

use super::project::OnScreen;

/// Entry of an identity buffer where nothing is seen.
pub(super) const NOTHING: u32 = u32::MAX;

/// Sample positions within a pixel, N of them; no two share a row or column.
pub(super) trait Pattern<const N: usize> {
    /// x and y from the pixel's corner, 0 to 1.
    const OFFSETS: [[f32; 2]; N];
    /// Samples lie on the lines (k + this) / N, whole k, in x as in y.
    const LINE: f32;
}

/// The sample patterns: the usual rotated grids (positions as Direct3D 11 lists them).
pub(super) struct Samples;

impl Pattern<1> for Samples {
    const OFFSETS: [[f32; 2]; 1] = [[0.5, 0.5]];
    const LINE: f32 = 0.5;
}

impl Pattern<4> for Samples {
    const OFFSETS: [[f32; 2]; 4] = [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]];
    const LINE: f32 = 0.5;
}

const fn sixteenths<const N: usize>(from_middle: [[i8; 2]; N]) -> [[f32; 2]; N] {
    let mut out = [[0.0; 2]; N];
    let mut i = 0;
    while i < N {
        out[i] = [0.5 + from_middle[i][0] as f32 / 16.0, 0.5 + from_middle[i][1] as f32 / 16.0];
        i += 1;
    }
    out
}

impl Pattern<8> for Samples {
    const OFFSETS: [[f32; 2]; 8] =
        sixteenths([[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]]);
    const LINE: f32 = 0.5;
}

impl Pattern<16> for Samples {
    #[rustfmt::skip]
    const OFFSETS: [[f32; 2]; 16] = sixteenths([
        [1, 1], [-1, -3], [-3, 2], [4, -1], [-5, -2], [2, 5], [5, 3], [3, -5],
        [-2, 6], [0, -7], [-4, -6], [-6, 4], [-8, 0], [7, -4], [6, 7], [-7, -8],
    ]);
    const LINE: f32 = 0.0;
}

/// Depths and triangle numbers of a rectangle of pixels, N samples each.
pub(super) struct Target<'a, const N: usize> {
    /// Left column and top row of the rectangle, pixels.
    pub(super) origin: [i32; 2],
    /// Width and height of the rectangle, pixels.
    pub(super) size: [i32; 2],
    /// 1/z of what each sample sees, 0 for nothing; row by row.
    pub(super) depth: &'a mut [[f32; N]],
    /// The triangle each sample sees, or [`NOTHING`].
    pub(super) ids: &'a mut [[u32; N]],
}

impl<const N: usize> Target<'_, N>
where
    Samples: Pattern<N>,
{
    /// Draws a triangle of either winding where it is nearer than what is there and
    /// `keep(x, y)` (pixels) holds.
    ///
    /// Every sample inside belongs to the triangle, and so does one less than about 1e-4
    /// pixels outside: two triangles that share an edge leave no gap between them, and the
    /// depth decides where both claim a sample.
    #[inline]
    pub(super) fn draw(&mut self, s: [OnScreen; 3], id: u32, keep: impl Fn(f32, f32) -> bool) {
        let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = s;
        let (least_x, most_x) = (least(least(ax, bx), cx), most(most(ax, bx), cx));
        let (least_y, most_y) = (least(least(ay, by), cy), most(most(ay, by), cy));
        let (Some((x0, x1)), Some((y0, y1))) =
            (self.covered(0, least_x, most_x), self.covered(1, least_y, most_y))
        else {
            return;
        };
        // Relative to the first pixel, so that small triangles far from the image's corner stay exact.
        let (ox, oy) = (x0 as f32, y0 as f32);
        let local = |[x, y, _]: OnScreen| [f64::from(x - ox), f64::from(y - oy)];
        let edge = |from: [f64; 2], to: [f64; 2]| -> [f64; 3] {
            let (a, b) = (from[1] - to[1], to[0] - from[0]);
            [a, b, -(a * from[0] + b * from[1])]
        };
        let [p, q, r] = [local(s[0]), local(s[1]), local(s[2])];
        let edges = [edge(q, r), edge(r, p), edge(p, q)];
        let twice_area = edges[0][2] + edges[1][2] + edges[2][2];
        if !(twice_area.abs() > 1e-12) {
            return;
        }
        let (columns, rows) = (x1 - x0, y1 - y0);
        // Each edge's opposite corner adds its 1/z in proportion to the distance from the edge.
        let inverse = 1.0 / twice_area;
        let share = |corner: OnScreen| f64::from(corner[2]) * inverse;
        let shares = [share(s[0]), share(s[1]), share(s[2])];
        let depth: [f32; 3] = std::array::from_fn(|k| {
            (edges[0][k] * shares[0] + edges[1][k] * shares[1] + edges[2][k] * shares[2]) as f32
        });
        let (flip, reach) = (twice_area.signum(), f64::from(columns.max(rows) + 1));
        let widened = |[a, b, c]: [f64; 3]| {
            let slack = 2e-7 * (c.abs() + (a.abs() + b.abs()) * reach);
            [(a * flip) as f32, (b * flip) as f32, (c * flip + slack) as f32]
        };
        let edges = [widened(edges[0]), widened(edges[1]), widened(edges[2])];
        let nearest = most(most(s[0][2], s[1][2]), s[2][2]);
        let farthest = least(least(s[0][2], s[1][2]), s[2][2]);
        let at_samples = |[a, b, c]: [f32; 3]| -> [f32; N] {
            std::array::from_fn(|i| a * Samples::OFFSETS[i][0] + b * Samples::OFFSETS[i][1] + c)
        };
        let e = [at_samples(edges[0]), at_samples(edges[1]), at_samples(edges[2])];
        let w = at_samples(depth);

        for row in 0..rows {
            let y = row as f32;
            let (mut first, mut last) = (0, columns);
            if columns > 4 {
                for (edge, at_samples) in edges.iter().zip(&e) {
                    // Where this edge's best sample is inside; one pixel wider against rounding.
                    let start = at_samples.iter().fold(f32::MIN, |m, v| most(m, *v)) + edge[1] * y;
                    if edge[0] > 0.0 {
                        first = first.max((-start / edge[0]) as i32 - 1);
                    } else if edge[0] < 0.0 {
                        last = last.min((start / -edge[0]).max(-2.0) as i32 + 2);
                    } else if start < 0.0 {
                        last = 0;
                    }
                }
                if first >= last {
                    continue;
                }
            }
            let start = (y0 - self.origin[1] + row) * self.size[0] + x0 - self.origin[0];
            let span = (start + first) as usize..(start + last) as usize;
            let pixels = self.depth[span.clone()].iter_mut().zip(&mut self.ids[span]);
            for ((depths, ids), column) in pixels.zip(first..) {
                let x = column as f32;
                let b0 = edges[0][0] * x + edges[0][1] * y;
                let b1 = edges[1][0] * x + edges[1][1] * y;
                let b2 = edges[2][0] * x + edges[2][1] * y;
                let base_w = depth[0] * x + depth[1] * y;
                // Plain loops over arrays without branches: these become vector instructions.
                let (mut pass, mut sample_w) = ([0u32; N], [0.0f32; N]);
                for i in 0..N {
                    let lowest = least(least(e[0][i] + b0, e[1][i] + b1), e[2][i] + b2);
                    sample_w[i] = most(least(w[i] + base_w, nearest), farthest);
                    let inside = (lowest >= 0.0) & (sample_w[i] > depths[i]);
                    pass[i] = u32::from(inside).wrapping_neg();
                }
                if pass.iter().fold(0, |any, p| any | p) == 0 {
                    continue;
                }
                for (pass, [dx, dy]) in pass.iter_mut().zip(Samples::OFFSETS) {
                    if *pass != 0 && !keep(ox + x + dx, oy + y + dy) {
                        *pass = 0;
                    }
                }
                for i in 0..N {
                    depths[i] =
                        f32::from_bits((sample_w[i].to_bits() & pass[i]) | (depths[i].to_bits() & !pass[i]));
                    ids[i] = (id & pass[i]) | (ids[i] & !pass[i]);
                }
            }
        }
    }

    /// First pixel and the one after the last whose samples can lie between two coordinates;
    /// `None` when no line of samples does.
    #[inline]
    fn covered(&self, axis: usize, low: f32, high: f32) -> Option<(i32, i32)> {
        const SLACK: f32 = 1e-3;
        let (start, size) = (self.origin[axis], self.size[axis]);
        let low = most(low - SLACK, start as f32);
        let high = least(high + SLACK, (start + size) as f32);
        if !(low <= high) {
            return None;
        }
        // Both are at least 0 and at most the image's side: casts round down.
        let lines = N as f32;
        let line = <Samples as Pattern<N>>::LINE;
        let first_line = (low * lines - line + 1.0) as i32;
        let after_line = (high * lines - line + 1.0) as i32;
        if first_line >= after_line {
            return None;
        }
        Some(((low as i32).min(start + size - 1), ((high as i32) + 1).min(start + size)))
    }
}

/// The lesser of two numbers in one instruction: `f32::min` spends three more on NaN.
#[inline]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater of two numbers.
#[inline]
fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
