//! The binding of C#: writes it from the header, and tests it with Mono.
//!
//! ```text
//! muslin.h ──▶ bindings/csharp/Muslin.cs ─┬─▶ target/csharp/binding.exe  tests/csharp
//!                                         ├─▶ target/csharp/unity.exe    the example, with test doubles of Unity
//!                                         └─▶ target/csharp/unreal.exe   Muslin.Build.cs of the recipe for Unreal
//! ```

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::Result;
use crate::setup::{self, Need};
use crate::{c, files, shell};

/// What writing and testing the binding needs.
pub const NEEDS: &[&Need] = &[&setup::CXX, &setup::MONO, &setup::PYTHON];

/// The programs of the tests, each with the folders and files that it is compiled from.
const PROGRAMS: [(&str, &[&str]); 3] = [
    ("binding", &[BINDING, "tests/csharp/Tests.cs"]),
    ("unity", &[BINDING, "bindings/csharp/examples/unity", "tests/csharp/unity"]),
    ("unreal", &["bindings/unreal/Muslin.Build.cs", "tests/csharp/unreal"]),
];

const BINDING: &str = "bindings/csharp/Muslin.cs";

/// Fails where the binding differs from the header, and runs its tests. With `MUSLIN_BLESS` set,
/// writes the binding.
pub fn test() -> Result {
    let root = files::root();
    let is_writing = std::env::var_os("MUSLIN_BLESS").is_some();
    let mut python = shell::command("python3");
    python.env("PYTHONDONTWRITEBYTECODE", "1");
    python.arg(root.join("bindings/csharp/tools/write_binding.py"));
    shell::run(python.args(is_writing.then_some("--write")))?;
    c::build()?;
    for (name, sources) in PROGRAMS {
        let sources = sources.iter().map(|source| root.join(source));
        let program = compile(name, sources)?;
        let inputs = ["include/muslin.abi", "tests/script.hash"].map(|file| root.join(file));
        shell::run(mono(&program).args(inputs.iter().filter(|_| name == "binding")))?;
    }
    Ok(())
}

/// Compiles a program of one file with the binding, and runs it with the C library, which is built.
pub fn run_program(source: &Path) -> Result {
    let name = source.file_stem().unwrap_or_default().to_string_lossy();
    let program = compile(&name, [files::root().join(BINDING), source.into()].into_iter())?;
    shell::run(&mut mono(&program))
}

/// The runtime with a program, and with the shared library in its path.
fn mono(program: &Path) -> Command {
    let mut mono = shell::command("mono");
    mono.arg("--debug").arg(program).env("LD_LIBRARY_PATH", c::release_dir());
    mono
}

/// Compiles a program of files and folders, with every warning an error, and returns its path.
fn compile(name: &str, sources: impl Iterator<Item = PathBuf>) -> Result<PathBuf> {
    let dir = files::target().join("csharp");
    files::create_dir(&dir)?;
    let program = dir.join(name).with_extension("exe");
    let mut mcs = shell::command("mcs");
    mcs.args(["-unsafe", "-debug", "-warnaserror"]).arg(format!("-out:{}", program.display()));
    for path in sources {
        mcs.args(if path.is_dir() { files::with_suffix(&path, ".cs")? } else { vec![path] });
    }
    shell::run(&mut mcs)?;
    Ok(program)
}
