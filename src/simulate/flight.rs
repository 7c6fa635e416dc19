//! A camera that flies without an arm.

use crate::geometry::{Point, Pose};
use crate::order::{LocalPath, Obstacle};

/// Speed of the free camera, m/s: about that of an arm at work.
pub const FLIGHT_SPEED_M_PER_S: f64 = 0.25;
/// Rest before each photo, seconds.
pub const FLIGHT_SETTLE_S: f64 = 0.3;

/// Stops of a camera that flies around the object at constant speed.
#[derive(Clone, Debug)]
pub struct Flight {
    stops: Vec<Stop>,
}

#[derive(Clone, Debug)]
struct Stop {
    view: usize,
    base_from_camera: Pose,
    /// When the photo is taken.
    time_s: f64,
}

impl Flight {
    /// The flight through `views` (id and pose) in this order, around `obstacle`.
    pub fn through(views: &[(usize, Pose)], obstacle: &Obstacle) -> Self {
        let mut stops: Vec<Stop> = Vec::with_capacity(views.len());
        for (view, pose) in views {
            let time_s = match stops.last() {
                None => FLIGHT_SETTLE_S,
                Some(last) => {
                    let from = Point::from(last.base_from_camera.translation.vector);
                    let to = Point::from(pose.translation.vector);
                    let length_m = LocalPath::between(from, to, obstacle).length_m();
                    last.time_s + length_m / FLIGHT_SPEED_M_PER_S + FLIGHT_SETTLE_S
                }
            };
            stops.push(Stop { view: *view, base_from_camera: *pose, time_s });
        }
        Self { stops }
    }

    /// Views and the times of their photos, seconds.
    pub(super) fn shots(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.stops.iter().map(|stop| (stop.view, stop.time_s))
    }

    /// The pose of the next stop at or after `time_s`; that of the last one afterwards.
    pub(super) fn pose_at(&self, time_s: f64) -> Option<Pose> {
        let next = self.stops.iter().find(|stop| stop.time_s >= time_s - 1e-9).or(self.stops.last());
        next.map(|stop| stop.base_from_camera)
    }
}
