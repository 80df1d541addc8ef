//! The folder table of `docs/architecture.md` lists exactly the folders of `src` and `src/solver`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The folders directly inside `folder`, as paths with a slash at the end.
fn subfolders(folder: &str) -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap());
    let folders = entries.filter(|entry| entry.file_type().unwrap().is_dir());
    folders.map(|entry| format!("{folder}/{}/", entry.file_name().to_string_lossy())).collect()
}

/// The paths in the first column of a table, of the rows that start with a folder of `src`.
fn listed(page: &str) -> Vec<String> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `src/"));
    let paths = rows.filter_map(|row| row.split_once('`').map(|(path, _)| format!("src/{path}")));
    paths.filter(|path| path.ends_with('/')).collect()
}

#[test]
fn the_folder_table_of_the_architecture_page_matches_the_source_tree() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/architecture.md");
    let listed = listed(&fs::read_to_string(path).unwrap());
    let rows: BTreeSet<String> = listed.iter().cloned().collect();
    assert_eq!(rows.len(), listed.len(), "a folder is listed twice: {listed:?}");
    let mut folders = subfolders("src");
    folders.append(&mut subfolders("src/solver"));
    assert!(folders.len() > 10, "the test found only {folders:?}");
    assert_eq!(rows, folders, "left: docs/architecture.md, right: the source tree");
}
