//! Camera intrinsics as one command-line value.

use std::str::FromStr;

use prv::imaging::{Camera, Distortion};

/// `d435`, or `fx,fy,cx,cy[,k1,k2,p1,p2,k3]` for images of whatever size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraFlag(Intrinsics);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Intrinsics {
    Known(Camera),
    OfImage { fx: f64, fy: f64, cx: f64, cy: f64, distortion: Distortion },
}

impl CameraFlag {
    /// The camera, for images of `width` x `height` pixels where the flag leaves the size open.
    pub fn for_size(&self, width: u32, height: u32) -> Camera {
        match self.0 {
            Intrinsics::Known(camera) => camera,
            Intrinsics::OfImage { fx, fy, cx, cy, distortion } => {
                Camera { width, height, fx, fy, cx, cy, distortion }
            }
        }
    }
}

impl FromStr for CameraFlag {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "d435" {
            return Ok(Self(Intrinsics::Known(Camera::REALSENSE_D435)));
        }
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        let (fx, fy, cx, cy, distortion) = match numbers.as_deref() {
            Ok([fx, fy, cx, cy]) => (*fx, *fy, *cx, *cy, Distortion::default()),
            Ok([fx, fy, cx, cy, k1, k2, p1, p2, k3]) => {
                (*fx, *fy, *cx, *cy, Distortion { k1: *k1, k2: *k2, p1: *p1, p2: *p2, k3: *k3 })
            }
            _ => return Err(format!("{text:?} is no camera, must be d435 or fx,fy,cx,cy[,k1,k2,p1,p2,k3]")),
        };
        let flag = Self(Intrinsics::OfImage { fx, fy, cx, cy, distortion });
        flag.for_size(1, 1).check().map_err(|error| error.to_string())?;
        Ok(flag)
    }
}
