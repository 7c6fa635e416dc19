//! Which cells can hold anything at all, judged by the silhouettes alone.

use std::ops::Range;

use image::RgbaImage;
use nalgebra::Matrix3x4;

use super::Bounds;
use super::distance_map::CELLS;
use crate::geometry::Point;
use crate::imaging::{Camera, PosedImage};

/// Pixels that the object may reach beyond its drawn silhouette: parts thinner than a
/// pixel can fall between the samples that its coverage is made of.
const MARGIN_PX: f64 = 1.0;
/// Cells along an edge of the first, largest blocks.
const LARGEST_BLOCK: usize = 8;

/// One flag a cell of the cube `bounds`, x fastest: false where some view sees nothing but
/// background (alpha 0) wherever the cell appears in it. What is true is the visual hull
/// (Laurentini 1994), a cell or so too large. Views with a distorting lens, and cells
/// that a view does not see whole, are left out of the judgement.
pub(super) fn visual_hull(views: &[PosedImage], bounds: &Bounds) -> Vec<bool> {
    let views: Vec<Silhouette> =
        views.iter().filter(|v| v.camera.distortion.is_none()).map(Silhouette::new).collect();
    let mut hull = vec![false; CELLS * CELLS * CELLS];
    let all: Vec<&Silhouette> = views.iter().collect();
    let corners = (0..CELLS).step_by(LARGEST_BLOCK);
    for z in corners.clone() {
        for y in corners.clone() {
            for x in corners.clone() {
                keep_block(&all, bounds, [x, y, z], LARGEST_BLOCK, &mut hull);
            }
        }
    }
    hull
}

/// Sets the cells of the block of `edge` cells at `corner` that no view rules out.
fn keep_block(views: &[&Silhouette], bounds: &Bounds, corner: [usize; 3], edge: usize, hull: &mut [bool]) {
    let cell_m = 2.0 * bounds.half_extent_m / CELLS as f64;
    let middle = corner.map(|c| (c as f64 + 0.5 * edge as f64) * cell_m - bounds.half_extent_m);
    let center = bounds.center + nalgebra::Vector3::from(middle);
    let radius_m = 0.5 * 3.0f64.sqrt() * edge as f64 * cell_m;
    // Views that show nothing but the object here have no more to say of its parts.
    let mut undecided = Vec::with_capacity(views.len());
    for &view in views {
        match view.shows(&center, radius_m) {
            Shown::Background => return,
            Shown::Object => {}
            Shown::Either => undecided.push(view),
        }
    }
    if edge == 1 || undecided.is_empty() {
        for z in corner[2]..corner[2] + edge {
            for y in corner[1]..corner[1] + edge {
                let row = (z * CELLS + y) * CELLS + corner[0];
                hull[row..row + edge].fill(true);
            }
        }
        return;
    }
    let half = edge / 2;
    for child in 0..8 {
        let at = std::array::from_fn(|a| corner[a] + if child >> a & 1 == 1 { half } else { 0 });
        keep_block(&undecided, bounds, at, half, hull);
    }
}

/// What a view shows where a ball is.
enum Shown {
    Background,
    Object,
    /// Both, or the view does not show the ball whole.
    Either,
}

/// A view's camera, and where it shows the object.
struct Silhouette {
    camera: Camera,
    camera_from_world: Matrix3x4<f64>,
    covered: CoveredPixels,
}

impl Silhouette {
    fn new(view: &PosedImage) -> Silhouette {
        let camera_from_world = view.world_from_camera.inverse().to_homogeneous();
        Silhouette {
            camera: view.camera,
            camera_from_world: camera_from_world.fixed_rows::<3>(0).into_owned(),
            covered: CoveredPixels::new(&view.image),
        }
    }

    fn shows(&self, center_in_world: &Point, radius_m: f64) -> Shown {
        let c = self.camera_from_world * center_in_world.to_homogeneous();
        let distance = c.norm();
        if c.z <= radius_m || distance <= radius_m {
            return Shown::Either;
        }
        let (x, y) = (c.x / c.z, c.y / c.z);
        // The ball's cone has the half-angle asin(r / d); seen at tan(angle) = rho off the
        // axis it reaches farthest outwards, to tan(angle + half-angle).
        let rho = x.hypot(y);
        let tan_half = radius_m / (distance * distance - radius_m * radius_m).sqrt();
        if rho * tan_half >= 1.0 {
            return Shown::Either;
        }
        let reach = tan_half * (1.0 + rho * rho) / (1.0 - rho * tan_half);
        let reach_px = reach * self.camera.fx.max(self.camera.fy) + MARGIN_PX;
        let (u, v) = (self.camera.fx * x + self.camera.cx, self.camera.fy * y + self.camera.cy);
        let (width, height) = (f64::from(self.camera.width), f64::from(self.camera.height));
        let whole = u >= reach_px && v >= reach_px && u + reach_px <= width && v + reach_px <= height;
        if !whole {
            return Shown::Either;
        }
        // A pixel `n` away has points that are less than `n` widths from this one.
        let range = |x: f64, end: u32| {
            let (pixel, away) = (x as usize, reach_px as usize + 1);
            pixel.saturating_sub(away)..(pixel + away + 1).min(end as usize)
        };
        let (columns, rows) = (range(u, self.camera.width), range(v, self.camera.height));
        match self.covered.count(&columns, &rows) as usize {
            0 => Shown::Background,
            all if all == columns.len() * rows.len() => Shown::Object,
            _ => Shown::Either,
        }
    }
}

