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

/// Defines `$name(level, arguments…)`, which runs `$body(arguments…)` as compiled for that level; after
/// a second body, that one where there is AVX2 or better.
///
/// The bodies must be `#[inline(always)]`.
macro_rules! leveled {
    ($(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) = $body:path) => {
        $crate::math::simd::leveled! {
            $(#[$doc])* $vis fn $name($($arg: $type),*) = $body, $body
        }
    };
    (
        $(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?)
            = $body:path, $fast:path
    ) => {
        $(#[$doc])*
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2($($arg: $type),*) {
                    $fast($($arg),*);
                }
                #[target_feature(enable = "avx512f,avx512vl")]
                fn avx512($($arg: $type),*) {
                    $fast($($arg),*);
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

/// Lanes of a chunk.
pub(crate) const LANES: usize = 8;

pub(crate) type Lanes = [f32; LANES];

/// Eight numbers of a list.
#[inline(always)]
pub(crate) fn lanes(list: &[f32], first: usize) -> Lanes {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&list[first..first + LANES]);
    lanes
}

/// Four numbers of each of eight points, turned so that each number has its lanes.
///
/// `FAST` is whether the code around is compiled for AVX2 or better.
///
/// # Panics
/// If a point is not there.
#[inline(always)]
pub(crate) fn gather<const FAST: bool>(points: &[[f32; 4]], at: &[u32; LANES]) -> [Lanes; 4] {
    assert_all_within(points, at);
    #[cfg(target_arch = "x86_64")]
    if FAST {
        // SAFETY: the caller runs with AVX2, and all indices were just found to be within.
        return unsafe { avx2::gather(points, at) };
    }
    let mut lanes = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        let point = points[at[lane] as usize];
        for number in 0..4 {
            lanes[number][lane] = point[number];
        }
    }
    lanes
}

/// Puts eight points back. Of equal indices the last one stays.
///
/// # Panics
/// If a point is not there.
#[inline(always)]
pub(crate) fn scatter<const FAST: bool>(
    points: &mut [[f32; 4]],
    at: &[u32; LANES],
    lanes: &[Lanes; 4],
) {
    assert_all_within(points, at);
    #[cfg(target_arch = "x86_64")]
    if FAST {
        // SAFETY: as in `gather`.
        unsafe { avx2::scatter(points, at, lanes) };
        return;
    }
    for lane in 0..LANES {
        points[at[lane] as usize] = [0, 1, 2, 3].map(|number| lanes[number][lane]);
    }
}

/// One comparison for all eight.
#[inline(always)]
fn assert_all_within(points: &[[f32; 4]], at: &[u32; LANES]) {
    let mut most = 0;
    for index in at {
        most = if *index > most { *index } else { most };
    }
    assert!((most as usize) < points.len(), "a link ends at a particle");
}

/// What compilers do not find by themselves: four by four numbers turned in registers.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::{LANES, Lanes};
    use core::arch::x86_64::{
        __m256, _mm_loadu_ps, _mm_storeu_ps, _mm256_castps128_ps256, _mm256_castps256_ps128,
        _mm256_extractf128_ps, _mm256_insertf128_ps, _mm256_shuffle_ps, _mm256_unpackhi_ps,
        _mm256_unpacklo_ps,
    };

    /// # Safety
    /// All of `at` are below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn gather(points: &[[f32; 4]], at: &[u32; LANES]) -> [Lanes; 4] {
        let two = |lane: usize| {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low = _mm_loadu_ps(points.get_unchecked(at[lane] as usize).as_ptr());
                let high = _mm_loadu_ps(points.get_unchecked(at[lane + 4] as usize).as_ptr());
                _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high)
            }
        };
        let turned = turn([two(0), two(1), two(2), two(3)]);
        // SAFETY: both are eight times four floats.
        unsafe { core::mem::transmute::<[__m256; 4], [Lanes; 4]>(turned) }
    }

    /// # Safety
    /// All of `at` are below the number of points.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub unsafe fn scatter(points: &mut [[f32; 4]], at: &[u32; LANES], lanes: &[Lanes; 4]) {
        // SAFETY: both are eight times four floats.
        let lanes = unsafe { core::mem::transmute::<[Lanes; 4], [__m256; 4]>(*lanes) };
        for (lane, two) in turn(lanes).into_iter().enumerate() {
            // SAFETY: the caller's promise above; a point is sixteen bytes.
            unsafe {
                let low = points.get_unchecked_mut(at[lane] as usize).as_mut_ptr();
                _mm_storeu_ps(low, _mm256_castps256_ps128(two));
                let high = points.get_unchecked_mut(at[lane + 4] as usize).as_mut_ptr();
                _mm_storeu_ps(high, _mm256_extractf128_ps::<1>(two));
            }
        }
    }

    /// Turns four by four numbers, in both halves.
    #[inline]
    #[target_feature(enable = "avx2")]
    fn turn([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
        let (ab_low, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab_low, cd_low),
            _mm256_shuffle_ps::<0xee>(ab_low, cd_low),
            _mm256_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm256_shuffle_ps::<0xee>(ab_high, cd_high),
        ]
    }
}
