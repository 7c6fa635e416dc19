//! How many views an object needs: one NeRF per view set, a curve through their
//! PSNR, and the first number of views where one more view stops paying.
//!
//! Paper: section "Object-Specific Required Number of Views" and equation 1.
//!
//! - [`lognormal`]: the curve family C(v) and the reading of v* off it.
//! - [`fit`]: that curve through the NeRFs, by the paper's orthogonal regression or the steady fit.
//! - [`reading`]: the definitions of the label, their noise and the status.
//! - [`measure`]: the NeRFs; [`record`] and [`store`]: their file.

pub mod fit;
pub mod lognormal;
pub mod measure;
mod orthogonal;
pub(crate) mod photograph;
pub mod protocol;
pub mod reading;
pub mod record;
mod steady;
pub mod store;
