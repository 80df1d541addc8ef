//! The C library: built, its header compiled alone, and everything written against it run.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{Failure, Result};
use crate::{abi, files, setup, shell};

const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
/// What Rust's standard library asks of the system.
const SYSTEM: [&str; 3] = ["-lm", "-lpthread", "-ldl"];

/// A language and who compiles it.
#[derive(Clone, Copy)]
struct Language {
    end: &'static str,
    standard: &'static str,
    compiler: &'static str,
    /// A second opinion, where it is installed.
    other: &'static str,
}

const C: Language = Language { end: "c", standard: "-std=c99", compiler: "cc", other: "clang" };
const CPP: Language =
    Language { end: "cpp", standard: "-std=c++17", compiler: "c++", other: "clang++" };

/// How a program finds the library.
#[derive(Clone, Copy, PartialEq)]
enum Linking {
    Static,
    Shared,
}

/// What is called from several places is woven into fewer of them than LLVM would: it is a tenth smaller then
/// and as fast, since kernels are told where they belong.
const FLAGS: &str = "-C llvm-args=-inline-threshold=50";

/// Builds the library.
pub fn build() -> Result {
    let mut cargo = shell::cargo(&["build", "--release", "--package", "muslin-c"]);
    let others = std::env::var("RUSTFLAGS").unwrap_or_default();
    shell::run(cargo.env("RUSTFLAGS", format!("{others} {FLAGS}")))?;
    if cfg!(target_os = "linux") {
        let soname = concat!("libmuslin.so.", env!("CARGO_PKG_VERSION_MAJOR"));
        files::link("libmuslin.so", &release().join(soname))?;
    }
    Ok(())
}

/// Builds the library, compiles header, tests and examples, and runs them, with valgrind too.
pub fn check() -> Result {
    setup::ensure(&[&setup::CXX, &setup::VALGRIND])?;
    build()?;
    files::make(&built())?;
    check_header()?;
    check_wrapper()?;
    check_table()?;
    abi::check()?;
    let root = files::root();
    let mut sources = files::ending(&root.join("tests/c"), ".c")?;
    // Those in engines have a step of their own.
    sources.push(root.join("bindings/c/examples/hang.c"));
    sources.extend(
        files::list(&root.join("tests/c"))?
            .into_iter()
            .filter(|f| f.extension().is_some_and(|end| end == "cpp")),
    );
    sources.iter().try_for_each(|source| check_program(source))
}

/// Compiles a program, links it both ways and runs it, with valgrind too.
pub fn check_program(source: &Path) -> Result {
    let program = compile(source, Linking::Static)?;
    shell::run(&mut shell::command(&program))?;
    let mut valgrind = shell::command("valgrind");
    valgrind.args(["--quiet", "--error-exitcode=1", "--leak-check=full"]);
    shell::run(valgrind.arg(&program))?;
    let program = compile(source, Linking::Shared)?;
    shell::run(shell::command(&program).env("LD_LIBRARY_PATH", release()))
}

/// Where the library is built.
pub fn release() -> PathBuf {
    files::target().join("release")
}

/// Where programs are built.
pub fn built() -> PathBuf {
    files::target().join("c")
}

/// Every argument of every function that can refuse has a row in `tests/c/table.c`.
fn check_table() -> Result {
    let header = files::read(&files::root().join("include/muslin.h"))?;
    let table = files::read(&files::root().join("tests/c/table.c"))?;
    let lacking = rows(&abi::functions(&abi::without_comments(&header)))
        .into_iter()
        .find(|(function, argument)| !has_row(&table, function, argument));
    match lacking {
        None => Ok(()),
        Some((function, argument)) => {
            Err(Failure::new(format!("tests/c/table.c has no row for `{argument}` of {function}")))
        }
    }
}

/// The rows that functions ask for: one for each argument of those that answer by a status.
fn rows(functions: &[String]) -> Vec<(String, String)> {
    let calls = functions.iter().filter_map(|line| line.strip_prefix("MuslinStatus "));
    let split = calls.filter_map(|call| call.trim_end_matches(')').split_once('('));
    split
        .flat_map(|(function, arguments)| {
            let last = |one: &str| one.rsplit([' ', '*']).next().unwrap_or_default().to_owned();
            arguments.split(',').map(move |one| (function.to_owned(), last(one)))
        })
        .collect()
}

