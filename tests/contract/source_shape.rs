//! The floors of `src/`: a file uses its own floor and the floors below, never one above.

use std::fs;
use std::path::{Path, PathBuf};

/// Each module's floor, lowest first.
const FLOORS: [&[&str]; 6] = [
    &["error", "math", "arena"],
    &["geometry"],
    &["mesh", "model"],
    &["state"],
    &["solver"],
    &["cloth"],
];

fn floor_of(module: &str) -> usize {
    let on = |floor: &[&str]| {
        floor.iter().any(|name| module == *name || module.starts_with(&format!("{name}::")))
    };
    let found = FLOORS.iter().position(|floor| on(floor));
    found.unwrap_or_else(|| panic!("module {module} is on no floor"))
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_file_uses_only_its_own_floor_and_those_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 30, "found only {} files", files.len());
    let mut uses = 0;
    for file in files {
        let inner = file.strip_prefix(&root).unwrap().with_extension("");
        let module = inner.to_str().unwrap().replace(['/', '\\'], "::").replace("::mod", "");
        if module == "lib" {
            continue;
        }
        let own = floor_of(&module);
        for part in fs::read_to_string(&file).unwrap().split("crate::").skip(1) {
            let path: String = part
                .chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':')
                .collect();
            let used = path.trim_end_matches(':');
            // Names at the crate's root are re-exports, for links in docs.
            if used.starts_with(char::is_uppercase) {
                continue;
            }
            uses += 1;
            assert!(floor_of(used) <= own, "{module} reaches up to {used}");
        }
    }
    assert!(uses > 60, "read only {uses} paths");
}
