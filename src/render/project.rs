//! From the world to the screen, distorted lenses and the near plane included.

use nalgebra::Vector2;

use crate::geometry::Pose;
use crate::imaging::Camera;

/// Metres in the camera frame (OpenCV axes).
pub(super) type InCamera = [f32; 3];
/// Pixels x and y, and 1/z in 1/m; a third entry of 0 or less is not in front of the near plane.
pub(super) type OnScreen = [f32; 3];

/// A bent edge may leave the straight line on the screen by this much before it is split.
const BEND_PX: f32 = 0.03;
/// Edges shorter than this are never split: they cannot bend noticeably.
const STRAIGHT_BELOW_PX: f32 = 3.0;
/// Splits one edge can go through; 2^10 pieces.
const MAX_SPLITS: u32 = 10;
/// Spacing of the grid of undistorted rays; between its nodes rays are interpolated, which is
/// right to a few thousandths of a pixel for real lenses.
const GRID_PX: f32 = 8.0;

/// One camera at one pose, in the numbers the rasteriser needs.
pub(super) struct View {
    camera: Camera,
    rotation: [[f32; 3]; 3],
    translation: [f32; 3],
    focal: [f32; 2],
    inverse_focal: [f32; 2],
    center: [f32; 2],
    near: f32,
    lens: Option<Lens>,
}

/// What a distorting lens needs in addition.
struct Lens {
    /// Undistorted x/z and y/z that the image can show: least x, greatest x, least y, greatest y.
    bounds: [f32; 4],
    columns: usize,
    /// Undistorted (x/z, y/z) at the grid's nodes.
    grid: Vec<[f32; 2]>,
}

impl View {
    pub(super) fn new(camera: &Camera, world_from_camera: &Pose, near_m: f64) -> Self {
        let camera_from_world = world_from_camera.inverse();
        let r = camera_from_world.rotation.to_rotation_matrix();
        let row = |i: usize| std::array::from_fn(|j| r[(i, j)] as f32);
        let t = camera_from_world.translation.vector;
        Self {
            camera: *camera,
            rotation: [row(0), row(1), row(2)],
            translation: [t.x as f32, t.y as f32, t.z as f32],
            focal: [camera.fx as f32, camera.fy as f32],
            inverse_focal: [(1.0 / camera.fx) as f32, (1.0 / camera.fy) as f32],
            center: [camera.cx as f32, camera.cy as f32],
            near: (near_m as f32).max(1e-6),
            lens: (!camera.distortion.is_none()).then(|| Lens::new(camera)),
        }
    }

    #[inline]
    pub(super) fn to_camera(&self, p: [f32; 3]) -> InCamera {
        let [a, b, c] = self.rotation;
        let dot = |r: [f32; 3], t: f32| r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t;
        [dot(a, self.translation[0]), dot(b, self.translation[1]), dot(c, self.translation[2])]
    }

    #[inline]
    pub(super) fn to_screen(&self, p: InCamera) -> OnScreen {
        if !(p[2] >= self.near) {
            return [0.0, 0.0, -1.0];
        }
        let w = 1.0 / p[2];
        if self.lens.is_some() {
            let d = self
                .camera
                .distortion
                .distort(Vector2::new(f64::from(p[0]), f64::from(p[1])) / f64::from(p[2]));
            let x = self.camera.fx * d.x + self.camera.cx;
            let y = self.camera.fy * d.y + self.camera.cy;
            return [x as f32, y as f32, w];
        }
        [p[0] * w * self.focal[0] + self.center[0], p[1] * w * self.focal[1] + self.center[1], w]
    }

    /// The ray through a pixel position, z = 1, camera frame.
    #[inline]
    pub(super) fn ray(&self, x: f32, y: f32) -> [f32; 3] {
        match &self.lens {
            None => [
                (x - self.center[0]) * self.inverse_focal[0],
                (y - self.center[1]) * self.inverse_focal[1],
                1.0,
            ],
            Some(lens) => lens.ray(x, y),
        }
    }

