//! Runs every block of code and every command that README.md shows.

use std::path::PathBuf;

use crate::failure::{During, Failure, Result};
use crate::{bench, c, c_tests, demo, files, js, npm, setup, shell};

/// A fenced block of code.
#[derive(Debug, PartialEq)]
struct Block {
    language: String,
    /// The line in README.md that its text starts at, from 1.
    line: usize,
    text: String,
}

/// Whether a step of the tests has this name.
pub type IsStep = fn(&str) -> bool;

/// Runs every block. Blocks of Rust are examples of the crate `muslin`, which step `rust` runs.
pub fn test(is_step: IsStep) -> Result {
    let blocks = blocks(&files::read(&files::root().join("README.md"))?)?;
    if blocks.is_empty() {
        return Err(Failure::new("README.md shows no code"));
    }
    let has = |language: &str| blocks.iter().any(|block| block.language == language);
    files::create_empty_dir(&scratch())?;
    if has("rust") {
        check_crate_includes_readme()?;
    }
    if has("c") {
        setup::ensure(&[&setup::CXX, &setup::VALGRIND])?;
        c::build()?;
    }
    if has("js") {
        js::build()?;
        js::install_for_tests()?;
    }
    for block in &blocks {
        println!("README.md line {}: {}", block.line, block.language);
        block.run(is_step).during(|| format!("README.md line {}", block.line))?;
    }
    Ok(())
}

fn scratch() -> PathBuf {
    files::target().join("readme")
}

fn check_crate_includes_readme() -> Result {
    let crate_page = files::read(&files::root().join("src/lib.rs"))?;
    if crate_page.contains("include_str!(\"../README.md\")") {
        return Ok(());
    }
    Err(Failure::new("src/lib.rs does not include README.md, so that no step runs its Rust code"))
}

/// The fenced blocks of a page.
fn blocks(page: &str) -> Result<Vec<Block>> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (at, line) in page.lines().enumerate() {
        match line.trim_start().strip_prefix("```") {
            Some(_) if open => open = false,
            Some(language) => {
                open = true;
                let language = language.trim().to_string();
                blocks.push(Block { language, line: at + 2, text: String::new() });
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
        return Err(Failure::new("the last block of README.md is not closed"));
    }
    Ok(blocks)
}

impl Block {
    fn run(&self, is_step: IsStep) -> Result {
        let name = format!("line-{}", self.line);
        match self.language.as_str() {
            // Step `rust` runs it, since the crate includes README.md.
            "rust" | "text" => Ok(()),
            "c" => {
                let source = scratch().join(name + ".c");
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
            "sh" => self.commands().try_for_each(|(line, command)| {
                run_command(command, is_step)
                    .during(|| format!("README.md line {line}: `{command}`"))
            }),
            other => Err(Failure::new(format!(
                "no test runs blocks of {other:?}; rust, c, js and sh are run, text is not code"
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
    let ["cargo", "xtask", rest @ ..] = words.as_slice() else {
        return Action::Shell;
    };
    match rest {
        ["test" | "check"] | ["test", "--all"] => Action::Tests,
        ["test", steps @ ..] if steps.iter().all(|step| is_step(step)) => Action::Tests,
        // Step `shot` tests what it prints without a display.
        ["demo"] => Action::Step("shot"),
        ["demo", "--web"] => Action::Step("web"),
        ["demo", "--shot", _file, options @ ..] => Action::Shot(options.to_vec()),
        ["js"] => Action::Step("js"),
        ["c"] => Action::Step("c"),
        ["package", "--js"] => Action::Step("clients"),
        ["examples"] => Action::Step("examples"),
        ["web" | "setup"] => Action::Chore(rest.to_vec()),
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
        Action::Shot(options) => demo::shoot(&scratch().join("shot.png"), &options),
        Action::Chore(words) => shell::run(&mut shell::xtask(&words)?),
        Action::Bench(tables) => {
            bench::run(&tables.into_iter().chain(["--test"]).map(String::from).collect::<Vec<_>>())
        }
        Action::Shell => shell::run(shell::command("sh").args(["-ec", command])),
        Action::Unknown => Err(Failure::new("no test runs this command")),
    }
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
        let blocks = blocks(PAGE).unwrap();
        assert_eq!(blocks.len(), 2);
        assert_eq!((blocks[0].language.as_str(), blocks[0].line), ("sh", 4));
        assert_eq!(blocks[1], Block { language: "c".into(), line: 11, text: "int x;\n".into() });
        let commands: Vec<_> = blocks[0].commands().collect();
        assert_eq!(commands, [(5, "cargo xtask test"), (6, "cc a.c")]);
    }

    #[test]
    fn an_unclosed_block_is_refused() {
        assert!(blocks("```sh\nls\n").is_err());
    }

    #[test]
    fn a_block_in_an_unknown_language_is_refused() {
        let block = Block { language: "cobol".into(), line: 1, text: String::new() };
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
        assert_eq!(action("cargo xtask bench node", is_step), Action::Bench(vec!["node"]));
        assert_eq!(action("cargo xtask fly", is_step), Action::Unknown);
        assert_eq!(action("cc -Iinclude a.c", is_step), Action::Shell);
    }
}
