//! Tests: `include/muslin.h` is what cbindgen generates from the sources.
//!
//! `MUSLIN_BLESS=1 cargo test -p muslin-c --test header` writes the header again.

use std::env;
use std::fs;
use std::path::Path;

const COMMAND: &str = "MUSLIN_BLESS=1 cargo test -p muslin-c --test header";

/// The source files with items of the header, in its order: types before the types that contain them,
/// then functions by theme.
const FILES: [&str; 37] = [
    "status.rs",
    "log.rs",
    "types/value.rs",
    "types/material.rs",
    "types/settings.rs",
    "types/grid.rs",
    "types/mesh.rs",
    "types/mesh_report.rs",
    "types/wind.rs",
    "types/collider.rs",
    "types/hit.rs",
    "types/event.rs",
    "types/view.rs",
    "types/changes.rs",
    "types/stream.rs",
    "types/stats.rs",
    "types/sewing.rs",
    "types/skin.rs",
    "functions/library.rs",
    "functions/create.rs",
    "functions/parameters.rs",
    "functions/time.rs",
    "functions/queries.rs",
    "functions/pins.rs",
    "functions/particles.rs",
    "functions/attachments.rs",
    "functions/anchors.rs",
    "functions/picking.rs",
    "functions/topology.rs",
    "functions/colliders.rs",
    "functions/reference_frame.rs",
    "functions/views.rs",
    "functions/vertex_buffers.rs",
    "functions/sewing.rs",
    "functions/skins.rs",
    "functions/save.rs",
    "functions/init.rs",
];

/// Returns the header that the sources give. Needs neither cargo nor network nor a nightly compiler.
fn generated() -> String {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(own.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for file in FILES {
        builder = builder.with_src(own.join("src").join(file));
    }
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    let lines: Vec<String> =
        String::from_utf8(header).unwrap().lines().map(str::to_owned).collect();
    join_short_comments(&remove_struct_keywords(&lines))
        .iter()
        .map(|line| format!("{line}\n"))
        .collect()
}

/// Removes `struct` and `enum` where the typedef name suffices, as in
/// `enum MuslinStatus muslin_...(struct MuslinCloth cloth)`.
fn remove_struct_keywords(lines: &[String]) -> Vec<String> {
    let mut shift = 0;
    let rename = |line: &String| {
        if line.starts_with("typedef") {
            return line.clone();
        }
        let indent = line.len() - line.trim_start().len();
        // Continuation lines of a function whose first line became shorter.
        let aligned = if indent > 2 { &line[shift.min(indent)..] } else { line.as_str() };
        let plain = aligned.replace("struct Muslin", "Muslin").replace("enum Muslin", "Muslin");
        if let (Some(was), Some(is), false) = (line.find('('), plain.find('('), indent > 2) {
            shift = was - is;
        }
        plain
    };
    lines.iter().map(rename).collect()
}

/// Puts a comment of one short line on a single line: `/** ... */`.
fn join_short_comments(lines: &[String]) -> Vec<String> {
    let (mut out, mut at) = (Vec::new(), 0);
    while at < lines.len() {
        let sentence = lines.get(at + 1).and_then(|line| line.trim_start().strip_prefix("* "));
        let closes = lines.get(at + 2).is_some_and(|line| line.trim() == "*/");
        let indent = lines[at].len() - lines[at].trim_start().len();
        match sentence {
            Some(sentence) if lines[at].trim() == "/**" && closes && sentence.len() < 90 => {
                out.push(format!("{}/** {sentence} */", &lines[at][..indent]));
                at += 3;
            }
            _ => {
                out.push(lines[at].clone());
                at += 1;
            }
        }
    }
    out
}

/// Every source file that exports something must be one of [`FILES`].
#[test]
fn every_file_with_exports_is_in_the_header() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for folder in ["", "types", "functions"] {
        for entry in fs::read_dir(src.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let exports = path.is_file() && {
                let text = fs::read_to_string(&path).unwrap();
                text.contains("#[unsafe(no_mangle)]") || text.contains("pub const MUSLIN_")
            };
            let name = path.strip_prefix(&src).unwrap().to_str().unwrap();
            assert!(!exports || FILES.contains(&name), "{name} is not one of FILES");
        }
    }
}

#[test]
fn the_header_matches_the_sources() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../include/muslin.h");
    let generated = generated();
    if env::var_os("MUSLIN_BLESS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &generated).unwrap();
    }
    let written = fs::read_to_string(&path).unwrap_or_default();
    let (mut old, mut new) = (written.lines(), generated.lines());
    for line in 1.. {
        let (old, new) = (old.next(), new.next());
        assert_eq!(
            old, new,
            "line {line} of include/muslin.h differs from the sources; to write it again: {COMMAND}"
        );
        if old.is_none() {
            break;
        }
    }
    assert_eq!(
        written, generated,
        "line ends of include/muslin.h differ; to write it again: {COMMAND}"
    );
}
