//! SIMD dispatch (function multiversioning): each kernel is compiled once per instruction set, and
//! the copy for the widest instruction set of the CPU is called at run time.
//!
//! ```text
//! Level       x86-64          aarch64        WebAssembly             other targets
//! Scalar      in tests only   in tests only  built without simd128   always
//! Baseline    SSE2            NEON           simd128                 -
//! Avx2        AVX2            -              -                       -
//! ```
//!
//! [`Level::best`] runs once, when a cloth is created. Each dispatched function then takes the
//! level as its first argument and calls the copy that was compiled for it. There are two kinds:
//! - `leveled!`: the kernel is a plain loop over slices, which the compiler vectorises by itself;
//! - `vectored!`: the kernel is written over [`Simd`], because compilers find neither the
//!   deinterleaving of a row of particles nor the 4 × 4 transpose of gathered points.
//!
//! Reads and writes only what kernels are given. The traits are in [`lanes`], the instruction sets
//! in `x86`, `neon` and `wasm`, gather and scatter of interleaved points in [`transpose`].
//!
//! Invariant: no level uses a fused or an approximate operation, so all levels give the same bits.

// Without vectors only the scalar code is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

mod lanes;
#[cfg(target_arch = "aarch64")]
mod neon;
mod transpose;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use lanes::{Float, GatherPairs, LANES, LaneArray, MAX_LANES, Scalar, Simd};
#[cfg(target_arch = "aarch64")]
pub(crate) use neon::Neon;
pub(crate) use transpose::{gather_transpose, scatter_transpose, transpose_4x4};
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) use wasm::Simd128;
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Avx2, Sse2};

/// The instruction set that every CPU of the target has, for code that is too small to be compiled
/// once per level.
#[cfg(target_arch = "aarch64")]
pub(crate) type Baseline = Neon;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) type Baseline = Simd128;
#[cfg(target_arch = "x86_64")]
pub(crate) type Baseline = Sse2;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
pub(crate) type Baseline = Scalar;

/// The instruction sets that kernels are compiled for, narrowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// Scalar code: for targets without vectors, and for tests that compare with it.
    #[cfg_attr(
        any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"),
        allow(dead_code)
    )]
    Scalar,
    /// The instructions that every CPU of the target has: SSE2, NEON or simd128, four lanes.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))]
    Baseline,
    /// AVX2, eight lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2,
}

impl Level {
    /// Whether kernels are also compiled as scalar code: on targets without vectors, and in tests,
    /// which compare with it.
    pub const HAS_SCALAR: bool = cfg!(any(
        test,
        not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
    ));

    /// Returns the widest level that this CPU has. With `--cfg muslin_simd_limit`, for tests and
    /// measurements, the environment variable `MUSLIN_SIMD_LIMIT` limits it; other builds never
    /// read the environment.
    pub fn best() -> Self {
        let widest = Self::widest();
        #[cfg(all(muslin_simd_limit, target_arch = "x86_64"))]
        if let Some(limit) = std::env::var_os("MUSLIN_SIMD_LIMIT") {
            return widest.limited_to(&limit.to_string_lossy());
        }
        widest
    }

    /// Returns whether one vector holds all lanes of a block.
    pub fn is_wide(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return self == Self::Avx2;
        #[cfg(not(target_arch = "x86_64"))]
        false
    }

    /// Detects the widest level of this CPU.
    fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if std::is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))]
        return Self::Baseline;
        #[cfg(not(any(
            target_arch = "x86_64",
            target_arch = "aarch64",
            target_feature = "simd128"
        )))]
        Self::Scalar
    }

    /// Returns the narrower one of this level and the level named `limit`: `sse2` or `avx2`.
    ///
    /// # Panics
    /// If `limit` is another name.
    #[cfg(all(any(test, muslin_simd_limit), target_arch = "x86_64"))]
    fn limited_to(self, limit: &str) -> Self {
        match (limit, self) {
            ("sse2", _) => Self::Baseline,
            ("avx2", own) => own,
            _ => panic!("MUSLIN_SIMD_LIMIT must be sse2 or avx2, not {limit:?}"),
        }
    }

    /// Returns all levels that this CPU has, narrowest first.
    #[cfg(test)]
    pub fn available() -> Vec<Self> {
        let all = [
            Self::Scalar,
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
            Self::Baseline,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2,
        ];
        let best = all.iter().position(|level| *level == Self::best());
        all[..=best.expect("the list of levels contains the best one")].to_vec()
    }
}

