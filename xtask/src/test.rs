//! The commands that run tests: `test`, `check`, and `setup`, which installs what they need.

use std::time::{Duration, Instant};

use crate::failure::{During, Failure, Result};
use crate::lanes::{self, Outcome};
use crate::setup::{self, Need};
use crate::steps::{STEPS, Step};
use crate::{bits, npm, python, rust, shell, tools};

/// The option that adds the steps that take long and rarely find anything.
const ALL: &str = "--all";

/// `cargo xtask test`: runs the default steps, those that are named, or with `--all` all of them.
pub fn run(words: &[String]) -> Result {
    let steps = chosen(words)?;
    setup::ensure(&needs(&steps))?;
    let start = Instant::now();
    let outcomes = match steps.as_slice() {
        [step] => vec![run_alone(step)?],
        steps => lanes::run(steps)?,
    };
    println!("{}", summary(&outcomes, start.elapsed()));
    if let Some(failure) = lanes::failure(&outcomes) {
        return Err(failure);
    }
    if words.is_empty() {
        let left_out: Vec<_> =
            STEPS.iter().filter(|step| !step.is_default).map(|step| step.name).collect();
        println!("not run: {}; `cargo xtask test {ALL}` runs them", left_out.join(", "));
    }
    Ok(())
}

/// `cargo xtask step`: runs one step as a part of a run that prints its output later.
pub fn run_step(words: &[String]) -> Result {
    match chosen(words)?.as_slice() {
        [step] => lanes::run_step(step),
        _ => Err(Failure::new("`cargo xtask step` takes the name of one step")),
    }
}

/// `cargo xtask check`: what can be tested in a few minutes while one works on the library.
pub fn check(words: &[String]) -> Result {
    if let Some(word) = words.first() {
        return Err(Failure::new(format!("`cargo xtask check` takes no {word:?}")));
    }
    let start = Instant::now();
    let mut outcomes = Vec::new();
    for (name, run) in rust::CHECKS {
        let start = Instant::now();
        println!("\n== {name}");
        run().during(|| format!("check {name}"))?;
        let time = start.elapsed();
        outcomes.push(Outcome { name, time, processor_time: None, has_passed: true });
    }
    println!("{}", summary(&outcomes, start.elapsed()));
    Ok(())
}

/// `cargo xtask setup`: installs what the steps need, or with `--list` says what is missing.
pub fn prepare(words: &[String]) -> Result {
    let needs = needs(&STEPS.iter().collect::<Vec<_>>());
    match words {
        [] => {
            setup::ensure(&needs)?;
            setup::ensure_component("fmt", "rustfmt")?;
            setup::ensure_component("clippy", "clippy")?;
            bits::ensure_targets()?;
            tools::install()?;
            python::install_tools()?;
            npm::install()
        }
        [list] if list == "--list" => {
            setup::print_state(&needs);
            Ok(())
        }
        _ => Err(Failure::new("`cargo xtask setup` takes only --list")),
    }
}

/// Runs a step in this process, with its output as it comes.
fn run_alone(step: &Step) -> Result<Outcome> {
    println!("\n== {}: {}", step.name, step.about);
    let start = Instant::now();
    (step.run)().during(|| format!("step {}", step.name))?;
    let (time, processor_time) = (start.elapsed(), shell::ended_children_time());
    Ok(Outcome { name: step.name, time, processor_time, has_passed: true })
}

/// The steps that the words ask for, in the order of [`STEPS`].
fn chosen(words: &[String]) -> Result<Vec<&'static Step>> {
    let is_all = |word: &str| word == ALL;
    let is_unknown = |word: &&String| !is_all(word) && !STEPS.iter().any(|s| s.name == **word);
    if let Some(unknown) = words.iter().find(is_unknown) {
        let names = STEPS.iter().map(|step| step.name).collect::<Vec<_>>().join(", ");
        return Err(Failure::new(format!("there is no step {unknown:?}; the steps are {names}")));
    }
    let is_wanted = |step: &&Step| {
        let is_named = words.iter().any(|word| word == step.name || is_all(word));
        is_named || words.is_empty() && step.is_default
    };
    Ok(STEPS.iter().filter(is_wanted).collect())
}

/// What the steps need, each once.
fn needs(steps: &[&Step]) -> Vec<&'static Need> {
    let mut needs: Vec<&Need> = Vec::new();
    for need in steps.iter().flat_map(|step| step.needs) {
        if !needs.iter().any(|known| known.name == need.name) {
            needs.push(need);
        }
    }
    needs
}

/// Two lines: the wall time of the whole and of each part, with the processor time in parentheses,
/// and how many passed and failed.
fn summary(outcomes: &[Outcome], whole: Duration) -> String {
    let part = |one: &Outcome| {
        let processor = one.processor_time.map(|time| format!(" ({:.0})", time.as_secs_f32()));
        format!("{} {:.0} s{}", one.name, one.time.as_secs_f32(), processor.unwrap_or_default())
    };
    let parts: Vec<_> = outcomes.iter().map(part).collect();
    let passed = outcomes.iter().filter(|one| one.has_passed).count();
    let failed = outcomes.len() - passed;
    let seconds = whole.as_secs_f32();
    format!("\n{seconds:.0} s in all: {}\n{passed} passed, {failed} failed", parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    fn names(words: &[&str]) -> Vec<&'static str> {
        let words: Vec<_> = words.iter().map(|word| String::from(*word)).collect();
        chosen(&words).unwrap().iter().map(|step| step.name).collect()
    }

    #[test]
    fn steps_run_in_their_own_order_whatever_the_order_of_their_names() {
        assert_eq!(names(&["js", "fmt"]), ["fmt", "js"]);
    }

    #[test]
    fn long_steps_run_by_name_or_with_all() {
        assert!(!names(&[]).contains(&"engines") && names(&[]).contains(&"readme"));
        assert_eq!(names(&["engines"]), ["engines"]);
        assert_eq!(names(&["--all"]).len(), STEPS.len());
    }

    #[test]
    fn an_unknown_step_is_refused_by_name() {
        let failure = chosen(&["rusty".into()]).err().unwrap().to_string();
        assert!(failure.contains("\"rusty\"") && failure.contains("readme"), "{failure}");
    }

    #[test]
    fn the_summary_names_each_part_and_counts_failures() {
        let outcome = |name, seconds, processor_time, has_passed| Outcome {
            name,
            time: Duration::from_secs(seconds),
            processor_time,
            has_passed,
        };
        let a = outcome("a", 61, Some(Duration::from_secs(99)), true);
        let text = summary(&[a, outcome("b", 5, None, false)], Duration::from_secs(63));
        assert_eq!(text, "\n63 s in all: a 61 s (99), b 5 s\n1 passed, 1 failed");
    }

    #[test]
    fn ci_runs_the_same_command_as_a_person() {
        let script = files::read(&files::root().join(".ci/run")).unwrap();
        assert!(script.lines().any(|line| line == "cargo xtask test"), "{script}");
    }
}
