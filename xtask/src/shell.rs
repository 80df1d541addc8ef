//! Runs other programs, and prints the command lines of those that matter.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::failure::{During, Failure, Result};
use crate::files;

/// A command that runs in the root of the repository, without input.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(files::root()).stdin(Stdio::null());
    command
}

/// The cargo that runs this program, in CI with the settings of [`build_once`].
pub fn cargo(args: &[&str]) -> Command {
    let mut cargo = command(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    build_once(cargo.args(args));
    cargo
}

/// The environment variables with which cargo builds in CI, where nothing is built twice and no
/// debugger runs: no incremental builds, no line numbers in backtraces (the message of a panic still
/// names its line), and each crate in one piece, which the compiler optimises in less time and better.
const ONCE: [(&str, &str); 3] = [
    ("CARGO_INCREMENTAL", "0"),
    ("CARGO_PROFILE_DEV_DEBUG", "0"),
    ("CARGO_PROFILE_DEV_CODEGEN_UNITS", "1"),
];

/// Sets the variables of [`ONCE`] in CI, unless they are set. All cargo commands of a run must agree
/// on them, or cargo builds every crate once with them and once without.
pub fn build_once(command: &mut Command) {
    if std::env::var_os("CI").is_some() {
        for (name, value) in ONCE.into_iter().filter(|(name, _)| std::env::var_os(name).is_none()) {
            command.env(name, value);
        }
    }
}

/// This program with other arguments.
pub fn xtask(args: &[&str]) -> Result<Command> {
    let me = std::env::current_exe().during(|| "finding xtask itself".into())?;
    let mut command = command(me);
    command.args(args);
    Ok(command)
}

/// A command as a person types it, with paths below the root of the repository.
pub fn typed(command: &Command) -> String {
    let root = files::root().display().to_string() + "/";
    let word = |word: &std::ffi::OsStr| {
        let word = word.to_string_lossy().replace(&root, "");
        if word.contains(' ') { format!("'{word}'") } else { word }
    };
    let program = PathBuf::from(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str());
    std::iter::once(name).chain(command.get_args()).map(word).collect::<Vec<_>>().join(" ")
}

/// The shortest time of a command whose times are printed.
const LONG: Duration = Duration::from_secs(5);

/// Prints a command and runs it to its end, and prints its times if it took long.
///
/// # Errors
/// Fails if the command cannot start or ends with another status than success.
pub fn run(command: &mut Command) -> Result {
    let typed = typed(command);
    println!("$ {typed}");
    let (start, before) = (Instant::now(), ended_children_time());
    let status = command.status().during(|| format!("starting `{typed}`"))?;
    let (time, processor_time) = (start.elapsed(), ended_children_time().zip(before));
    if let Some((now, before)) = processor_time.filter(|_| time >= LONG) {
        let processor_time = now.saturating_sub(before).as_secs_f32();
        println!("{:.0} s ({processor_time:.0} s of processor time)", time.as_secs_f32());
    }
    if status.success() {
        return Ok(());
    }
    Err(Failure::new(format!("`{typed}` failed ({status})")))
}

/// Returns the processor time of all processes that this one has waited for, and of those that they have
/// waited for; `None` where the system does not tell it.
pub fn ended_children_time() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The program's name, in parentheses, may contain spaces. Fields 16 and 17 are in units of 10 ms.
    let fields: Vec<_> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: u64 = fields.get(13..15)?.iter().filter_map(|field| field.parse::<u64>().ok()).sum();
    Some(Duration::from_millis(10 * ticks))
}

/// Runs a command and returns its standard output.
///
/// # Errors
/// Fails as [`run`] does, and if the output is no UTF-8.
pub fn output(command: &mut Command) -> Result<String> {
    let typed = typed(command);
    let done =
        command.stderr(Stdio::inherit()).output().during(|| format!("starting `{typed}`"))?;
    if !done.status.success() {
        return Err(Failure::new(format!("`{typed}` failed ({})", done.status)));
    }
    String::from_utf8(done.stdout).during(|| format!("reading the output of `{typed}`"))
}

/// Whether a command succeeds; its output is dropped.
pub fn succeeds(program: &str, args: &[&str]) -> bool {
    let status = command(program).args(args).stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

/// The path of an installed program; none if `PATH` does not have it.
pub fn which(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|dir| dir.join(program)).find(|file| file.is_file())
}
