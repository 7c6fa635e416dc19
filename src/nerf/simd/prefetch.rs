//! Asking for memory before it is needed: look-ups in tables larger than the caches wait for it.

/// Asks for the cache line of `at`, soon to be read. Any address will do: nothing is read, and one that
/// is not mapped is ignored.
#[inline(always)]
pub(in crate::nerf) fn prefetch<T>(at: *const T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 has the instruction, and it neither reads nor faults.
    unsafe {
        std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(at.cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = at;
}
