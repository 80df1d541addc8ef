//! The tests of the C library: its header is compiled alone, and every program written against it
//! runs, with valgrind too.

use std::path::Path;

use crate::c::{self, C, CPP, Language, Linking};
use crate::failure::{Failure, Result};
use crate::{abi, files, setup, shell};

/// Builds the library, and compiles and runs header, tests and examples.
pub fn check() -> Result {
    setup::ensure(&[&setup::CXX, &setup::VALGRIND])?;
    c::build()?;
    files::create_dir(&c::program_dir())?;
    check_header()?;
    check_wrapper()?;
    check_table()?;
    abi::check()?;
    let root = files::root();
    let mut sources = files::with_suffix(&root.join("tests/c"), ".c")?;
    // The examples in engines have a step of their own.
    sources.push(root.join("bindings/c/examples/hang.c"));
    sources.extend(files::with_suffix(&root.join("tests/c"), ".cpp")?);
    sources.iter().try_for_each(|source| check_program(source))?;
    check_recipe_for_unreal()
}

/// Compiles a program, and runs it linked statically, the same with valgrind and an argument that asks
/// for fewer ticks, and linked dynamically.
pub fn check_program(source: &Path) -> Result {
    let program = c::compile(source, Linking::Static)?;
    shell::run(&mut shell::command(&program))?;
    let mut valgrind = shell::command("valgrind");
    valgrind.args(["--quiet", "--error-exitcode=1", "--leak-check=full"]);
    shell::run(valgrind.arg(&program).arg("short"))?;
    let program = c::compile(source, Linking::Shared)?;
    shell::run(shell::command(&program).env("LD_LIBRARY_PATH", c::release_dir()))
}

/// Fails unless the header compiles in every standard without anything included before it.
fn check_header() -> Result {
    let newer =
        [Language { standard: "-std=c11", ..C }, Language { standard: "-std=c++20", ..CPP }];
    for language in [C, CPP].into_iter().chain(newer) {
        let source = c::program_dir().join("header").with_extension(language.extension);
        files::write(
            &source,
            "#include \"muslin.h\"\n#include \"muslin.h\"\nint main(void) { return 0; }\n",
        )?;
        for program in [language.compiler, language.second_compiler] {
            if program == language.compiler || shell::which(program).is_some() {
                let mut compiler = c::compiler(language, program);
                shell::run(compiler.arg("-fsyntax-only").arg(&source))?;
            }
        }
    }
    Ok(())
}

/// Fails unless the C++ wrapper has every function of a cloth and compiles without exceptions.
fn check_wrapper() -> Result {
    let root = files::root();
    let header = files::read(&root.join("include/muslin.h"))?;
    let wrapper = files::read(&root.join("include/muslin.hpp"))?;
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let calls = header.split("muslin_cloth_").skip(1).filter_map(|rest| rest.split_once('('));
    for (call, _) in calls.filter(|(call, _)| is_name(call)) {
        if !wrapper.contains(&format!("muslin_cloth_{call}(")) {
            return Err(Failure::new(format!("muslin.hpp lacks muslin_cloth_{call}")));
        }
    }
    let mut cc = c::compiler(CPP, CPP.compiler);
    cc.args(["-fno-exceptions", "-fsyntax-only"]);
    shell::run(cc.arg(root.join("tests/c/wrapper.cpp")))
}

/// Compiles the recipe for Unreal with test doubles of the engine's classes, without exceptions as
/// the engine does, and runs it.
fn check_recipe_for_unreal() -> Result {
    let root = files::root();
    let source = root.join("tests/unreal/tests.cpp");
    let program = c::program_dir().join("unreal");
    let mut cc = c::strict_compiler(&source);
    for folder in ["bindings/unreal", "tests/unreal/engine"] {
        cc.arg("-I").arg(root.join(folder));
    }
    cc.args(["-fno-exceptions", "-o"]).arg(&program).arg(&source);
    cc.arg(c::release_dir().join("libmuslin.a")).args(c::SYSTEM);
    shell::run(&mut cc)?;
    shell::run(&mut shell::command(&program))
}

/// Fails unless `tests/c/table.c` has a row for every argument of every function that can refuse.
fn check_table() -> Result {
    let header = files::read(&files::root().join("include/muslin.h"))?;
    let table = files::read(&files::root().join("tests/c/table.c"))?;
    let missing = required_rows(&abi::functions(&abi::without_comments(&header)))
        .into_iter()
        .find(|(function, argument)| !has_row(&table, function, argument));
    match missing {
        None => Ok(()),
        Some((function, argument)) => {
            Err(Failure::new(format!("tests/c/table.c has no row for `{argument}` of {function}")))
        }
    }
}

/// Function and argument, for each argument of each function that returns a status.
fn required_rows(functions: &[String]) -> Vec<(String, String)> {
    let calls = functions.iter().filter_map(|line| line.strip_prefix("MuslinStatus "));
    let split = calls.filter_map(|call| call.trim_end_matches(')').split_once('('));
    split
        .flat_map(|(function, arguments)| {
            let name = |one: &str| one.rsplit([' ', '*']).next().unwrap_or_default().to_owned();
            arguments.split(',').map(move |one| (function.to_owned(), name(one)))
        })
        .collect()
}

fn has_row(table: &str, function: &str, argument: &str) -> bool {
    let forms = [
        format!("ROW({function}, {argument},"),
        format!("ANY({function}, {argument})"),
        format!("REPORT({function}, "),
    ];
    let of_none = argument == "cloth" && table.contains(&format!("OF_NONE({function},"));
    of_none || forms.iter().any(|form| table.contains(form))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_argument_of_a_function_that_returns_a_status_needs_a_row() {
        let functions =
            ["uint32_t muslin_version(void)", "MuslinStatus muslin_x(MuslinCloth cloth, void *to)"];
        let rows = required_rows(&functions.map(String::from));
        let names: Vec<_> =
            rows.iter().map(|(function, to)| (function.as_str(), to.as_str())).collect();
        assert_eq!(names, [("muslin_x", "cloth"), ("muslin_x", "to")]);
        assert!(has_row("  OF_NONE(muslin_x, (none));", "muslin_x", "cloth"));
        assert!(has_row("  ROW(muslin_x, to, …", "muslin_x", "to"));
        assert!(!has_row("  ROW(muslin_x, to, …", "muslin_x", "too"));
    }
}
