//! `include/muslin.h` says what the library is.

use std::env;
use std::fs;
use std::path::Path;

const COMMAND: &str = "MUSLIN_BLESS=1 cargo test -p muslin-c --test header";

fn generated() -> String {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(own.join("cbindgen.toml")).unwrap();
    // From the sources alone: asks neither cargo nor a nightly compiler.
    let mut builder = cbindgen::Builder::new().with_config(config);
    let mut sources = vec![own.join("src")];
    let mut files = Vec::new();
    while let Some(folder) = sources.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                sources.push(path);
            } else {
                files.push(path);
            }
        }
    }
    // The order of the header: types from small to large, then functions by theme.
    files.sort_by_key(|file| (rank(file), file.clone()));
    for file in &files {
        builder = builder.with_src(file);
    }
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    String::from_utf8(header).unwrap()
}

/// Where the items of a file come in the header.
fn rank(file: &Path) -> usize {
    const ORDER: [&str; 10] =
        ["library", "init", "create", "time", "pins", "point", "tear", "colliders", "read", "save"];
    let stem = file.file_stem().unwrap_or_default();
    ORDER.iter().position(|name| *name == stem).map_or(0, |at| at + 1)
}

#[test]
fn the_header_is_what_the_sources_say() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../include/muslin.h");
    let generated = generated();
    if env::var_os("MUSLIN_BLESS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &generated).unwrap();
    }
    let written = fs::read_to_string(&path).unwrap_or_default();
    let (mut old, mut new) = (written.lines(), generated.lines());
    for line in 1.. {
        match (old.next(), new.next()) {
            (None, None) => break,
            (old, new) => assert_eq!(
                old, new,
                "line {line} of include/muslin.h is not what the sources say; if they are right: {COMMAND}"
            ),
        }
    }
    assert_eq!(written, generated, "line ends of include/muslin.h differ; write it: {COMMAND}");
}
