//! The C library: how it is built, where it lies, and how programs for it are compiled.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::Result;
use crate::{files, shell};

const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
/// The system libraries that Rust's standard library needs.
pub const SYSTEM: [&str; 3] = ["-lm", "-lpthread", "-ldl"];

/// A language and its compilers.
#[derive(Clone, Copy)]
pub struct Language {
    /// The extension of its files.
    pub extension: &'static str,
    /// The option that selects the standard.
    pub standard: &'static str,
    /// The compiler that builds programs.
    pub compiler: &'static str,
    /// A second compiler, which checks headers where it is installed.
    pub second_compiler: &'static str,
}

/// C99.
pub const C: Language =
    Language { extension: "c", standard: "-std=c99", compiler: "cc", second_compiler: "clang" };

/// C++17.
pub const CPP: Language = Language {
    extension: "cpp",
    standard: "-std=c++17",
    compiler: "c++",
    second_compiler: "clang++",
};

/// How a program is linked with the library.
#[derive(Clone, Copy, PartialEq)]
pub enum Linking {
    /// The program holds `libmuslin.a`.
    Static,
    /// The program loads `libmuslin.so`.
    Shared,
}

/// Options of LLVM that make the library smaller and no slower:
/// - Functions that are called from several places are inlined less; the kernels carry inline
///   attributes of their own.
/// - Loops are unrolled less. With a threshold of 50, ticks take 3 to 6 % longer.
/// - Loops whose length is known only at run time are not unrolled. Vectorised loops still take
///   several vectors per iteration.
/// - Tail duplication copies shorter blocks only.
/// - Loops are aligned only where that takes at most 7 bytes.
const FLAGS: [&str; 5] = [
    "-inline-threshold=50",
    "-unroll-threshold=100",
    "-unroll-runtime=false",
    "-tail-dup-placement-aggressive-threshold=2",
    "-max-bytes-for-alignment=7",
];

/// The compiler's flags for the library, beside those of the profile.
pub fn compiler_flags() -> Result<Vec<String>> {
    let options = FLAGS.iter().flat_map(|flag| ["-C".into(), format!("llvm-args={flag}")]);
    Ok(options.chain(remapped_paths()?).collect())
}

/// The compiler's flags that leave the folders of this machine out of the messages of panics.
pub fn remapped_paths() -> Result<Vec<String>> {
    let paths = machine_paths()?;
    Ok(paths.iter().map(|(from, to)| format!("--remap-path-prefix={from}={to}")).collect())
}

/// Folders of this machine that messages of panics would name, each with the name that they give
/// instead. Without it they name the sources of Rust's library too, where these are installed.
pub fn machine_paths() -> Result<[(String, &'static str); 3]> {
    let sysroot = shell::output(shell::command("rustc").args(["--print", "sysroot"]))?;
    let home = std::env::var("HOME").unwrap_or_default();
    let cargo = std::env::var("CARGO_HOME").unwrap_or_else(|_| format!("{home}/.cargo"));
    let root = files::root().display().to_string();
    Ok([(cargo, "cargo"), (sysroot.trim().into(), "rust"), (root, "muslin")])
}

/// Builds the static and the shared library into `target/release`.
pub fn build() -> Result {
    let mut flags: Vec<String> =
        std::env::var("RUSTFLAGS").unwrap_or_default().split_whitespace().map(Into::into).collect();
    flags.extend(compiler_flags()?);
    let mut cargo = shell::cargo(&["build", "--release", "--package", "muslin-c"]);
    shell::run(cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f")))?;
    if cfg!(target_os = "linux") {
        let soname = concat!("libmuslin.so.", env!("CARGO_PKG_VERSION_MAJOR"));
        files::symlink("libmuslin.so", &release_dir().join(soname))?;
    }
    Ok(())
}

/// The folder of both libraries.
pub fn release_dir() -> PathBuf {
    files::target().join("release")
}

/// The folder of compiled test programs.
pub fn program_dir() -> PathBuf {
    files::target().join("c")
}

/// The compiler for a source file, by its extension: with debug information, and every warning an
/// error.
pub fn strict_compiler(source: &Path) -> Command {
    let language = language_of(source);
    let mut cc = compiler(language, language.compiler);
    cc.args(["-g", "-O1"]);
    cc
}

/// `program` as the compiler of a language, with every warning an error and the headers in its
/// path.
pub fn compiler(language: Language, program: &str) -> Command {
    let mut command = shell::command(program);
    command.arg(language.standard).args(STRICT).arg("-I").arg(files::root().join("include"));
    command
}

/// Compiles a program of one file and links it with the library; returns the program's path.
pub fn compile(source: &Path, linking: Linking) -> Result<PathBuf> {
    let language = language_of(source);
    let stem = source.file_stem().unwrap_or_default().to_string_lossy();
    let kind = if linking == Linking::Static { "static" } else { "shared" };
    let program = program_dir().join(format!("{stem}-{}-{kind}", language.extension));
    files::create_dir(&program_dir())?;
    let mut cc = strict_compiler(source);
    cc.arg("-o").arg(&program).arg(source);
    match linking {
        Linking::Static => cc.arg(release_dir().join("libmuslin.a")),
        Linking::Shared => cc.arg("-L").arg(release_dir()).arg("-lmuslin"),
    };
    shell::run(cc.args(SYSTEM))?;
    Ok(program)
}

fn language_of(source: &Path) -> Language {
    if source.extension().is_some_and(|extension| extension == "cpp") { CPP } else { C }
}
