//! Which functions the C library exports: exactly those that its header declares.

use std::path::Path;

use crate::binutils::Binutils;
use crate::failure::{Failure, Result};
use crate::{files, shell};

/// A symbol that is defined for others.
#[derive(Debug, PartialEq)]
pub struct Symbol {
    /// The object in the archive; empty for what is no archive.
    pub member: String,
    /// The name as in C.
    pub name: String,
}

/// The names of the functions that `muslin.h` declares, sorted.
pub fn declared() -> Result<Vec<String>> {
    let header = files::read(&files::root().join("include/muslin.h"))?;
    let is_inline = |name: &str| {
        ["void", "MuslinStream"]
            .iter()
            .any(|result| header.contains(&format!("static inline {result} {name}(")))
    };
    let words = header.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '(');
    let calls = words.filter_map(|word| word.split_once('(').map(|(name, _)| name));
    let mut names: Vec<String> = calls
        .filter(|name| name.starts_with("muslin_") && !is_inline(name))
        .map(String::from)
        .collect();
    names.sort_unstable();
    names.dedup();
    Ok(names)
}

/// The symbols that a library defines for others. With `is_prefixed` the platform puts `_` before
/// the names of C, which is left out.
pub fn defined(
    tools: &Binutils,
    library: &Path,
    options: &[&str],
    is_prefixed: bool,
) -> Result<Vec<Symbol>> {
    let mut nm = shell::command(&tools.nm);
    nm.args(["--print-file-name", "--quiet", "--extern-only", "--format=posix", "--defined-only"]);
    nm.args(options).arg(library);
    Ok(parse(&shell::output(&mut nm)?, is_prefixed))
}

/// The symbols in the output of `nm`, of lines such as `lib.a[member.o]: name T 0 4`.
fn parse(output: &str, is_prefixed: bool) -> Vec<Symbol> {
    let symbol = |line: &str| {
        let (place, rest) = line.rsplit_once(": ")?;
        let (_, member) =
            place.strip_suffix(']').and_then(|p| p.rsplit_once('[')).unwrap_or_default();
        let name = rest.split(' ').next()?;
        let name = if is_prefixed { name.strip_prefix('_').unwrap_or(name) } else { name };
        Some(Symbol { member: member.into(), name: name.into() })
    };
    output.lines().filter_map(symbol).collect()
}

/// Fails unless the names that a library exports are those that the header declares.
pub fn check(library: &Path, mut exported: Vec<String>) -> Result {
    exported.sort_unstable();
    let declared = declared()?;
    if exported == declared {
        return Ok(());
    }
    let without = |names: &[String], others: &[String]| -> Vec<String> {
        names.iter().filter(|name| !others.contains(name)).cloned().collect()
    };
    Err(Failure::new(format!(
        "{} does not export what muslin.h declares: it adds {:?} and lacks {:?}",
        library.display(),
        without(&exported, &declared),
        without(&declared, &exported)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_know_their_member_and_lose_the_underscore_of_the_platform() {
        let output = "/a/libmuslin.a[muslin-1.o]: _muslin_version T 0 4\n\
                      /a/libmuslin.a[muslin-1.o]: _rust_x S 8 0\n\
                      /a/libmuslin.a[other.o]: ___divti3 T 0 0\n";
        let symbols = parse(output, true);
        let names: Vec<_> = symbols.iter().map(|one| (&*one.member, &*one.name)).collect();
        let expected =
            [("muslin-1.o", "muslin_version"), ("muslin-1.o", "rust_x"), ("other.o", "__divti3")];
        assert_eq!(names, expected);
        let shared = parse("/a/libmuslin.so: muslin_a T 0\n", false);
        assert_eq!((&*shared[0].member, &*shared[0].name), ("", "muslin_a"));
    }

    #[test]
    fn a_missing_and_a_foreign_function_are_named() {
        let mut exported = declared().unwrap();
        check(Path::new("lib"), exported.clone()).unwrap();
        let last = exported.pop().unwrap();
        exported.push("rust_begin_unwind".into());
        let failure = check(Path::new("lib"), exported).unwrap_err().to_string();
        assert!(failure.contains(&last) && failure.contains("rust_begin_unwind"), "{failure}");
    }
}
