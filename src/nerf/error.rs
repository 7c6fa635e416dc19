//! Why a NeRF cannot be trained.

use crate::imaging::CameraError;

/// Why a NeRF cannot be trained. Views are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NerfError {
    /// There is nothing to learn from.
    #[error("there are no views to train on")]
    NoViews,
    /// A camera's numbers cannot be used.
    #[error("view {view}")]
    Camera {
        /// The view's index.
        view: usize,
        /// What is wrong.
        #[source]
        source: CameraError,
    },
    /// An image is not as large as its camera says.
    #[error("view {view}: the image is {image:?} pixels, its camera says {camera:?}")]
    ImageSize {
        /// The view's index.
        view: usize,
        /// Width and height of the image.
        image: (u32, u32),
        /// Width and height in the intrinsics.
        camera: (u32, u32),
    },
    /// A pose has a number that is not finite.
    #[error("view {view}: the camera's pose is not finite")]
    Pose {
        /// The view's index.
        view: usize,
    },
    /// The cube cannot be used.
    #[error("bounds {field} is {value}, must be {bound}")]
    Bounds {
        /// The field's name.
        field: &'static str,
        /// The value given.
        value: f64,
        /// The bound in words.
        bound: &'static str,
    },
    /// A setting is out of its bound.
    #[error("setting {field} is {value}, must be {bound}")]
    Setting {
        /// The field's name.
        field: &'static str,
        /// The value given.
        value: f64,
        /// The bound in words.
        bound: &'static str,
    },
    /// No pixel of any view looks into the cube.
    #[error("none of the {views} views looks into the bounds")]
    BoundsUnseen {
        /// How many views were given.
        views: usize,
    },
}
