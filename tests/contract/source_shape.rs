//! Rules for the source files: the order of imports, unique names, length.
//!
//! ```text
//! error, math, arena < geometry < mesh, model < state < solver < cloth < the crate's root
//! inside solver: data files < world < stage files < pipeline
//! ```
//! A file imports from its own level and from lower ones. A data file is one that `solver/world.rs`
//! imports, directly or through others. Reads the sources as text; see `imports` for how.

mod imports;
mod items;
mod tokens;

use imports::{Crate, Module, circles, module_name, reachable, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The top folders and files of `src`, lowest level first.
const LEVELS: [&[&str]; 6] = [
    &["error", "math", "arena"],
    &["geometry"],
    &["mesh", "model"],
    &["state"],
    &["solver"],
    &["cloth"],
];

/// The source folders of crates in which no file imports itself through others.
const WITHOUT_CIRCLES: [&str; 8] = [
    "src",
    "bindings/c/src",
    "bindings/godot/src",
    "bindings/js/src",
    "demo/src",
    "demo/scenes/src",
    "tests/verify/src",
    "xtask/src",
];

/// The folders whose files must be shorter than [`MAX_LINES`].
const SHORT: [&str; 6] = ["src", "bindings", "demo", "benches", "tests", "xtask"];
/// A file of so many lines is too long.
const MAX_LINES: usize = 500;

/// Type names that several files of `src` may define, and why.
const SHARED_TYPE_NAMES: [(&str, &str); 1] =
    [("F32x4", "one for each instruction set, of which a build has one")];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn level_of(module: &Module) -> usize {
    let Some(top) = module.first() else { return LEVELS.len() };
    let level = LEVELS.iter().position(|level| level.contains(&top.as_str()));
    level.unwrap_or_else(|| panic!("{top} has no level; add it to LEVELS"))
}

fn module(path: &str) -> Module {
    path.split("::").map(str::to_owned).collect()
}

/// Fails with all of `broken`, one a line.
fn assert_none(rule: &str, broken: &[String]) {
    assert!(broken.is_empty(), "{rule}\n{}", broken.join("\n"));
}

#[test]
fn a_file_imports_from_its_own_level_and_lower_ones() {
    let imports = Crate::read(&root().join("src")).imports();
    let count: usize = imports.values().map(BTreeSet::len).sum();
    assert!(count > 300, "the test found only {count} imports");
    let mut broken = Vec::new();
    for (file, used) in &imports {
        let higher = used.iter().filter(|used| level_of(used) > level_of(file));
        broken.extend(higher.map(|used| arrow(file, used)));
    }
    assert_none("these files import from a higher level:", &broken);
}

#[test]
fn in_the_solver_data_is_below_the_world_and_stages_are_below_the_pipeline() {
    let imports = Crate::read(&root().join("src")).imports();
    let (solver, world) = (module("solver"), module("solver::world"));
    let pipeline = module("solver::pipeline");
    let mut broken = Vec::new();
    let data = reachable(&imports, &world);
    for file in data.iter().filter(|file| file.starts_with(&solver)) {
        let higher = [&world, &pipeline, &solver].map(|high| (high, imports[file].contains(high)));
        let higher = higher.into_iter().filter(|(_, is_used)| *is_used);
        broken.extend(higher.map(|(high, _)| {
            format!("{}, which {} needs", arrow(file, high), module_name(&world))
        }));
    }
    for (file, used) in imports.iter().filter(|(file, _)| file.starts_with(&solver)) {
        if used.contains(&pipeline) && *file != solver {
            broken.push(arrow(file, &pipeline));
        }
    }
    assert_none("these files of the solver import from a higher level:", &broken);
}

#[test]
fn no_file_imports_itself_through_others() {
    let mut broken = Vec::new();
    for folder in WITHOUT_CIRCLES {
        let imports = Crate::read(&root().join(folder)).imports();
        for circle in circles(&imports) {
            broken.push(format!("{folder}: a circle of {} files", circle.len()));
            for file in &circle {
                let inside: Vec<_> =
                    imports[file].intersection(&circle).map(|used| module_name(used)).collect();
                broken.push(format!("  {} imports {}", module_name(file), inside.join(", ")));
            }
        }
    }
    assert_none("these files import each other:", &broken);
}

#[test]
fn names_of_files_are_unique_in_the_solver() {
    let files = rust_files(&root().join("src/solver"));
    let named = files.iter().filter(|file| !file.ends_with("mod.rs"));
    let names = named.map(|file| (file.file_name().unwrap().to_owned(), file.clone()));
    let broken: Vec<_> = twice(names).values().map(|files| shown(files).join(" and ")).collect();
    assert_none("these files share a name:", &broken);
}

#[test]
fn names_of_types_are_unique() {
    let library = Crate::read(&root().join("src"));
    // A stand-in for a part that a feature leaves out has the names of that part.
    let is_stand_in = |file: &Module| file.last().is_some_and(|name| name.starts_with("no_"));
    let files = library.files.iter().filter(|(file, _)| !is_stand_in(file));
    // A file may define a name twice, for example with threads and without.
    let names = files.flat_map(|(file, items)| {
        let names: BTreeSet<_> = items.types.iter().collect();
        names.into_iter().map(|name| (name.clone(), module_name(file)))
    });
    let shared: BTreeMap<String, Vec<String>> = twice(names);
    let is_allowed = |name: &str| SHARED_TYPE_NAMES.iter().any(|(allowed, _)| *allowed == name);
    let broken = shared.iter().filter(|(name, _)| !is_allowed(name));
    let broken: Vec<_> =
        broken.map(|(name, files)| format!("{name}: {}", files.join(", "))).collect();
    assert_none("these types share a name:", &broken);
    let stale = SHARED_TYPE_NAMES.iter().filter(|(name, _)| !shared.contains_key(*name));
    let stale: Vec<_> = stale.map(|(name, _)| String::from(*name)).collect();
    assert_none("these names need no exception:", &stale);
}

#[test]
fn files_are_shorter_than_five_hundred_lines() {
    let files: Vec<_> = SHORT.iter().flat_map(|folder| rust_files(&root().join(folder))).collect();
    assert!(files.len() > 300, "the test found only {} files", files.len());
    let mut broken = Vec::new();
    for file in files {
        let lines = fs::read_to_string(&file).unwrap().lines().count();
        if lines >= MAX_LINES {
            broken.push(format!("{} has {lines} lines", shown(&[file])[0]));
        }
    }
    assert_none("these files are too long:", &broken);
}

fn arrow(file: &Module, used: &Module) -> String {
    format!("{} imports {}", module_name(file), module_name(used))
}

/// Paths as seen from the repository's root.
fn shown(files: &[PathBuf]) -> Vec<String> {
    let relative = |file: &PathBuf| file.strip_prefix(root()).unwrap().display().to_string();
    files.iter().map(relative).collect()
}

/// Each key that comes with several values, and those values.
fn twice<K: Ord, V>(pairs: impl Iterator<Item = (K, V)>) -> BTreeMap<K, Vec<V>> {
    let mut values: BTreeMap<K, Vec<V>> = BTreeMap::new();
    for (key, value) in pairs {
        values.entry(key).or_default().push(value);
    }
    values.retain(|_, values| values.len() > 1);
    values
}
