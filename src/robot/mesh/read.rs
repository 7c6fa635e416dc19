//! The corner points of STL (binary or text) and OBJ files.

use crate::geometry::Point;

/// Most corners of one mesh.
const MOST_POINTS: usize = 3_000_000;

/// Bytes before the facets of a binary STL: a comment and their number.
const BINARY_HEADER: usize = 84;

/// Bytes of a binary STL's facet: normal, three corners, attributes.
const FACET: usize = 50;

/// The corners in the file's own unit, or what is wrong with it.
pub fn points(bytes: &[u8]) -> Result<Vec<Point>, String> {
    let points = match binary_stl(bytes) {
        Some(points) => points,
        None => text(bytes)?,
    };
    if points.is_empty() {
        return Err("no corner found; STL and OBJ files are read".to_owned());
    }
    if points.len() > MOST_POINTS {
        return Err(format!("{} corners, at most {MOST_POINTS} are read", points.len()));
    }
    match points.iter().find(|p| !p.iter().all(|v| v.is_finite())) {
        Some(point) => Err(format!("a corner is at {point}")),
        None => Ok(points),
    }
}

/// The corners of a binary STL; `None` if the length does not fit the number of facets.
fn binary_stl(bytes: &[u8]) -> Option<Vec<Point>> {
    let count = bytes.get(80..BINARY_HEADER)?;
    let count = u32::from_le_bytes(count.try_into().ok()?) as usize;
    let facets = bytes.get(BINARY_HEADER..)?;
    if count == 0 || count.checked_mul(FACET)? != facets.len() {
        return None;
    }
    let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, |b| f64::from(f32::from_le_bytes(b)));
    let corner = |bytes: &[u8]| {
        let mut numbers = bytes.chunks_exact(4).map(number);
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        Point::new(next(), next(), next())
    };
    let corners = |facet: &[u8]| facet.get(12..48).unwrap_or_default().chunks_exact(12).map(corner).collect();
    Some(facets.chunks_exact(FACET).flat_map(|facet| -> Vec<Point> { corners(facet) }).collect())
}

/// The corners of a text STL (`vertex x y z`) or of an OBJ file (`v x y z`).
fn text(bytes: &[u8]) -> Result<Vec<Point>, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "neither text nor a whole binary STL".to_owned())?;
    let mut points = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        if !matches!(words.next(), Some("v" | "vertex")) {
            continue;
        }
        let mut next = || words.next().and_then(|word| word.parse::<f64>().ok());
        let (Some(x), Some(y), Some(z)) = (next(), next(), next()) else {
            return Err(format!("line {} is no corner of three numbers", number + 1));
        };
        points.push(Point::new(x, y, z));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn binary(corners: &[[f32; 3]]) -> Vec<u8> {
        let mut bytes = vec![0; 80];
        bytes.extend(((corners.len() / 3) as u32).to_le_bytes());
        for facet in corners.chunks_exact(3) {
            bytes.extend([0; 12]);
            facet.iter().flatten().for_each(|v| bytes.extend(v.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    #[test]
    fn the_three_formats_give_the_same_corners() {
        let stl =
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 2 1\nendloop\n";
        let obj = b"# a\nv 0 0 1\nv 1 0 1\nv 0 2 1\nvn 0 0 1\nf 1 2 3\n";
        let bytes = binary(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 2.0, 1.0]]);
        let expected = [Point::new(0.0, 0.0, 1.0), Point::new(1.0, 0.0, 1.0), Point::new(0.0, 2.0, 1.0)];
        for file in [stl.as_slice(), obj, &bytes] {
            assert_eq!(points(file).unwrap(), expected);
        }
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        for file in
            [b"".as_slice(), b"hello", b"<COLLADA/>", b"v 1 2", b"v 1 2 nan", b"v 1 2 inf", &[255; 200]]
        {
            assert!(points(file).is_err());
        }
        assert!(points(&binary(&[[f32::NAN, 0.0, 0.0]; 3])).is_err());
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
            let _ = points(&bytes);
        }
    }
}
