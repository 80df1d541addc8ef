//! Running other programs, and saying so.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::failure::{During, Failure, Result};
use crate::files;

/// A command that runs in the repository.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(files::root()).stdin(Stdio::null());
    command
}

/// The cargo that runs this.
pub fn cargo(args: &[&str]) -> Command {
    let mut cargo = command(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(args);
    cargo
}

/// This program again, for another chore.
pub fn xtask(args: &[&str]) -> Result<Command> {
    let me = std::env::current_exe().during(|| "finding xtask itself".into())?;
    let mut command = command(me);
    command.args(args);
    Ok(command)
}

/// How a command is typed.
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

/// Shows the command and runs it to its end.
pub fn run(command: &mut Command) -> Result {
    let typed = typed(command);
    println!("$ {typed}");
    let status = command.status().during(|| format!("starting `{typed}`"))?;
    if status.success() {
        return Ok(());
    }
    Err(Failure::new(format!("`{typed}` failed ({status})")))
}

/// What a command prints, if it ends well.
pub fn output(command: &mut Command) -> Result<String> {
    let typed = typed(command);
    let done =
        command.stderr(Stdio::inherit()).output().during(|| format!("starting `{typed}`"))?;
    if !done.status.success() {
        return Err(Failure::new(format!("`{typed}` failed ({})", done.status)));
    }
    String::from_utf8(done.stdout).during(|| format!("reading what `{typed}` printed"))
}

/// Whether a command ends well; what it prints is nobody's business.
pub fn succeeds(program: &str, args: &[&str]) -> bool {
    let quiet = command(program).args(args).stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}

/// Where a program is.
pub fn which(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|dir| dir.join(program)).find(|file| file.is_file())
}
