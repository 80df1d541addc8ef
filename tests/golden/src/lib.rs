//! Scenes that use everything that a cloth has, each with one hash over all that can be seen of it.
//!
//! `golden.txt` holds the hashes: one value a scene, the same on every platform. `cargo xtask test
//! bits` plays the scenes natively, in wasm and under emulation, and compares.

mod scenes;
mod trace;
mod web;

use std::fmt::Write;

pub use scenes::SCENES;
pub use trace::{Mark, Trace};

/// A play for one or more cloths.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// What it is called in the table.
    pub name: &'static str,
    play: fn(&mut Trace) -> muslin::Result<()>,
}

impl Scene {
    /// Plays it from beginning to end.
    ///
    /// # Panics
    /// If something that the scene is there for does not happen in it.
    pub fn play(&self) -> Trace {
        self.play_into(Trace::default())
    }

    /// Plays it with every tick cut up for so many threads, however small the cloth.
    ///
    /// # Panics
    /// As [`Scene::play`].
    #[cfg(feature = "parallel")]
    pub fn play_on(&self, threads: u32) -> Trace {
        self.play_into(Trace::on(threads))
    }

    fn play_into(&self, mut trace: Trace) -> Trace {
        let played = (self.play)(&mut trace);
        played.unwrap_or_else(|error| panic!("scene {} was refused a call: {error}", self.name));
        trace
    }
}

/// The instructions that the cloth's kernels find here.
pub fn instructions() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if std::is_x86_feature_detected!("avx512f") && std::is_x86_feature_detected!("avx512vl") {
            return "avx512";
        }
        if std::is_x86_feature_detected!("avx2") { "avx2" } else { "sse2" }
    }
    #[cfg(target_arch = "aarch64")]
    return "neon";
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    if cfg!(target_feature = "simd128") { "simd128" } else { "scalar" }
}

/// What a player prints: the instructions, then the table.
pub fn report(every_tick: bool) -> String {
    format!("instructions {}\n{}", instructions(), table(every_tick))
}

/// Plays all scenes: a line `name 0xhash` for each; or one for each tick, `name tick 0xhash`.
pub fn table(every_tick: bool) -> String {
    let mut table = String::new();
    for scene in SCENES {
        let trace = scene.play();
        let name = scene.name;
        if every_tick {
            for Mark { tick, hash } in trace.marks() {
                let _ = writeln!(table, "{name} {tick} {hash:#018x}");
            }
        } else {
            let _ = writeln!(table, "{name} {:#018x}", trace.hash());
        }
    }
    table
}
