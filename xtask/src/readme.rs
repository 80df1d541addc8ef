//! Runs every block of code and every command in the documents: README.md, CONTRIBUTING.md and all
//! pages under `docs`.
//!
//! | language | how a block is tested |
//! | --- | --- |
//! | `rust` | step `rust` runs it as an example of the crate, because `src/lib.rs` includes the page |
//! | `c`, `cpp` | compiled, linked both ways, run, and run under valgrind |
//! | `js` | run in node, with the npm package installed |
//! | `cs` | compiled with the binding of C#, and run with Mono |
//! | `py` | run with Python 3, with the wheel of the Python package installed |
//! | `gdscript` | step `godot` runs those of the page on Godot |
//! | `sh` | each command is run, or named as a step that runs it |
//! | `cmake` | each line is part of the CMake project that step `package` builds |
//! | `text` | not code |

use std::path::{Path, PathBuf};

use crate::demo::Build;
use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{bench, c, c_tests, csharp, demo, files, first_frames, js, npm, python, shell};

/// What running the blocks needs.
pub const NEEDS: &[&Need] =
    &[&setup::NODE, &setup::CXX, &setup::VALGRIND, &setup::EGL, &setup::PYTHON_VENV, &setup::MONO];

/// The page whose blocks of GDScript step `godot` runs.
pub const GODOT_PAGE: &str = "docs/manual/godot.md";

/// A fenced block of code.
#[derive(Debug, PartialEq)]
struct Block {
    language: String,
    /// The page that shows it, relative to the root of the repository.
    page: String,
    /// The line of the page that its text starts at, from 1.
    line: usize,
    text: String,
}

/// Whether a step of the tests has this name.
pub type IsStep = fn(&str) -> bool;

/// Runs every block of every page.
pub fn test(is_step: IsStep) -> Result {
    let mut blocks = Vec::new();
    for page in pages()? {
        let text = files::read(&files::root().join(&page))?;
        let found = blocks_of(&page, &text)?;
        if found.iter().any(|block| block.language == "rust") {
            check_crate_includes(&page)?;
        }
        blocks.extend(found);
    }
    let has = |languages: &[&str]| {
        blocks.iter().any(|block| languages.contains(&block.language.as_str()))
    };
    if !["README.md", "docs/"].iter().all(|from| blocks.iter().any(|b| b.page.starts_with(from))) {
        return Err(Failure::new("README.md or docs shows no code"));
    }
    first_frames::check()?;
    files::create_empty_dir(&scratch())?;
    if has(&["c", "cpp", "cs"]) {
        c::build()?;
    }
    if has(&["js"]) {
        js::build()?;
        js::install_for_tests()?;
    }
    if has(&["py"]) {
        python::install()?;
    }
    for block in &blocks {
        println!("{}: {}", block.place(), block.language);
        block.run(is_step).during(|| block.place())?;
    }
    Ok(())
}

/// README.md, CONTRIBUTING.md and all Markdown files under `docs`, relative to the root.
fn pages() -> Result<Vec<String>> {
    let mut pages = vec!["README.md".to_string(), "CONTRIBUTING.md".to_string()];
    let mut folders = vec!["docs".to_string()];
    while let Some(folder) = folders.pop() {
        for path in files::list(&files::root().join(&folder))? {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let relative = format!("{folder}/{name}");
            if path.is_dir() {
                folders.push(relative);
            } else if name.ends_with(".md") {
                pages.push(relative);
            }
        }
    }
    Ok(pages)
}

/// The blocks of a page in one language: the line of each and its text.
pub fn blocks_in(page: &str, language: &str) -> Result<Vec<(usize, String)>> {
    let blocks = blocks_of(page, &files::read(&files::root().join(page))?)?;
    let is_wanted = |block: &Block| block.language == language;
    Ok(blocks.into_iter().filter(is_wanted).map(|block| (block.line, block.text)).collect())
}

fn scratch() -> PathBuf {
    files::target().join("readme")
}

fn check_crate_includes(page: &str) -> Result {
    let root = files::read(&files::root().join("src/lib.rs"))?;
    if root.contains(&format!("include_str!(\"../{page}\")")) {
        return Ok(());
    }
    Err(Failure::new(format!("src/lib.rs does not include {page}, so no step runs its Rust code")))
}

