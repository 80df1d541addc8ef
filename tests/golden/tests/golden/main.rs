//! Compares the scenes with the golden hashes: on one thread, under other floating-point modes, and
//! on several threads.

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod modes;
mod script;
mod table;
mod threads;

use muslin_golden::{SCENES, Scene, Trace};

/// Every scene with its golden hash.
fn scenes_with_golden_hashes() -> Vec<(&'static Scene, &'static str)> {
    let golden = |scene: &Scene| {
        let mut lines = table::GOLDEN.lines().filter_map(|line| line.split_once(' '));
        let line = lines.find(|(name, _)| *name == scene.name);
        line.unwrap_or_else(|| panic!("{} is not in golden.txt", scene.name)).1
    };
    SCENES.iter().map(|scene| (scene, golden(scene))).collect()
}

/// The hash of a trace in the format of the table.
fn hash_text(trace: &Trace) -> String {
    format!("{:#018x}", trace.hash())
}
