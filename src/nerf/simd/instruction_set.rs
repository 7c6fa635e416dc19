//! Which kernels this CPU can run.

/// A set of vector instructions that this CPU has. Results differ between sets
/// in the last bits of a float (a fused multiply-add rounds once).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstructionSet(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nerf) enum Kind {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl InstructionSet {
    /// What every CPU has.
    pub const PORTABLE: InstructionSet = InstructionSet(Kind::Portable);

    /// The sets this CPU has, the fastest last.
    pub fn available() -> Vec<InstructionSet> {
        #[allow(unused_mut)]
        let mut sets = vec![Self::PORTABLE];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if avx2 {
                sets.push(InstructionSet(Kind::Avx2));
            }
            if avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
            {
                sets.push(InstructionSet(Kind::Avx512));
            }
        }
        sets
    }

    /// The fastest set this CPU has.
    pub fn best() -> InstructionSet {
        Self::available().last().copied().unwrap_or(Self::PORTABLE)
    }

    /// `portable`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Kind::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => "avx512",
        }
    }

    pub(in crate::nerf) fn kind(self) -> Kind {
        self.0
    }
}

impl Default for InstructionSet {
    /// [`Self::best`]
    fn default() -> Self {
        Self::best()
    }
}
