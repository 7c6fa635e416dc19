//! How much a prediction is worth: the paper's comparison of PRVNet with fixed view counts (Table I).
//!
//! - [`held_out`]: which labels a comparison may use. - [`candidate`]: a network with those that it may be judged on.
//! - [`counts`]: the view count each method gives an object.
//! - [`trial`]: reconstructs one object with each of those counts.
//! - [`store`]: the file of reconstructions. - [`table_one`]: what they say together. - [`plot`]: the same as a picture.

pub mod candidate;
pub mod counts;
pub mod held_out;
pub mod plot;
pub mod store;
pub mod student;
pub mod table_one;
pub mod trial;
