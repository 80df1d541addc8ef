//! Golden scenes: together they use every feature of a cloth, and each gives one hash over all its
//! outputs.
//!
//! `golden.txt` holds one hash per scene, equal on every platform. `cargo xtask test bits` runs the
//! scenes natively, in wasm and on emulated processors, and compares the hashes.

mod scenes;
mod trace;
mod web;

use std::fmt::Write;

pub use scenes::SCENES;
pub use trace::{TickHash, Trace};

/// A scripted scene for one or more cloths.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Its name in the table.
    pub name: &'static str,
    play: fn(&mut Trace) -> muslin::Result<()>,
}

impl Scene {
    /// Runs the scene from beginning to end.
    ///
    /// # Panics
    /// If the scene does not reach the effect that it tests.
    pub fn play(&self) -> Trace {
        self.play_into(Trace::default())
    }

    /// Runs the scene with every tick split over `threads` threads, however small the cloth.
    ///
    /// # Panics
    /// As [`Scene::play`].
    #[cfg(feature = "parallel")]
    pub fn play_on(&self, threads: u32) -> Trace {
        self.play_into(Trace::with_threads(threads))
    }

    fn play_into(&self, mut trace: Trace) -> Trace {
        let played = (self.play)(&mut trace);
        played.unwrap_or_else(|error| panic!("scene {} was refused a call: {error}", self.name));
        trace
    }
}

/// Name of the instruction set that the kernels use on this machine. In builds with
/// `--cfg muslin_simd_limit` the library itself names the level that it chose within the limit.
pub fn instructions() -> &'static str {
    #[cfg(all(muslin_simd_limit, target_arch = "x86_64"))]
    return muslin::best_level_name();
    #[cfg(all(not(muslin_simd_limit), target_arch = "x86_64"))]
    return if std::is_x86_feature_detected!("avx2") { "avx2" } else { "sse2" };
    #[cfg(target_arch = "aarch64")]
    return "neon";
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    if cfg!(target_feature = "simd128") { "simd128" } else { "scalar" }
}

/// The output of the program: the instruction set, then the table.
pub fn report(every_tick: bool) -> String {
    format!("instructions {}\n{}", instructions(), table(every_tick))
}

/// The output of the program for one scene; none if no scene has this name.
pub fn report_of(name: &str) -> Option<String> {
    let scene = SCENES.iter().find(|scene| scene.name == name)?;
    let hash = scene.play().hash();
    Some(format!("instructions {}\n{name} {hash:#018x}\n", instructions()))
}

/// Runs all scenes. Returns one line `name 0xhash` per scene, or one line `name tick 0xhash` per
/// tick.
pub fn table(every_tick: bool) -> String {
    let mut table = String::new();
    for scene in SCENES {
        let trace = scene.play();
        let name = scene.name;
        if every_tick {
            for TickHash { tick, hash } in trace.tick_hashes() {
                let _ = writeln!(table, "{name} {tick} {hash:#018x}");
            }
        } else {
            let _ = writeln!(table, "{name} {:#018x}", trace.hash());
        }
    }
    table
}
