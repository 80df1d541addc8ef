//! One source for every instruction set: a kernel is a plain loop, compiled once for each level and
//! chosen when the program runs. No level has a fused or approximate operation, so all give the same
//! bits.

/// The instruction sets that kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// What the target always has: SSE2, NEON, simd128 where it is enabled, or none at all.
    Base,
    /// Eight lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Sixteen lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// The best that this machine has.
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if std::is_x86_feature_detected!("avx512f") && std::is_x86_feature_detected!("avx512vl")
            {
                return Self::Avx512;
            }
            if std::is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Base
    }

    /// All that this machine has, the least first.
    #[cfg(test)]
    pub fn all() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let more = [Self::Avx2, Self::Avx512];
        #[cfg(not(target_arch = "x86_64"))]
        let more = [];
        let best = Self::best();
        let reached = more.iter().position(|level| *level == best).map_or(0, |at| at + 1);
        let mut all = vec![Self::Base];
        all.extend(more.into_iter().take(reached));
        all
    }
}

/// Defines `$name(level, arguments…)`, which runs `$body(arguments…)` as compiled for that level.
///
/// `$body` must be `#[inline(always)]`.
macro_rules! leveled {
    ($(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) = $body:path) => {
        $(#[$doc])*
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2($($arg: $type),*) {
                    $body($($arg),*);
                }
                #[target_feature(enable = "avx512f,avx512vl")]
                fn avx512($($arg: $type),*) {
                    $body($($arg),*);
                }
                match level {
                    // SAFETY: `Level::best` gave this level, so the machine has these instructions.
                    $crate::math::simd::Level::Avx2 => return unsafe { avx2($($arg),*) },
                    // SAFETY: as above.
                    $crate::math::simd::Level::Avx512 => return unsafe { avx512($($arg),*) },
                    $crate::math::simd::Level::Base => {}
                }
            }
            let _ = level;
            $body($($arg),*);
        }
    };
}
pub(crate) use leveled;
