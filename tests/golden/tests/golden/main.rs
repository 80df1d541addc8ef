//! The table of golden hashes, compared: alone, under the floating-point modes of strange hosts, and on
//! many threads at once.

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod modes;
mod script;
mod table;
mod threads;

use muslin_golden::{SCENES, Scene, Trace};

/// The scenes, each with the hash that it is to end in.
fn scenes() -> Vec<(&'static Scene, &'static str)> {
    let golden = |scene: &Scene| {
        let mut lines = table::GOLDEN.lines().filter_map(|line| line.split_once(' '));
        let line = lines.find(|(name, _)| *name == scene.name);
        line.unwrap_or_else(|| panic!("{} is not in golden.txt", scene.name)).1
    };
    SCENES.iter().map(|scene| (scene, golden(scene))).collect()
}

/// The hash of a trace as the table writes it.
fn written(trace: &Trace) -> String {
    format!("{:#018x}", trace.hash())
}