    /// 1/fx and 1/fy: how a ray changes from pixel to pixel.
    #[inline]
    pub(super) fn ray_step(&self) -> [f32; 2] {
        self.inverse_focal
    }

    /// Hands the triangle to `draw` as one or more triangles with straight edges on the
    /// screen. `screen` are the corners' projections as [`Self::to_screen`] gave them.
    #[inline]
    pub(super) fn straighten(
        &self,
        corners: [InCamera; 3],
        screen: [OnScreen; 3],
        mut draw: impl FnMut([OnScreen; 3]),
    ) {
        let seen = screen.map(|s| s[2] > 0.0);
        match &self.lens {
            None if seen == [true; 3] => draw(screen),
            None if seen == [false; 3] => {}
            None => self.clipped(corners, &[[0.0, 0.0, 1.0, -self.near]], |_, s| draw(s)),
            Some(lens) => {
                let [x0, x1, y0, y1] = lens.bounds;
                let planes = [
                    [0.0, 0.0, 1.0, -self.near],
                    [1.0, 0.0, -x0, 0.0],
                    [-1.0, 0.0, x1, 0.0],
                    [0.0, 1.0, -y0, 0.0],
                    [0.0, -1.0, y1, 0.0],
                ];
                if corners.iter().all(|c| planes.iter().all(|p| side(p, c) >= 0.0)) {
                    self.split(corners, screen, MAX_SPLITS, &mut draw);
                } else {
                    self.clipped(corners, &planes, |c, s| self.split(c, s, MAX_SPLITS, &mut draw));
                }
            }
        }
    }

    /// Cuts off what lies outside the planes (Sutherland and Hodgman) and fans the rest.
    fn clipped(
        &self,
        corners: [InCamera; 3],
        planes: &[[f32; 4]],
        mut draw: impl FnMut([InCamera; 3], [OnScreen; 3]),
    ) {
        // A triangle gains at most one corner a plane.
        let mut polygon = [[0.0f32; 3]; 8];
        let mut count = 3;
        polygon[..3].copy_from_slice(&corners);
        for plane in planes {
            let before = polygon;
            let mut kept = 0;
            for i in 0..count {
                let (a, b) = (before[i], before[(i + 1) % count]);
                let (da, db) = (side(plane, &a), side(plane, &b));
                let mut push = |p: InCamera| {
                    if kept < polygon.len() {
                        polygon[kept] = p;
                        kept += 1;
                    }
                };
                if da >= 0.0 {
                    push(a);
                }
                if (da >= 0.0) != (db >= 0.0) {
                    // Always from the inner to the outer end, so that neighbours cut a shared edge alike.
                    let (inner, outer, di, d_o) = if da >= 0.0 { (a, b, da, db) } else { (b, a, db, da) };
                    let t = di / (di - d_o);
                    push(std::array::from_fn(|k| inner[k] + (outer[k] - inner[k]) * t));
                }
            }
            count = kept;
            if count < 3 {
                return;
            }
        }
        for p in polygon.iter_mut().take(count) {
            // Rounding may leave a cut corner a hair before the near plane.
            p[2] = p[2].max(self.near);
        }
        for i in 1..count - 1 {
            let c = [polygon[0], polygon[i], polygon[i + 1]];
            draw(c, c.map(|p| self.to_screen(p)));
        }
    }

