//! The import graph of a crate: which file uses items of which other file.
//!
//! A module is its path from the crate's root, such as `["solver", "world"]`; the root is empty.
//! Reads all files of a source folder; a file that is compiled for tests only is left out.

use super::items::{Items, ScopedPath, items};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A path of modules from the crate's root.
pub type Module = Vec<String>;

/// The source files of one crate, by module.
pub struct Crate {
    /// The items of each file.
    pub files: BTreeMap<Module, Items>,
}

/// The Rust files below a folder, sorted; those of npm packages are left out.
pub fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() && !path.ends_with("node_modules") {
                open.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// A module as it is written in messages.
pub fn module_name(module: &[String]) -> String {
    if module.is_empty() { "the crate's root".into() } else { module.join("::") }
}

impl Crate {
    /// Reads the crate whose root file lies in `folder`.
    pub fn read(folder: &Path) -> Self {
        // A program beside a library is a crate of its own, which no module of the library can use.
        let is_other_crate =
            |path: &PathBuf| path.ends_with("main.rs") && path.with_file_name("lib.rs").exists();
        let texts =
            rust_files(folder).into_iter().filter(|path| !is_other_crate(path)).map(|path| {
                let text = fs::read_to_string(&path).unwrap();
                (module_of(path.strip_prefix(folder).unwrap()), text)
            });
        Self::parse(texts)
    }

    fn parse(texts: impl Iterator<Item = (Module, String)>) -> Self {
        let mut files: BTreeMap<_, _> =
            texts.map(|(module, text)| (module, items(&text))).collect();
        let tests: Vec<Module> = files
            .iter()
            .flat_map(|(module, items)| items.test_modules.iter().map(|name| join(module, name)))
            .collect();
        files.retain(|module, _| !tests.iter().any(|test| module.starts_with(test)));
        Self { files }
    }

    /// For each file the other files whose items it uses.
    pub fn imports(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let of = |(module, items): (&Module, &Items)| {
            let imported = items.imports.iter().map(|import| &import.path);
            let used = imported.chain(&items.paths).filter_map(|path| self.resolve(module, path));
            (module.clone(), used.filter(|used| used != module).collect())
        };
        self.files.iter().map(of).collect()
    }

    /// The file that a path written in the file of `module` leads to; none for another crate's.
    ///
    /// A path to what a module re-exports leads to the module that re-exports it.
    fn resolve(&self, module: &[String], path: &ScopedPath) -> Option<Module> {
        let absolute = self.absolute(module, path).or_else(|| self.through_alias(module, path))?;
        (0..=absolute.len())
            .rev()
            .map(|length| absolute[..length].to_vec())
            .find(|prefix| self.files.contains_key(prefix))
    }

    /// The path from the crate's root, for one that starts with `crate`, `self`, `super` or the
    /// name of a module below the one that it is written in.
    fn absolute(&self, module: &[String], path: &ScopedPath) -> Option<Vec<String>> {
        let here = [module, &path.scope].concat();
        let (first, rest) = path.segments.split_first()?;
        let child = join(&here, first);
        Some(match first.as_str() {
            "crate" => rest.to_vec(),
            "self" => [&here, rest].concat(),
            "super" => {
                let ups = path.segments.iter().take_while(|segment| *segment == "super").count();
                let kept = here.len().checked_sub(ups)?;
                [&here[..kept], &path.segments[ups..]].concat()
            }
            _ if self.files.contains_key(&child) => [&child, rest].concat(),
            _ => return None,
        })
    }

    /// The path from the crate's root, for one that starts with a name that a `use` declaration of
    /// the same file brings into scope.
    fn through_alias(&self, module: &[String], path: &ScopedPath) -> Option<Vec<String>> {
        let (first, rest) = path.segments.split_first()?;
        let file = self.files.get(module)?;
        let import = file
            .imports
            .iter()
            .find(|import| import.alias == *first && import.path.scope == path.scope)?;
        Some([&self.absolute(module, &import.path)?, rest].concat())
    }
}

fn join(module: &[String], name: &str) -> Module {
    [module, &[name.to_owned()]].concat()
}

/// The module of a file, from its path below the folder of the crate's root file.
fn module_of(file: &Path) -> Module {
    let mut module: Module =
        file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if matches!(module.last().map(String::as_str), Some("mod" | "lib" | "main")) {
        module.pop();
    }
    module
}

/// The circles of a graph: its strongly connected components of two nodes or more.
pub fn circles(edges: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<BTreeSet<Module>> {
    let reached: BTreeMap<&Module, BTreeSet<Module>> =
        edges.keys().map(|module| (module, reachable(edges, module))).collect();
    let mut circles: Vec<BTreeSet<Module>> = Vec::new();
    for (module, all) in &reached {
        if circles.iter().any(|circle| circle.contains(*module)) {
            continue;
        }
        let leads_back = |other: &&Module| reached.get(*other).is_some_and(|r| r.contains(*module));
        let circle: BTreeSet<Module> = all.iter().filter(leads_back).cloned().collect();
        if circle.len() > 1 {
            circles.push(circle);
        }
    }
    circles
}

/// All modules that `from` uses directly or through others; itself only where it is part of a
/// circle.
pub fn reachable(edges: &BTreeMap<Module, BTreeSet<Module>>, from: &Module) -> BTreeSet<Module> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&Module> = vec![from];
    while let Some(module) = open.pop() {
        for used in edges.get(module).into_iter().flatten() {
            if reached.insert(used.clone()) {
                open.push(used);
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(path: &str) -> Module {
        path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()
    }

    /// What the files of a crate import, as `a::b -> c` for each.
    fn imports(files: &[(&str, &str)]) -> Vec<String> {
        let texts = files.iter().map(|(path, text)| (module(path), String::from(*text)));
        let edges = Crate::parse(texts).imports();
        let arrows = |(from, to): (&Module, &BTreeSet<Module>)| -> Vec<String> {
            to.iter().map(|to| format!("{} -> {}", from.join("::"), to.join("::"))).collect()
        };
        edges.iter().flat_map(arrows).collect()
    }

    #[test]
    fn each_name_of_a_grouped_use_leads_to_its_file() {
        let files = [
            ("a", "use crate::{b::B, c::{self, d::D}};"),
            ("b", ""),
            ("c", "mod d;"),
            ("c::d", ""),
        ];
        assert_eq!(imports(&files), ["a -> b", "a -> c", "a -> c::d"]);
    }

    #[test]
    fn super_and_self_are_relative_to_the_file() {
        let files = [
            ("a", "mod b; mod c; use self::c::C;"),
            ("a::b", "use super::c::C; use super::super::d::D; use super::A;"),
            ("a::c", ""),
            ("d", ""),
        ];
        assert_eq!(imports(&files), ["a -> a::c", "a::b -> a", "a::b -> a::c", "a::b -> d"]);
    }

    #[test]
    fn super_in_an_inline_module_is_the_file_itself() {
        let files = [("a", "mod inner { use super::A; use super::super::b::B; }"), ("b", "")];
        assert_eq!(imports(&files), ["a -> b"]);
    }

    #[test]
    fn an_inline_path_is_an_import_and_so_is_one_through_an_alias() {
        let files = [
            ("a", "use crate::b as other; fn f() { other::c::g(); crate::d::h() }"),
            ("b", ""),
            ("b::c", ""),
            ("d", ""),
        ];
        assert_eq!(imports(&files), ["a -> b", "a -> b::c", "a -> d"]);
    }

    #[test]
    fn a_parent_reaches_its_child_by_name() {
        let files = [("a", "mod b; pub use b::B; fn f() { b::g() }"), ("a::b", "")];
        assert_eq!(imports(&files), ["a -> a::b"]);
    }

    #[test]
    fn declaring_a_module_and_using_another_crate_are_no_imports() {
        let files = [("", "mod a;"), ("a", "use b::B; use std::fmt; fn f() { fmt::g() }")];
        assert!(imports(&files).is_empty());
    }

    #[test]
    fn files_for_tests_do_not_count() {
        let files = [
            ("a", "#[cfg(test)] mod tests;"),
            ("a::tests", "use super::A; use crate::b::B;"),
            ("b", "use crate::a::A;"),
        ];
        assert_eq!(imports(&files), ["b -> a"]);
    }

    #[test]
    fn a_circle_holds_every_file_on_it_and_none_beside_it() {
        let files = [
            ("a", "use crate::b::B;"),
            ("b", "use crate::c::C;"),
            ("c", "use crate::a::A; use crate::d::D;"),
            ("d", ""),
        ];
        let texts = files.iter().map(|(path, text)| (module(path), String::from(*text)));
        let found = circles(&Crate::parse(texts).imports());
        assert_eq!(found, [BTreeSet::from(["a", "b", "c"].map(module))]);
    }
}
