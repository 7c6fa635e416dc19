//! Which cells can hold anything at all, judged by the silhouettes alone.

use nalgebra::Isometry3;

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
    let corners = (0..CELLS).step_by(LARGEST_BLOCK);
    for z in corners.clone() {
        for y in corners.clone() {
            for x in corners.clone() {
                keep_block(&views, bounds, [x, y, z], LARGEST_BLOCK, &mut hull);
            }
        }
    }
    hull
}

/// Sets the cells of the block of `edge` cells at `corner` that no view rules out.
fn keep_block(views: &[Silhouette], bounds: &Bounds, corner: [usize; 3], edge: usize, hull: &mut [bool]) {
    let cell_m = 2.0 * bounds.half_extent_m / CELLS as f64;
    let middle = corner.map(|c| (c as f64 + 0.5 * edge as f64) * cell_m - bounds.half_extent_m);
    let center = bounds.center + nalgebra::Vector3::from(middle);
    let radius_m = 0.5 * 3.0f64.sqrt() * edge as f64 * cell_m;
    if views.iter().any(|view| view.rules_out(&center, radius_m)) {
        return;
    }
    if edge == 1 {
        let [x, y, z] = corner;
        if let Some(cell) = hull.get_mut((z * CELLS + y) * CELLS + x) {
            *cell = true;
        }
        return;
    }
    let half = edge / 2;
    for child in 0..8 {
        let at = std::array::from_fn(|a| corner[a] + if child >> a & 1 == 1 { half } else { 0 });
        keep_block(views, bounds, at, half, hull);
    }
}

/// A view's camera, and how far each of its pixels is from the object.
struct Silhouette {
    camera: Camera,
    camera_from_world: Isometry3<f64>,
    /// Chebyshev distance in pixels to the nearest one that is not fully transparent, row by row.
    distance_px: Vec<u16>,
}

impl Silhouette {
    fn new(view: &PosedImage) -> Silhouette {
        let (width, height) = view.image.dimensions();
        let mut distance_px: Vec<u16> =
            view.image.pixels().map(|p| if p.0[3] > 0 { 0 } else { u16::MAX }).collect();
        spread_distances(&mut distance_px, width as usize, height as usize);
        Silhouette { camera: view.camera, camera_from_world: view.world_from_camera.inverse(), distance_px }
    }

    /// Whether the ball shows only background here.
    fn rules_out(&self, center_in_world: &Point, radius_m: f64) -> bool {
        let c = self.camera_from_world * center_in_world;
        let distance = c.coords.norm();
        if c.z <= radius_m || distance <= radius_m {
            return false;
        }
        let (x, y) = (c.x / c.z, c.y / c.z);
        // The ball's cone has the half-angle asin(r / d); seen at tan(angle) = rho off the
        // axis it reaches farthest outwards, to tan(angle + half-angle).
        let rho = x.hypot(y);
        let tan_half = radius_m / (distance * distance - radius_m * radius_m).sqrt();
        if rho * tan_half >= 1.0 {
            return false;
        }
        let reach = tan_half * (1.0 + rho * rho) / (1.0 - rho * tan_half);
        let reach_px = reach * self.camera.fx.max(self.camera.fy) + MARGIN_PX;
        let (u, v) = (self.camera.fx * x + self.camera.cx, self.camera.fy * y + self.camera.cy);
        let (width, height) = (f64::from(self.camera.width), f64::from(self.camera.height));
        let whole = u >= reach_px && v >= reach_px && u + reach_px <= width && v + reach_px <= height;
        if !whole {
            return false;
        }
        let pixel = v as usize * self.camera.width as usize + u as usize;
        // A pixel at distance n is at least n - 1 widths away from any point of this one.
        self.distance_px.get(pixel).is_some_and(|&n| f64::from(n) - 1.0 > reach_px)
    }
}

/// Chebyshev distances to the zeros, in two passes over the eight neighbours, which is exact for this metric.
fn spread_distances(distance: &mut [u16], width: usize, height: usize) {
    let mut take = |at: usize, from: usize| {
        if let (Some(&d), Some(to)) = (distance.get(from), distance.get(at).copied()) {
            distance[at] = to.min(d.saturating_add(1));
        }
    };
    for y in 0..height {
        for x in 0..width {
            let at = y * width + x;
            if x > 0 {
                take(at, at - 1);
            }
            if y > 0 {
                let above = at - width;
                take(at, above);
                if x > 0 {
                    take(at, above - 1);
                }
                if x + 1 < width {
                    take(at, above + 1);
                }
            }
        }
    }
    for y in (0..height).rev() {
        for x in (0..width).rev() {
            let at = y * width + x;
            if x + 1 < width {
                take(at, at + 1);
            }
            if y + 1 < height {
                let below = at + width;
                take(at, below);
                if x > 0 {
                    take(at, below - 1);
                }
                if x + 1 < width {
                    take(at, below + 1);
                }
            }
        }
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
        fn distances_are_chebyshev(solid in prop::collection::vec((0..17usize, 0..9usize), 1..6)) {
            let (width, height) = (17, 9);
            let mut distance = vec![u16::MAX; width * height];
            for &(x, y) in &solid {
                distance[y * width + x] = 0;
            }
            spread_distances(&mut distance, width, height);
            for y in 0..height {
                for x in 0..width {
                    let nearest = solid.iter().map(|&(a, b)| x.abs_diff(a).max(y.abs_diff(b))).min();
                    prop_assert_eq!(Some(usize::from(distance[y * width + x])), nearest);
                }
            }
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
