//! Triangles of a flat outline, by cutting ears.

use super::outline::doubled_area;

/// Indices of triangles that fill a simple anticlockwise outline. Where the outline crosses itself the rest
/// is filled by a fan, so that the edges still meet.
pub(super) fn ear_clip(outline: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let mut triangles = Vec::with_capacity(outline.len());
    while left.len() > 3 {
        let n = left.len();
        let best = (0..n)
            .filter(|i| is_ear(outline, &left, *i))
            // The widest ear first keeps slivers few.
            .max_by(|a, b| quality(outline, &left, *a).total_cmp(&quality(outline, &left, *b)))
            .unwrap_or(0);
        triangles.push([left[(best + n - 1) % n], left[best], left[(best + 1) % n]]);
        left.remove(best);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

fn corners(outline: &[[f64; 2]], left: &[usize], i: usize) -> [[f64; 2]; 3] {
    let n = left.len();
    [outline[left[(i + n - 1) % n]], outline[left[i]], outline[left[(i + 1) % n]]]
}

fn is_ear(outline: &[[f64; 2]], left: &[usize], i: usize) -> bool {
    let [a, b, c] = corners(outline, left, i);
    doubled_area(&[a, b, c]) > 1e-14
        && left.iter().all(|k| {
            let p = outline[*k];
            // A bridge to a hole has corners twice: those at an ear's own corners do not block it.
            p == a
                || p == b
                || p == c
                || doubled_area(&[a, b, p]) < 0.0
                || doubled_area(&[b, c, p]) < 0.0
                || doubled_area(&[c, a, p]) < 0.0
        })
}

/// Twice the area over the squared longest side.
fn quality(outline: &[[f64; 2]], left: &[usize], i: usize) -> f64 {
    let [a, b, c] = corners(outline, left, i);
    let squared = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    doubled_area(&[a, b, c]) / squared(a, b).max(squared(b, c)).max(squared(c, a)).max(1e-18)
}

#[cfg(test)]
mod tests {
    use super::super::outline::star;
    use super::*;

    #[test]
    fn the_triangles_of_a_star_have_its_area_and_all_turn_its_way() {
        let outline = star(1.0, 0.4, 7);
        let areas: Vec<f64> =
            ear_clip(&outline).iter().map(|t| doubled_area(&t.map(|i| outline[i]))).collect();
        assert_eq!(areas.len(), 12);
        assert!(areas.iter().all(|a| *a > 0.0));
        assert!((areas.iter().sum::<f64>() - doubled_area(&outline)).abs() < 1e-12);
    }
}
