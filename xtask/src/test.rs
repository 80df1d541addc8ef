//! Every test, in steps that have names.

use std::time::{Duration, Instant};

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{
    bits, c, clients, demo, engines, examples, fuzz, js, npm, package, readme, shell, tools, wasm,
    web,
};

/// A part of the tests.
struct Step {
    name: &'static str,
    about: &'static str,
    needs: &'static [&'static Need],
    run: fn() -> Result,
}

const STEPS: &[Step] = &[
    Step { name: "fmt", about: "Rust is formatted", needs: &[], run: fmt },
    Step { name: "clippy", about: "no lint has anything to say", needs: &[], run: clippy },
    Step {
        name: "rust",
        about: "tests and examples in Rust, debug",
        needs: &[&setup::EGL],
        run: rust,
    },
    Step {
        name: "bits",
        about: "the same bits in release, in wasm, on other processors",
        needs: bits::NEEDS,
        run: bits::test,
    },
    Step {
        name: "c",
        about: "header, tests and examples in C and C++",
        needs: &[&setup::CXX, &setup::VALGRIND],
        run: c::check,
    },
    Step {
        name: "fuzz",
        about: "the C library in any order with any arguments",
        needs: fuzz::NEEDS,
        run: fuzz::test,
    },
    Step {
        name: "engines",
        about: "the examples of the C library in engines, and their pictures",
        needs: engines::NEEDS,
        run: engines::test,
    },
    Step {
        name: "package",
        about: "the C library as others install it",
        needs: package::NEEDS,
        run: package::test,
    },
    Step { name: "js", about: "the npm package in node", needs: &[&setup::NODE], run: js::test },
    Step {
        name: "page",
        about: "the npm package in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        run: js::test_page,
    },
    Step {
        name: "clients",
        about: "the npm package as others install it: a page, Vite, webpack, node",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        run: clients::test,
    },
    Step {
        name: "examples",
        about: "the npm package's example pages in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        run: examples::test,
    },
    Step {
        name: "web",
        about: "the demo's page in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        run: web::test,
    },
    Step { name: "shot", about: "the demo's picture", needs: &[&setup::EGL], run: demo::test_shot },
    Step {
        name: "readme",
        about: "what README.md shows",
        needs: &[&setup::NODE, &setup::CXX, &setup::VALGRIND, &setup::EGL],
        run: readme::test,
    },
];

/// Runs all steps, or those that are named, up to the first that fails.
pub fn run(names: &[String]) -> Result {
    let steps = chosen(names)?;
    setup::ensure(&needs(&steps))?;
    let start = Instant::now();
    let mut times = Vec::new();
    for step in &steps {
        println!("\n== {}: {}", step.name, step.about);
        let start = Instant::now();
        let done = (step.run)();
        times.push((step.name, start.elapsed()));
        if done.is_err() {
            let passed = times.len() - 1;
            println!("{}\n{passed} passed, 1 failed", summary(&times, start.elapsed()));
            return done.during(|| format!("step {}", step.name));
        }
        println!("== {} passed in {:.1} s", step.name, start.elapsed().as_secs_f32());
    }
    println!("{}\n{} passed, 0 failed", summary(&times, start.elapsed()), steps.len());
    Ok(())
}

/// Installs what the steps need, or with `--list` only says what is missing.
pub fn prepare(options: &[String]) -> Result {
    let needs = needs(&STEPS.iter().collect::<Vec<_>>());
    match options {
        [] => {
            setup::ensure(&needs)?;
            setup::ensure_component("fmt", "rustfmt")?;
            setup::ensure_component("clippy", "clippy")?;
            bits::ensure_targets()?;
            tools::install()?;
            npm::install()
        }
        [list] if list == "--list" => {
            setup::tell(&needs);
            Ok(())
        }
        _ => Err(Failure::new("`cargo xtask setup` takes only --list")),
    }
}

/// The steps of these names, in the order in which they run; all of them for none.
fn chosen(names: &[String]) -> Result<Vec<&'static Step>> {
    let known = |name: &&String| !STEPS.iter().any(|step| step.name == name.as_str());
    if let Some(unknown) = names.iter().find(known) {
        let all = STEPS.iter().map(|step| step.name).collect::<Vec<_>>().join(", ");
        return Err(Failure::new(format!("there is no step {unknown:?}; the steps are {all}")));
    }
    let wanted = |step: &&Step| names.is_empty() || names.iter().any(|name| name == step.name);
    Ok(STEPS.iter().filter(wanted).collect())
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

fn summary(times: &[(&str, Duration)], all: Duration) -> String {
    let steps: Vec<_> =
        times.iter().map(|(name, time)| format!("{name} {:.0} s", time.as_secs_f32())).collect();
    format!("\n{} in all: {}", format_args!("{:.0} s", all.as_secs_f32()), steps.join(", "))
}

fn fmt() -> Result {
    setup::ensure_component("fmt", "rustfmt")?;
    shell::run(&mut shell::cargo(&["fmt", "--all", "--check"]))?;
    // A workspace of its own, so that nobody resolves an engine who wants a cloth.
    let bevy = "--manifest-path=bindings/bevy/Cargo.toml";
    shell::run(&mut shell::cargo(&["fmt", bevy, "--check"]))
}

fn clippy() -> Result {
    setup::ensure_component("clippy", "clippy")?;
    setup::ensure_target(wasm::TARGET)?;
    let deny = ["--", "-D", "warnings"];
    shell::run(shell::cargo(&["clippy", "--workspace", "--all-targets"]).args(deny))?;
    let threads = ["clippy", "--all-targets", "--package=muslin", "--package=muslin-golden"];
    let features = ["--features", "muslin/parallel,muslin-golden/parallel"];
    shell::run(shell::cargo(&threads).args(features).args(deny))?;
    let mut web = shell::cargo(&["clippy", "--lib", "--target", wasm::TARGET]);
    web.args(["muslin-js", "muslin-demo", "muslin-plain"].map(|name| format!("--package={name}")));
    shell::run(web.args(deny))
}

/// A snapshot that differs is a failure, never a new snapshot.
fn rust() -> Result {
    shell::run(shell::cargo(&["test", "--workspace"]).env("INSTA_UPDATE", "no"))
}

/// What README.md may name as `cargo xtask test …`.
pub fn is_step(name: &str) -> bool {
    STEPS.iter().any(|step| step.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    #[test]
    fn steps_run_in_their_order_whatever_the_names_order() {
        let names = ["js", "fmt"].map(String::from);
        let steps: Vec<_> = chosen(&names).unwrap().iter().map(|step| step.name).collect();
        assert_eq!(steps, ["fmt", "js"]);
        assert_eq!(chosen(&[]).unwrap().len(), STEPS.len());
    }

    #[test]
    fn an_unknown_step_is_named() {
        let failure = chosen(&["rusty".into()]).err().unwrap().to_string();
        assert!(failure.contains("\"rusty\"") && failure.contains("readme"), "{failure}");
    }

    #[test]
    fn ci_runs_the_same_command_as_a_person() {
        let script = files::read(&files::root().join(".ci/run")).unwrap();
        assert!(script.lines().any(|line| line == "cargo xtask test"), "{script}");
    }
}