fn has_row(table: &str, function: &str, argument: &str) -> bool {
    let ways = [
        format!("ROW({function}, {argument},"),
        format!("ANY({function}, {argument})"),
        format!("REPORT({function}, "),
    ];
    let of_none = argument == "cloth" && table.contains(&format!("OF_NONE({function},"));
    of_none || ways.iter().any(|way| table.contains(way))
}

/// The compiler for a program, with all that it may warn of being an error.
pub fn strict(source: &Path) -> Command {
    let language = language_of(source);
    let mut cc = compiler(language, language.compiler);
    cc.args(["-g", "-O1"]);
    cc
}

fn language_of(source: &Path) -> Language {
    if source.extension().is_some_and(|end| end == "cpp") { CPP } else { C }
}

fn compiler(language: Language, program: &str) -> Command {
    let mut command = shell::command(program);
    command.arg(language.standard).args(STRICT).arg("-I").arg(files::root().join("include"));
    command
}

/// The header asks for nothing that the program must include first.
fn check_header() -> Result {
    let newer =
        [Language { standard: "-std=c11", ..C }, Language { standard: "-std=c++20", ..CPP }];
    for language in [C, CPP].into_iter().chain(newer) {
        let source = built().join("header").with_extension(language.end);
        files::write(
            &source,
            "#include \"muslin.h\"\n#include \"muslin.h\"\nint main(void) { return 0; }\n",
        )?;
        for program in [language.compiler, language.other] {
            if program == language.compiler || shell::which(program).is_some() {
                shell::run(compiler(language, program).arg("-fsyntax-only").arg(&source))?;
            }
        }
    }
    Ok(())
}

/// The wrapper has every call on a cloth, and does without exceptions too.
fn check_wrapper() -> Result {
    let root = files::root();
    let (header, wrapper) = (
        files::read(&root.join("include/muslin.h"))?,
        files::read(&root.join("include/muslin.hpp"))?,
    );
    let calls = header.split("muslin_cloth_").skip(1).filter_map(|rest| rest.split_once('('));
    for (call, _) in calls.filter(|(call, _)| call.chars().all(|c| c.is_alphanumeric() || c == '_'))
    {
        if !wrapper.contains(&format!("muslin_cloth_{call}(")) {
            return Err(Failure::new(format!("muslin.hpp lacks muslin_cloth_{call}")));
        }
    }
    let mut cc = compiler(CPP, CPP.compiler);
    cc.args(["-fno-exceptions", "-fsyntax-only"]);
    shell::run(cc.arg(root.join("tests/c/wrapper.cpp")))
}

fn compile(source: &Path, linking: Linking) -> Result<PathBuf> {
    let language = language_of(source);
    let stem = source.file_stem().unwrap_or_default().to_string_lossy();
    let end = if linking == Linking::Static { "static" } else { "shared" };
    let program = built().join(format!("{stem}-{}-{end}", language.end));
    files::make(&built())?;
    let mut cc = strict(source);
    cc.arg("-o").arg(&program).arg(source);
    match linking {
        Linking::Static => cc.arg(release().join("libmuslin.a")),
        Linking::Shared => cc.arg("-L").arg(release()).arg("-lmuslin"),
    };
    shell::run(cc.args(SYSTEM))?;
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_argument_of_what_answers_by_a_status_asks_for_a_row() {
        let functions =
            ["uint32_t muslin_version(void)", "MuslinStatus muslin_x(MuslinCloth cloth, void *to)"];
        let asked = rows(&functions.map(String::from));
        let names: Vec<_> =
            asked.iter().map(|(function, to)| (function.as_str(), to.as_str())).collect();
        assert_eq!(names, [("muslin_x", "cloth"), ("muslin_x", "to")]);
        assert!(has_row("  OF_NONE(muslin_x, (none));", "muslin_x", "cloth"));
        assert!(has_row("  ROW(muslin_x, to, …", "muslin_x", "to"));
        assert!(!has_row("  ROW(muslin_x, to, …", "muslin_x", "too"));
    }
}
