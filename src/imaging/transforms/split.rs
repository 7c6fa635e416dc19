//! Holds frames out for testing.

/// Splits `frames` in order: every `every`-th, beginning with the first, becomes a
/// test frame. 0 holds none out, and so does a set too small to leave one to train on.
pub(super) fn hold_out<T>(frames: Vec<T>, every: usize) -> (Vec<T>, Vec<T>) {
    if every < 2 || frames.len() < 2 {
        return (frames, Vec::new());
    }
    let (mut train, mut test) = (Vec::new(), Vec::new());
    for (i, frame) in frames.into_iter().enumerate() {
        if i % every == 0 { test.push(frame) } else { train.push(frame) }
    }
    (train, test)
}