/// How many pixels of a rectangle are not fully transparent, by a summed-area table (Crow 1984).
struct CoveredPixels {
    /// One more than the image's width.
    stride: usize,
    /// Such pixels above and left of each corner of pixels, row by row.
    sums: Vec<u32>,
}

impl CoveredPixels {
    fn new(image: &RgbaImage) -> CoveredPixels {
        let stride = image.width() as usize + 1;
        let mut sums = vec![0; stride * (image.height() as usize + 1)];
        for (y, row) in image.as_raw().chunks_exact(4 * image.width() as usize).enumerate() {
            let (above, here) = sums[y * stride..].split_at_mut(stride);
            let mut sum = 0;
            for ((pixel, above), here) in row.chunks_exact(4).zip(&above[1..]).zip(&mut here[1..]) {
                sum += u32::from(pixel[3] > 0);
                *here = above + sum;
            }
        }
        CoveredPixels { stride, sums }
    }

    /// The ranges must lie in the image.
    fn count(&self, columns: &Range<usize>, rows: &Range<usize>) -> u32 {
        let at = |x: usize, y: usize| self.sums[y * self.stride + x];
        at(columns.end, rows.end) + at(columns.start, rows.start)
            - at(columns.start, rows.end)
            - at(columns.end, rows.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose, look_at};
    use image::{Rgba, RgbaImage};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn covered_pixels_are_counted_in_every_rectangle(
            solid in prop::collection::btree_set((0..17u32, 0..9u32), 0..40),
            x in (0..18usize, 0..18usize), y in (0..10usize, 0..10usize),
        ) {
            let mut image = RgbaImage::new(17, 9);
            for &(x, y) in &solid {
                image.put_pixel(x, y, Rgba([0, 0, 0, 1]));
            }
            let (columns, rows) = (x.0.min(x.1)..x.0.max(x.1), y.0.min(y.1)..y.0.max(y.1));
            let inside = |p: &&(u32, u32)| columns.contains(&(p.0 as usize)) && rows.contains(&(p.1 as usize));
            let expected = solid.iter().filter(inside).count();
            prop_assert_eq!(CoveredPixels::new(&image).count(&columns, &rows) as usize, expected);
        }
    }

    /// Views around a ball of 4 cm at (0.03, 0, 0), its silhouette drawn pixel by pixel.
    fn views_of_a_ball(count: usize) -> Vec<PosedImage> {
        let camera = Camera::square(96, 0.5);
        let ball = Point::new(0.03, 0.0, 0.0);
        (0..count)
            .map(|i| {
                let angle = i as f64 * 2.4;
                let eye = Point::new(0.3 * angle.cos(), 0.3 * angle.sin(), 0.1 + 0.01 * i as f64);
                let world_from_camera: Pose = look_at(&eye, &Point::origin(), 0.0);
                let image = RgbaImage::from_fn(96, 96, |x, y| {
                    let ray = camera.ray_in_camera([f64::from(x) + 0.5, f64::from(y) + 0.5].into());
                    let ray = (world_from_camera.rotation * ray).normalize();
                    let to_ball = ball - eye;
                    let off = (to_ball - ray * to_ball.dot(&ray)).norm();
                    Rgba([90, 90, 90, if off < 0.02 { 255 } else { 0 }])
                });
                PosedImage { image, camera, world_from_camera }
            })
            .collect()
    }

    #[test]
    fn the_hull_of_a_ball_holds_it_and_little_more() {
        let bounds = Bounds { center: Point::origin(), half_extent_m: 0.1 };
        let hull = visual_hull(&views_of_a_ball(12), &bounds);
        let (mut inside, mut kept) = (0, 0);
        for (cell, &keeps) in hull.iter().enumerate() {
            let corner = [cell % CELLS, cell / CELLS % CELLS, cell / (CELLS * CELLS)];
            let at = Point::from(corner.map(|c| (c as f64 + 0.5) / CELLS as f64 * 0.2 - 0.1));
            let holds = (at - Point::new(0.03, 0.0, 0.0)).norm() < 0.02;
            assert!(keeps || !holds, "{at}");
            inside += usize::from(holds);
            kept += usize::from(keeps);
        }
        assert!(inside > 0 && kept < 8 * inside, "{kept} {inside}");
    }

    #[test]
    fn what_no_view_sees_whole_is_kept() {
        let mut views = views_of_a_ball(3);
        for view in &mut views {
            view.image.pixels_mut().for_each(|p| p.0[3] = 0);
        }
        let bounds = Bounds { center: Point::origin(), half_extent_m: 2.0 };
        let hull = visual_hull(&views, &bounds);
        assert!(hull[0] && hull[CELLS * CELLS * CELLS - 1], "corners are out of every frame");
        assert!(!hull[(32 * CELLS + 32) * CELLS + 32], "the middle is empty in every view");
    }
}
