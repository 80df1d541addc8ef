//! Checks the table of `docs/manual/integration.md`: how many lines each language takes from nothing
//! to its first frame.

use std::path::Path;

use crate::failure::{Failure, Result};
use crate::{engines, files};

const TABLE: &str = "docs/manual/integration.md";

/// A program in the documents, and the row of the table that counts its lines.
struct Program {
    row: &'static str,
    page: &'static str,
    /// The language of the first block of the page that is the program.
    language: &'static str,
    /// What the line that reads or draws the first frame contains; nothing if it is the last line.
    frame: &'static str,
}

const fn program(
    row: &'static str,
    page: &'static str,
    language: &'static str,
    frame: &'static str,
) -> Program {
    Program { row, page, language, frame }
}

const PROGRAMS: [Program; 9] = [
    program("Rust", "README.md", "rust", "cloth.view()"),
    program("C", "README.md", "c", "muslin_cloth_view("),
    program("C++", TABLE, "cpp", "cloth.view()"),
    program("C#", "docs/manual/unity.md", "cs", "muslin_cloth_view("),
    program("Python", "README.md", "py", "cloth.positions"),
    program("JavaScript", "README.md", "js", "cloth.positions"),
    program("three.js", NPM_README, "html", "renderer.render("),
    program("React", NPM_README, "jsx", ""),
    program("Godot 4.3 or newer", "docs/manual/godot.md", "gdscript", "add_child(cloth)"),
];

/// Examples whose row has the number of all their lines in parentheses: the files or folders of each.
const EXAMPLES: [(&str, &[&str]); 7] = [
    ("Unity", &["bindings/csharp/examples/unity/MuslinSheet.cs"]),
    ("Unreal", &["bindings/unreal"]),
    ("OGRE", &["bindings/c/examples/ogre.cpp"]),
    ("Bevy", &["bindings/bevy/src/main.rs"]),
    ("Babylon.js", &["bindings/js/examples/babylon"]),
    ("WebGL alone", &["bindings/js/examples/plain"]),
    ("Worker", &["bindings/js/examples/worker"]),
];

const NPM_README: &str = "bindings/js/package/README.md";

/// Fails if a row of the table has another number than the program has lines that are not empty.
pub fn check() -> Result {
    let table = files::read(&files::root().join(TABLE))?;
    for Program { row, page, language, frame } in PROGRAMS {
        let text = files::read(&files::root().join(page))?;
        let missing = || Failure::new(format!("{page} has no block of {language} with {frame:?}"));
        let lines = lines_of(&text, language, frame).ok_or_else(missing)?;
        check_row(&table, row, &lines.to_string())?;
    }
    for (row, paths) in EXAMPLES {
        let mut lines = 0;
        for path in paths {
            lines += lines_in(&files::root().join(path))?;
        }
        check_row(&table, row, &format!("({lines})"))?;
    }
    check_row(&table, "raylib", &engines::lines_of_example("raylib.c")?.to_string())
}

/// The lines that are not empty in a file, or in all files of a folder.
fn lines_in(path: &Path) -> Result<usize> {
    if path.is_dir() {
        return files::list(path)?.iter().map(|path| lines_in(path)).sum();
    }
    Ok(files::read(path)?.lines().filter(|line| !line.trim().is_empty()).count())
}

/// The lines of the first block of a language, up to the first that contains `frame`.
fn lines_of(text: &str, language: &str, frame: &str) -> Option<usize> {
    let (_, rest) = text.split_once(&format!("```{language}\n"))?;
    let (block, _) = rest.split_once("```")?;
    let mut lines = block.lines().filter(|line| !line.trim().is_empty());
    if frame.is_empty() {
        return Some(lines.count());
    }
    lines.position(|line| line.contains(frame)).map(|at| at + 1)
}

fn check_row(table: &str, row: &str, lines: &str) -> Result {
    let start = format!("| {row} |");
    let cells = table.lines().find(|line| line.starts_with(&start));
    let cells: Vec<_> = cells.unwrap_or_default().split('|').map(str::trim).collect();
    if cells.get(3) == Some(&lines) {
        return Ok(());
    }
    let rule = format!("{TABLE}: the third cell of the row {row:?} must be {lines}");
    Err(Failure::new(rule))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_up_to_the_first_frame() {
        let text = "```js\na;\n\nb;\nread(c);\nd;\n```\n```js\nread(c);\n```\n";
        assert_eq!(lines_of(text, "js", "read("), Some(3));
        assert_eq!(lines_of(text, "js", ""), Some(4));
        assert_eq!(lines_of(text, "js", "draw("), None);
    }

    #[test]
    fn a_row_with_another_number_is_refused() {
        let table = "| what | how | lines |\n| C | archive | 12 |\n";
        assert!(check_row(table, "C", "12").is_ok());
        assert!(check_row(table, "C", "13").unwrap_err().to_string().contains("must be 13"));
        assert!(check_row(table, "C++", "12").is_err());
    }

    #[test]
    fn the_table_counts_the_programs_of_the_documents() {
        check().unwrap();
    }
}
