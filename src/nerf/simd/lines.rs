//! Large tables of cache lines that random look-ups run over.

use std::ops::{Deref, DerefMut};

use super::Line;

/// Lines in a huge page of 2 MiB.
const HUGE: usize = 32_768;

/// As large and aligned as a huge page.
#[repr(C, align(2_097_152))]
struct HugePage([Line; HUGE]);

/// Lines in huge pages where the system grants them: with pages of 4 KiB
/// look-ups miss the address cache too: 6 to 9 % of a training.
pub(in crate::nerf) struct Lines {
    pages: Vec<HugePage>,
    len: usize,
}

impl Lines {
    /// Zeros.
    pub fn new(len: usize) -> Lines {
        let count = len.div_ceil(HUGE);
        let mut pages: Vec<HugePage> = Vec::with_capacity(count);
        // Before the first write: a page that has been given out small stays small.
        advise_huge(&mut pages);
        // SAFETY: the capacity is `count`, and a page of zero bytes is one of zero floats.
        unsafe {
            pages.as_mut_ptr().write_bytes(0, count);
            pages.set_len(count);
        }
        Lines { pages, len }
    }
}

/// Asks for huge pages under the capacity of `pages`; a refusal costs speed alone.
fn advise_huge(pages: &mut Vec<HugePage>) {
    #[cfg(target_os = "linux")]
    if pages.capacity() > 0 {
        let bytes = pages.capacity() * size_of::<HugePage>();
        // SAFETY: the range is this vector's own allocation, and the advice changes no contents.
        let _ = unsafe {
            rustix::mm::madvise(pages.as_mut_ptr().cast(), bytes, rustix::mm::Advice::LinuxHugepage)
        };
    }
    #[cfg(not(target_os = "linux"))]
    let _ = pages;
}

impl Deref for Lines {
    type Target = [Line];

    fn deref(&self) -> &[Line] {
        // SAFETY: pages are arrays of lines without padding, and `len` lines are within them.
        unsafe { std::slice::from_raw_parts(self.pages.as_ptr().cast(), self.len) }
    }
}

impl DerefMut for Lines {
    fn deref_mut(&mut self) -> &mut [Line] {
        // SAFETY: as in `deref`; the borrow is exclusive.
        unsafe { std::slice::from_raw_parts_mut(self.pages.as_mut_ptr().cast(), self.len) }
    }
}

impl Clone for Lines {
    fn clone(&self) -> Lines {
        let mut copy = Lines::new(self.len);
        copy.copy_from_slice(self);
        copy
    }
}

impl std::fmt::Debug for Lines {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Lines({})", self.len)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_begin_as_zeros_and_copies_are_their_own() {
        for len in [0, 1, HUGE, HUGE + 1] {
            let mut lines = Lines::new(len);
            assert_eq!(lines.len(), len);
            assert!(lines.iter().all(|line| line.0 == [0.0; 16]));
            let Some(last) = lines.last_mut() else { continue };
            last.0[15] = 3.0;
            let copy = lines.clone();
            lines[len - 1].0[15] = 4.0;
            assert_eq!((copy[len - 1].0[15], copy.len()), (3.0, len));
        }
    }
}
