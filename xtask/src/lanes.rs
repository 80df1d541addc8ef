//! Runs steps side by side, each in a process of its own.
//!
//! ```text
//! lane 1:  fmt | rust ───────────────────── | shot ── | clients | readme ──
//! lane 2:  bits ──────── | js ────── | fuzz ── | web ────── | frameworks ──
//! lane 3:  verify | clippy ───── | c ── |
//! ```
//! A lane that is free takes the first step left that writes nothing that a running step uses. There is
//! one lane more than there are processors, at most three, so that no processor is idle while a step waits
//! or runs in one thread. A step with a browser runs beside one other step only, since pages draw in real
//! time. A step's output goes to `target/steps/NAME.log` and is printed as a whole when the step ends. The
//! first failure ends the steps of the other lanes.

use std::fs::File;
use std::path::PathBuf;
use std::process::{Child, ExitStatus, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crate::failure::{During, Failure, Result};
use crate::steps::Step;
use crate::{files, shell};

/// How many steps run at once at most; each uses several processors by itself.
const LANES: usize = 3;
/// How many steps run at once at most if one of them needs a browser.
const LANES_WITH_BROWSER: usize = 2;

/// How a step ended.
pub struct Outcome {
    /// The step's name.
    pub name: &'static str,
    /// Wall time from its start to its end.
    pub time: Duration,
    /// Processor time of its processes, where the system tells it. Of two steps that end at the same
    /// moment the first may get the time of both.
    pub processor_time: Option<Duration>,
    /// Whether it passed.
    pub has_passed: bool,
}

/// A step that runs. Its process ends when its standard input is closed, as when this is dropped.
struct Running {
    step: &'static Step,
    start: Instant,
    stdin: Option<std::process::ChildStdin>,
}

/// Runs the steps up to the first that fails, and returns how each ended, in the order in which
/// they ended.
pub fn run(steps: &[&'static Step]) -> Result<Vec<Outcome>> {
    files::create_dir(&log_dir())?;
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let lanes = LANES.min(cores + 1);
    let since_epoch = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let run_name = format!("{}-{}", std::process::id(), since_epoch.as_millis());
    let (sender, ended) = mpsc::channel();
    let mut left = steps.to_vec();
    let mut running: Vec<Running> = Vec::new();
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut spent = shell::ended_children_time();
    loop {
        let has_failed = outcomes.iter().any(|outcome| !outcome.has_passed);
        while !has_failed && running.len() < lanes {
            let busy: Vec<_> = running.iter().map(|one| one.step).collect();
            let Some(at) = next(&left, &busy) else { break };
            let step = left.remove(at);
            println!("-- {}: started", step.name);
            let (mut child, start) = (start(step, &run_name)?, Instant::now());
            running.push(Running { step, start, stdin: child.stdin.take() });
            let sender = sender.clone();
            thread::spawn(move || {
                let status = child.wait();
                // Nobody receives it after an error elsewhere, when this process ends.
                sender.send((step.name, status)).ok();
            });
        }
        if running.is_empty() {
            return Ok(outcomes);
        }
        let (name, status) = ended.recv().during(|| "waiting for a step".into())?;
        let status = status.during(|| format!("waiting for step {name}"))?;
        if let Some(at) = running.iter().position(|one| one.step.name == name) {
            let one = running.remove(at);
            let until_now = shell::ended_children_time();
            let processor_time =
                until_now.zip(spent).map(|(now, before)| now.saturating_sub(before));
            spent = until_now;
            if has_failed {
                println!("-- {name}: stopped");
                continue;
            }
            outcomes.push(report(&one, status, processor_time)?);
            if !status.success() {
                running.iter_mut().for_each(|other| other.stdin = None);
            }
        }
    }
}

/// The first of `left` that may run beside all of `busy`.
fn next(left: &[&Step], busy: &[&'static Step]) -> Option<usize> {
    let is_crowded = busy.len() >= LANES_WITH_BROWSER;
    if is_crowded && busy.iter().any(|step| step.needs_browser()) {
        return None;
    }
    left.iter().position(|step| {
        let has_room = !(is_crowded && step.needs_browser());
        has_room && !busy.iter().any(|other| step.conflicts_with(other))
    })
}

fn log_dir() -> PathBuf {
    files::target().join("steps")
}

fn log_file(step: &Step) -> PathBuf {
    log_dir().join(step.name).with_extension("log")
}

/// Starts a step in a process group of its own, with its output in its log file. Steps of the same
/// `run` share the npm package.
fn start(step: &Step, run: &str) -> Result<Child> {
    let during = || format!("starting step {}", step.name);
    let log = File::create(log_file(step)).during(during)?;
    let mut command = shell::xtask(&["step", step.name])?;
    command.env(files::RUN, run);
    command.stdin(Stdio::piped()).stdout(log.try_clone().during(during)?).stderr(log);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command.spawn().during(during)
}

/// Prints the output of a step that has ended.
fn report(one: &Running, status: ExitStatus, processor_time: Option<Duration>) -> Result<Outcome> {
    let (step, time) = (one.step, one.start.elapsed());
    let log =
        std::fs::read(log_file(step)).during(|| format!("reading the log of {}", step.name))?;
    println!("\n== {}: {}\n{}", step.name, step.about, String::from_utf8_lossy(&log).trim_end());
    let verb = if status.success() { "passed" } else { "failed" };
    println!("== {} {verb} in {:.1} s\n", step.name, time.as_secs_f32());
    Ok(Outcome { name: step.name, time, processor_time, has_passed: status.success() })
}

/// Runs one step in this process, which ends with all processes that it started as soon as its
/// standard input is closed: when the run that started it has failed elsewhere or was interrupted.
pub fn run_step(step: &Step) -> Result {
    thread::spawn(|| {
        std::io::copy(&mut std::io::stdin(), &mut std::io::sink()).ok();
        end_process_group();
    });
    (step.run)()
}

fn end_process_group() {
    if cfg!(unix) {
        let group = format!("-{}", std::process::id());
        shell::succeeds("kill", &["-KILL", "--", &group]);
    }
    std::process::exit(1);
}

/// The failure of the step that failed, if one did.
pub fn failure(outcomes: &[Outcome]) -> Option<Failure> {
    let failed = outcomes.iter().find(|outcome| !outcome.has_passed)?;
    Some(Failure::new(format!("step {} failed", failed.name)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::STEPS;

    fn step(name: &str) -> &'static Step {
        STEPS.iter().find(|step| step.name == name).unwrap()
    }

    #[test]
    fn a_free_lane_passes_over_steps_that_write_what_a_running_step_writes() {
        let left = [step("shot"), step("c"), step("js")];
        assert_eq!(next(&left, &[]), Some(0));
        assert_eq!(next(&left, &[step("rust")]), Some(1));
        assert_eq!(next(&left, &[step("rust"), step("package")]), Some(2));
        assert_eq!(next(&left[..2], &[step("rust"), step("package")]), None);
    }

    #[test]
    fn a_step_with_a_browser_runs_beside_one_other_step_only() {
        let left = [step("web"), step("c")];
        assert_eq!(next(&left, &[step("rust")]), Some(0));
        assert_eq!(next(&left, &[step("rust"), step("clippy")]), Some(1));
        assert_eq!(next(&left[1..], &[step("rust"), step("examples")]), None);
    }

    #[test]
    fn steps_that_read_the_same_run_side_by_side_but_not_beside_the_one_that_writes_it() {
        let left = [step("page"), step("clients")];
        assert_eq!(next(&left, &[step("js")]), None);
        assert_eq!(next(&left, &[step("examples")]), Some(0));
        assert_eq!(next(&[step("js")], &[step("page")]), None);
    }
}