    /// Splits edges that the lens bends. An edge's fate depends on its two ends alone, so
    /// triangles that share it split it alike and no crack opens.
    fn split(&self, c: [InCamera; 3], s: [OnScreen; 3], depth: u32, draw: &mut impl FnMut([OnScreen; 3])) {
        let bent = |i: usize, j: usize| -> Option<(InCamera, OnScreen)> {
            let (dx, dy) = (s[j][0] - s[i][0], s[j][1] - s[i][1]);
            let length = (dx * dx + dy * dy).sqrt();
            if depth == 0 || !(length > STRAIGHT_BELOW_PX) {
                return None;
            }
            let middle: InCamera = std::array::from_fn(|k| 0.5 * (c[i][k] + c[j][k]));
            let m = self.to_screen(middle);
            let off = ((m[0] - s[i][0]) * dy - (m[1] - s[i][1]) * dx).abs();
            (off > BEND_PX * length).then_some((middle, m))
        };
        let mut go = |c: [InCamera; 3], s: [OnScreen; 3]| self.split(c, s, depth - 1, draw);
        match [bent(0, 1), bent(1, 2), bent(2, 0)] {
            [None, None, None] => draw(s),
            [Some((c01, s01)), Some((c12, s12)), Some((c20, s20))] => {
                go([c[0], c01, c20], [s[0], s01, s20]);
                go([c01, c[1], c12], [s01, s[1], s12]);
                go([c20, c12, c[2]], [s20, s12, s[2]]);
                go([c01, c12, c20], [s01, s12, s20]);
            }
            middles => {
                // One or two bent edges: turn the triangle so that edge 0-1 is bent and,
                // if two are, 1-2 is the other.
                let first = match middles {
                    [Some(_), Some(_), None] | [Some(_), None, None] => 0,
                    [None, Some(_), _] => 1,
                    _ => 2,
                };
                let at = |k: usize| (first + k) % 3;
                let (c, s) = ([c[at(0)], c[at(1)], c[at(2)]], [s[at(0)], s[at(1)], s[at(2)]]);
                let Some((c01, s01)) = middles[at(0)] else { return };
                match middles[at(1)] {
                    None => {
                        go([c[0], c01, c[2]], [s[0], s01, s[2]]);
                        go([c01, c[1], c[2]], [s01, s[1], s[2]]);
                    }
                    Some((c12, s12)) => {
                        go([c01, c[1], c12], [s01, s[1], s12]);
                        go([c[0], c01, c[2]], [s[0], s01, s[2]]);
                        go([c01, c12, c[2]], [s01, s12, s[2]]);
                    }
                }
            }
        }
    }
}

#[inline]
fn side(plane: &[f32; 4], p: &InCamera) -> f32 {
    plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]
}

impl Lens {
    fn new(camera: &Camera) -> Self {
        let (columns, rows) = (grid_nodes(camera.width), grid_nodes(camera.height));
        let mut grid = Vec::with_capacity(columns * rows);
        let mut bounds = [f32::MAX, f32::MIN, f32::MAX, f32::MIN];
        for row in 0..rows {
            for column in 0..columns {
                let pixel = Vector2::new(column as f64, row as f64) * f64::from(GRID_PX);
                let ray = camera.ray_in_camera(pixel);
                let (x, y) = (ray.x as f32, ray.y as f32);
                bounds = [bounds[0].min(x), bounds[1].max(x), bounds[2].min(y), bounds[3].max(y)];
                grid.push([x, y]);
            }
        }
        // The grid overlaps the image by up to one cell; a little more for what bends inwards.
        let (mx, my) = (0.02 * (bounds[1] - bounds[0]), 0.02 * (bounds[3] - bounds[2]));
        Self { bounds: [bounds[0] - mx, bounds[1] + mx, bounds[2] - my, bounds[3] + my], columns, grid }
    }

    fn ray(&self, x: f32, y: f32) -> [f32; 3] {
        let rows = self.grid.len() / self.columns;
        let (gx, gy) = ((x / GRID_PX).max(0.0), (y / GRID_PX).max(0.0));
        let (i, j) = ((gx as usize).min(self.columns - 2), (gy as usize).min(rows - 2));
        let (fx, fy) = (gx - i as f32, gy - j as f32);
        let at = |i: usize, j: usize| self.grid[j * self.columns + i];
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        let mix = |k: usize| {
            let top = a[k] + (b[k] - a[k]) * fx;
            let bottom = c[k] + (d[k] - c[k]) * fx;
            top + (bottom - top) * fy
        };
        [mix(0), mix(1), 1.0]
    }
}

/// Nodes along a side: at least two, the last at or beyond the image's edge.
fn grid_nodes(pixels: u32) -> usize {
    (pixels as f32 / GRID_PX).ceil() as usize + 1
}