/// The fenced blocks of a page.
fn blocks_of(page: &str, text: &str) -> Result<Vec<Block>> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (at, line) in text.lines().enumerate() {
        match line.trim_start().strip_prefix("```") {
            Some(_) if open => open = false,
            Some(language) => {
                open = true;
                blocks.push(Block {
                    language: language.trim().to_string(),
                    page: page.to_string(),
                    line: at + 2,
                    text: String::new(),
                });
            }
            None if open => {
                if let Some(block) = blocks.last_mut() {
                    block.text += line;
                    block.text.push('\n');
                }
            }
            None => {}
        }
    }
    if open {
        return Err(Failure::new(format!("the last block of {page} is not closed")));
    }
    Ok(blocks)
}

impl Block {
    fn place(&self) -> String {
        format!("{} line {}", self.page, self.line)
    }

    fn run(&self, is_step: IsStep) -> Result {
        let page = Path::new(&self.page).file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{page}-line-{}", self.line);
        match self.language.as_str() {
            "rust" | "text" => Ok(()),
            "gdscript" if self.page == GODOT_PAGE => Ok(()),
            "c" | "cpp" => {
                let source = scratch().join(format!("{name}.{}", self.language));
                files::write(&source, &self.text)?;
                c_tests::check_program(&source)
            }
            "js" => {
                let folder = npm::modules().join(".readme");
                files::create_dir(&folder)?;
                let source = folder.join(name + ".mjs");
                files::write(&source, &self.text)?;
                shell::run(shell::command("node").arg(source))
            }
            "py" => {
                let source = scratch().join(name + ".py");
                files::write(&source, &self.text)?;
                shell::run(shell::command(python::user_interpreter()).arg(source))
            }
            "cs" => {
                let source = scratch().join(name + ".cs");
                files::write(&source, &self.text)?;
                csharp::run_program(&source)
            }
            "cmake" => self.check_cmake(),
            "sh" => self.commands().try_for_each(|(line, command)| {
                run_command(command, is_step)
                    .during(|| format!("{} line {line}: `{command}`", self.page))
            }),
            other => Err(Failure::new(format!(
                "no test runs blocks of {other:?}; rust, c, cpp, js, cs, py, cmake and sh are \
                 tested, gdscript on {GODOT_PAGE}, text is not code"
            ))),
        }
    }

    /// Fails unless each line is a line of the CMake project that step `package` builds.
    fn check_cmake(&self) -> Result {
        let project = files::read(&files::root().join("tests/c/package/CMakeLists.txt"))?;
        let is_tested = |line: &str| line.is_empty() || project.lines().any(|one| one == line);
        match self.text.lines().find(|line| !is_tested(line)) {
            None => Ok(()),
            Some(line) => Err(Failure::new(format!(
                "{line:?} is no line of tests/c/package/CMakeLists.txt, so no test runs it"
            ))),
        }
    }

    /// The commands of a shell block, without prompts and comments, each with its line.
    fn commands(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().filter_map(|(at, line)| {
            let command = line.split(" #").next().unwrap_or(line).trim();
            let command = command.strip_prefix("$ ").unwrap_or(command);
            (!command.is_empty() && !command.starts_with('#')).then_some((self.line + at, command))
        })
    }
}

