//! The simulated camera of labels: photos of an object about the origin.

use image::RgbaImage;

use super::protocol::{VIEW_RADIUS_M, label_camera};
use crate::geometry::{Direction, Point, Pose};
use crate::imaging::{Camera, PosedImage};
use crate::render::{RenderSettings, Renderer};
use crate::views::{Band, ViewSpace};

/// Takes label photos (protocol's camera and distance) of one object.
pub(crate) struct Photographer {
    renderer: Renderer,
    render: RenderSettings,
    camera: Camera,
}

impl Photographer {
    /// Of what `renderer` draws, which is centred on the origin.
    pub fn new(renderer: Renderer) -> Photographer {
        Photographer { renderer, render: RenderSettings::default(), camera: label_camera() }
    }

    /// One photo from each direction, horizon level.
    pub fn take(&self, directions: &[Direction]) -> Vec<PosedImage> {
        directions
            .iter()
            .map(|direction| {
                let world_from_camera = pose(direction);
                let image = self.renderer.render(&self.camera, &world_from_camera, &self.render);
                PosedImage { image, camera: self.camera, world_from_camera }
            })
            .collect()
    }
}

/// The label camera's pose in this direction from the origin.
pub(crate) fn pose(direction: &Direction) -> Pose {
    let space = ViewSpace { center_in_base: Point::origin(), radius_m: VIEW_RADIUS_M, band: Band::DEFAULT };
    space.pose(direction, 0.0)
}

/// Every second pixel of every second row of a test view, and the camera that sees just those
/// pixels. PSNR is a mean over pixels, so a quarter of them, spread evenly, estimates it at a
/// quarter of the cost; which quarter goes round with `index`.
pub(super) fn lattice(view: &PosedImage, index: usize) -> PosedImage {
    let (shift_x, shift_y) = ((index % 2) as u32, (index / 2 % 2) as u32);
    let full = view.camera;
    let (width, height) = (full.width / 2, full.height / 2);
    let halved = |center: f64, shift: u32| (center - f64::from(shift) - 0.5) / 2.0 + 0.5;
    let camera = Camera {
        width,
        height,
        fx: full.fx / 2.0,
        fy: full.fy / 2.0,
        cx: halved(full.cx, shift_x),
        cy: halved(full.cy, shift_y),
        ..full
    };
    let image =
        RgbaImage::from_fn(width, height, |x, y| *view.image.get_pixel(2 * x + shift_x, 2 * y + shift_y));
    PosedImage { image, camera, world_from_camera: view.world_from_camera }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_camera_sees_the_pixels_it_was_given() {
        let camera = label_camera();
        let image =
            RgbaImage::from_fn(camera.width, camera.height, |x, y| image::Rgba([x as u8, y as u8, 0, 255]));
        let view = PosedImage { image, camera, world_from_camera: Pose::identity() };
        for index in 0..4 {
            let half = lattice(&view, index);
            for (x, y) in [(0, 0), (17, 40), (63, 63)] {
                let [full_x, full_y, ..] = half.image.get_pixel(x, y).0;
                let center = |p: u32| f64::from(p) + 0.5;
                let seen = half.camera.ray_in_camera([center(x), center(y)].into());
                let meant = camera.ray_in_camera([center(full_x.into()), center(full_y.into())].into());
                assert!((seen - meant).norm() < 1e-12, "{index}: {seen} {meant}");
            }
        }
    }
}