/// Defines `fn name(level: Level, arguments…)`, which calls the copy of `body(arguments…)` that was
/// compiled for `level`. The body is a plain loop that the compiler vectorises.
///
/// ```text
/// leveled! { fn name(arguments…) = body }           one body for all levels
/// leveled! { fn name(arguments…) = body, wide }     `wide` at AVX2
/// ```
///
/// The bodies must be `#[inline(always)]`, so that they are compiled inside the function that
/// enables the instructions.
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
        // V8 does not optimise functions above 61,440 bytes of bytecode; inlined kernels add up.
        #[cfg_attr(target_arch = "wasm32", inline(never))]
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2($($arg: $type),*) {
                    $fast($($arg),*);
                }
                if level == $crate::math::simd::Level::Avx2 {
                    // SAFETY: `Level::best` returned this level, so the CPU has these instructions.
                    return unsafe { avx2($($arg),*) };
                }
            }
            // Compiled once, not once per caller of `$name`: few x86-64 CPUs lack AVX2.
            #[cfg_attr(target_arch = "x86_64", inline(never))]
            fn baseline($($arg: $type),*) {
                $body($($arg),*);
            }
            let _ = level;
            baseline($($arg),*);
        }
    };
}
pub(crate) use leveled;

/// Defines `fn name(level: Level, arguments…)`, which calls `body(s, arguments…)` with the token
/// `s` of the instruction set of `level`.
///
/// ```text
/// vectored! { fn name(arguments…) = body, scalar }
/// ```
///
/// At `Level::Scalar` it calls `scalar(arguments…)`.
///
/// The bodies must be `#[inline(always)]`, so that they are compiled inside the function that
/// enables the instructions.
macro_rules! vectored {
    (
        $(#[$doc:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?)
            = $body:path, $scalar:path
    ) => {
        $(#[$doc])*
        // V8 does not optimise functions above 61,440 bytes of bytecode; inlined kernels add up.
        #[cfg_attr(target_arch = "wasm32", inline(never))]
        $vis fn $name(level: $crate::math::simd::Level, $($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2")]
            fn avx2($($arg: $type),*) {
                $body($crate::math::simd::Avx2::new(), $($arg),*);
            }
            // Compiled once, not once per caller, as in `leveled!`.
            #[cfg(target_arch = "x86_64")]
            #[inline(never)]
            fn baseline($($arg: $type),*) {
                $body($crate::math::simd::Sse2::new(), $($arg),*);
            }
            match level {
                $crate::math::simd::Level::Scalar if $crate::math::simd::Level::HAS_SCALAR => {
                    $scalar($($arg),*);
                }
                // SAFETY: `Level::best` returned this level, so the CPU has these instructions.
                #[cfg(target_arch = "x86_64")]
                $crate::math::simd::Level::Avx2 => unsafe { avx2($($arg),*) },
                #[cfg(target_arch = "x86_64")]
                _ => baseline($($arg),*),
                #[cfg(target_arch = "aarch64")]
                _ => $body($crate::math::simd::Neon::new(), $($arg),*),
                #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
                _ => $body($crate::math::simd::Simd128::new(), $($arg),*),
                #[cfg(not(any(
                    target_arch = "x86_64",
                    target_arch = "aarch64",
                    target_feature = "simd128"
                )))]
                _ => {}
            }
        }
    };
}
pub(crate) use vectored;

/// Name of the level that new cloths use, for the program that compares platforms.
#[cfg(all(muslin_simd_limit, target_arch = "x86_64"))]
pub fn best_level_name() -> &'static str {
    match Level::best() {
        Level::Avx2 => "avx2",
        _ => "sse2",
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::Level;

    #[test]
    fn a_limit_narrows_the_level_and_never_widens_it() {
        assert_eq!(Level::Avx2.limited_to("avx2"), Level::Avx2);
        assert_eq!(Level::Avx2.limited_to("sse2"), Level::Baseline);
        assert_eq!(Level::Baseline.limited_to("avx2"), Level::Baseline);
    }

    #[test]
    #[should_panic(expected = "sse2 or avx2")]
    fn an_unknown_limit_is_refused() {
        Level::Avx2.limited_to("sse4");
    }
}