/// How a command of a shell block is run.
#[derive(Debug, PartialEq)]
enum Action<'a> {
    /// Another step of the tests runs it.
    Step(&'static str),
    /// It is a part of the tests, which are running.
    Tests,
    /// The demo draws a picture with these options.
    Shot(Vec<&'a str>),
    /// A chore of xtask.
    Chore(Vec<&'a str>),
    /// The benchmark with these tables, or with all, on small meshes.
    Bench(Vec<&'a str>),
    /// A command of the shell.
    Shell,
    /// No test can run it.
    Unknown,
}

fn action(command: &str, is_step: IsStep) -> Action<'_> {
    let words: Vec<_> = command.split_whitespace().collect();
    let rest = match words.as_slice() {
        ["cargo", "xtask", rest @ ..] => rest,
        // `c::build` has run this command for the blocks of C.
        ["cargo", "build", "--release", "--package", "muslin-c"] => return Action::Step("c"),
        _ => return Action::Shell,
    };
    match rest {
        ["test" | "check"] | ["test", "--all"] => Action::Tests,
        ["test", steps @ ..] if steps.iter().all(|step| is_step(step)) => Action::Tests,
        // Step `shot` tests what it prints without a display.
        ["demo"] => Action::Step("shot"),
        // Step `web` builds the page and serves it.
        ["demo", "--web"] | ["web"] => Action::Step("web"),
        ["demo", "--shot", _file, options @ ..] if demo::is_test_picture(options) => {
            Action::Step("shot")
        }
        ["demo", "--shot", _file, options @ ..] => Action::Shot(options.to_vec()),
        ["js"] => Action::Step("js"),
        ["c"] => Action::Step("c"),
        ["python"] => Action::Step("python"),
        ["package", "--js"] => Action::Step("clients"),
        ["dist", ..] => Action::Step("dist"),
        ["godot"] => Action::Step("godot"),
        ["examples"] => Action::Step("examples"),
        ["setup" | "manual-pictures" | "share-pictures"] => Action::Chore(rest.to_vec()),
        ["verify", "--short"] | ["validate", ..] => Action::Step("verify"),
        ["bench", tables @ ..] => Action::Bench(tables.to_vec()),
        _ => Action::Unknown,
    }
}

fn run_command(command: &str, is_step: IsStep) -> Result {
    match action(command, is_step) {
        Action::Step(step) => {
            println!("{command}: step {step} runs it");
            Ok(())
        }
        Action::Tests => {
            println!("{command}: the tests are running");
            Ok(())
        }
        Action::Shot(options) => demo::shoot(&scratch().join("shot.png"), &options, Build::Dev),
        Action::Chore(words) => shell::run(&mut shell::xtask(&words)?),
        Action::Bench(tables) => {
            bench::run(&tables.into_iter().chain(["--test"]).map(String::from).collect::<Vec<_>>())
        }
        Action::Shell => run_in_shell(command),
        Action::Unknown => Err(Failure::new("no test runs this command")),
    }
}

/// Runs a command in a shell.
fn run_in_shell(command: &str) -> Result {
    let mut shell = shell::command("sh");
    shell.args(["-ec", command]);
    shell::build_once(&mut shell);
    shell::run(&mut shell)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A page\n\n```sh\n# Look:\n$ cargo xtask test   # all\ncc a.c\n```\ntext\n\n```c\nint x;\n```\n";

    fn is_step(name: &str) -> bool {
        ["js", "web"].contains(&name)
    }

    #[test]
    fn blocks_know_their_language_and_line() {
        let blocks = blocks_of("page.md", PAGE).unwrap();
        assert_eq!(blocks.len(), 2);
        assert_eq!((blocks[0].language.as_str(), blocks[0].line), ("sh", 4));
        assert_eq!(blocks[1].place(), "page.md line 11");
        assert_eq!((blocks[1].language.as_str(), blocks[1].text.as_str()), ("c", "int x;\n"));
        let commands: Vec<_> = blocks[0].commands().collect();
        assert_eq!(commands, [(5, "cargo xtask test"), (6, "cc a.c")]);
    }

    #[test]
    fn an_unclosed_block_is_refused() {
        assert!(blocks_of("page.md", "```sh\nls\n").is_err());
    }

    #[test]
    fn a_block_in_an_unknown_language_is_refused() {
        let block = Block {
            language: "cobol".into(),
            page: "page.md".into(),
            line: 1,
            text: String::new(),
        };
        assert!(block.run(is_step).unwrap_err().to_string().contains("cobol"));
    }

    #[test]
    fn every_command_has_an_action_or_is_unknown() {
        for command in ["test", "test --all", "test js web", "check"] {
            assert_eq!(action(&format!("cargo xtask {command}"), is_step), Action::Tests);
        }
        assert_eq!(action("cargo xtask test rusty", is_step), Action::Unknown);
        assert_eq!(action("cargo xtask demo --web", is_step), Action::Step("web"));
        assert_eq!(
            action("cargo xtask demo --shot a.png --tear", is_step),
            Action::Shot(vec!["--tear"])
        );
        let strip = "cargo xtask demo --shot a.png --play cut --strip 5 --size 400x400";
        assert_eq!(action(strip, is_step), Action::Step("shot"));
        assert_eq!(action("cargo xtask bench node", is_step), Action::Bench(vec!["node"]));
        assert_eq!(action("cargo xtask verify --short", is_step), Action::Step("verify"));
        assert_eq!(action("cargo xtask dist aarch64-apple-ios", is_step), Action::Step("dist"));
        assert_eq!(action("cargo xtask godot", is_step), Action::Step("godot"));
        assert_eq!(action("cargo xtask fly", is_step), Action::Unknown);
        assert_eq!(action("cc -Iinclude a.c", is_step), Action::Shell);
    }
}
