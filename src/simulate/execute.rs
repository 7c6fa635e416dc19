//! The run itself.

use std::time::Duration;

use image::RgbaImage;

use super::pace::Pace;
use super::{Carrier, SimulateError};
use crate::geometry::Pose;

/// Longest time between two looks at the observer: a cancelled run stops within it.
const TICK: Duration = Duration::from_millis(50);

/// A camera in front of an object.
pub trait Photograph {
    /// The image from `base_from_camera`, straight alpha.
    fn photograph(&self, base_from_camera: &Pose) -> RgbaImage;
}

/// A photo that was taken.
pub struct Photo<'a> {
    /// Id of the view.
    pub view: usize,
    /// The image.
    pub image: &'a RgbaImage,
    /// Where the camera really stood.
    pub base_from_camera: Pose,
    /// When, simulated seconds since the start.
    pub time_s: f64,
}

/// Who watches a run and may stop it.
pub trait Observer {
    /// Called about twenty times a second; `joints_rad` is `None` without an arm.
    fn moved(&mut self, time_s: f64, joints_rad: Option<&[f64]>);
    /// Takes a photo.
    ///
    /// # Errors
    /// An error ends the run.
    fn took(&mut self, photo: Photo<'_>) -> Result<(), SimulateError>;
    /// True once the run is to stop.
    fn cancelled(&self) -> bool;
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Every photo was taken.
    Done,
    /// The observer stopped it.
    Cancelled,
}

/// What to run.
pub struct Run<'a> {
    /// What carries the camera.
    pub carrier: &'a Carrier,
    /// The camera and the object.
    pub camera: &'a dyn Photograph,
    /// Simulated seconds a second.
    pub speed_factor: f64,
}

/// Carries out a run on the calling thread.
///
/// # Errors
/// A speed factor out of range, nothing to photograph, or the observer's error.
pub fn execute(run: &Run<'_>, observer: &mut dyn Observer) -> Result<End, SimulateError> {
    let mut pace = Pace::start(run.speed_factor)?;
    let shots = run.carrier.shots();
    if shots.is_empty() {
        return Err(SimulateError::NoViews);
    }
    for shot in &shots {
        if wait_until(shot.time_s, &pace, run.carrier, observer) == End::Cancelled {
            return Ok(End::Cancelled);
        }
        let joints = run.carrier.joints_at(shot.time_s);
        observer.moved(shot.time_s, joints.as_deref());
        let base_from_camera = run.carrier.camera_at(shot.time_s);
        let image = run.camera.photograph(&base_from_camera);
        let photo = Photo { view: shot.view, image: &image, base_from_camera, time_s: shot.time_s };
        observer.took(photo)?;
        pace.resume_at(shot.time_s);
    }
    let end_s = run.carrier.duration_s();
    if wait_until(end_s, &pace, run.carrier, observer) == End::Cancelled {
        return Ok(End::Cancelled);
    }
    observer.moved(end_s, run.carrier.joints_at(end_s).as_deref());
    Ok(End::Done)
}

/// Follows the motion up to `time_s`.
fn wait_until(time_s: f64, pace: &Pace, carrier: &Carrier, observer: &mut dyn Observer) -> End {
    loop {
        if observer.cancelled() {
            return End::Cancelled;
        }
        let pause = pace.until(time_s, TICK);
        if pause.is_zero() {
            return End::Done;
        }
        std::thread::sleep(pause);
        let now_s = pace.now_s().min(time_s);
        observer.moved(now_s, carrier.joints_at(now_s).as_deref());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, look_at};
    use crate::order::Obstacle;
    use crate::simulate::Flight;

    struct Grey;

    impl Photograph for Grey {
        fn photograph(&self, _: &Pose) -> RgbaImage {
            RgbaImage::new(2, 2)
        }
    }

    #[derive(Default)]
    struct Watcher {
        views: Vec<usize>,
        poses: Vec<Pose>,
        last_s: f64,
        stop_after: Option<usize>,
    }

    impl Observer for Watcher {
        fn moved(&mut self, time_s: f64, _: Option<&[f64]>) {
            assert!(time_s >= self.last_s);
            self.last_s = time_s;
        }

        fn took(&mut self, photo: Photo<'_>) -> Result<(), SimulateError> {
            self.views.push(photo.view);
            self.poses.push(photo.base_from_camera);
            Ok(())
        }

        fn cancelled(&self) -> bool {
            self.stop_after.is_some_and(|count| self.views.len() >= count)
        }
    }

    fn flight() -> (Carrier, Vec<(usize, Pose)>) {
        let eyes = [(2, 0.3, 0.0), (0, 0.0, 0.3), (5, -0.3, 0.0)];
        let views: Vec<(usize, Pose)> = eyes
            .iter()
            .map(|(id, x, y)| (*id, look_at(&Point::new(*x, *y, 0.2), &Point::origin(), 0.0)))
            .collect();
        (Carrier::Free(Flight::through(&views, &Obstacle::none())), views)
    }

    #[test]
    fn every_view_is_photographed_from_its_pose_in_order() {
        let (carrier, views) = flight();
        let run = Run { carrier: &carrier, camera: &Grey, speed_factor: MAX };
        let mut watcher = Watcher::default();
        assert_eq!(execute(&run, &mut watcher).unwrap(), End::Done);
        assert_eq!(watcher.views, [2, 0, 5]);
        assert!(watcher.poses.iter().zip(&views).all(|(taken, (_, planned))| taken == planned));
        assert!((watcher.last_s - carrier.duration_s()).abs() < 1e-12);
    }

    const MAX: f64 = crate::simulate::MAX_SPEED_FACTOR;

    #[test]
    fn a_cancelled_run_takes_no_further_photo() {
        let (carrier, _) = flight();
        let run = Run { carrier: &carrier, camera: &Grey, speed_factor: MAX };
        let mut watcher = Watcher { stop_after: Some(1), ..Watcher::default() };
        assert_eq!(execute(&run, &mut watcher).unwrap(), End::Cancelled);
        assert_eq!(watcher.views, [2]);
    }

    #[test]
    fn a_speed_factor_that_is_no_pace_is_refused() {
        let (carrier, _) = flight();
        for speed_factor in [f64::NAN, 0.0, -1.0, 1e9] {
            let run = Run { carrier: &carrier, camera: &Grey, speed_factor };
            assert!(matches!(execute(&run, &mut Watcher::default()), Err(SimulateError::SpeedFactor { .. })));
        }
    }
}
