//! Fuzzing of the C library: `tests/c/fuzz` makes calls of whatever bytes libFuzzer comes up with, guided by the
//! parts of the library that they reach, under the address sanitizer.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{c, files, shell, sources};

/// What it needs.
pub const NEEDS: &[&Need] = &[&setup::CXX];

/// The target whose sanitizers come with Rust.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// How many programs of calls a run of the tests tries, the seeds included; by the same chances each time, so that
/// it ends alike on the same library. `cargo xtask fuzz` tries new ones.
const RUNS: &str = "-runs=600";
const CHANCES: &str = "-seed=1";
/// A mistake made on purpose is found within so many, …
const PLANTED_RUNS: &str = "-runs=20000";
/// … and all that takes no longer than this [s].
const SECONDS: u32 = 600;
/// What `cargo xtask fuzz` runs if it is not told how long [s].
const LONG: u32 = 3600;

/// What LLVM adds to the library, so that libFuzzer sees which parts of it ran.
const COVERAGE: [&str; 4] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=3",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
];

/// Tries the seeds, fuzzes on from them for a while, and finds a mistake that is there on purpose.
pub fn test() -> Result {
    let program = build("fuzz", &[])?;
    let found = dir().join("found");
    files::make_empty(&found)?;
    let mut fuzz = fuzzer(&program, SECONDS);
    shell::run(fuzz.args([RUNS, CHANCES]).arg(&found).arg(seeds()))?;
    find_planted()
}

/// Fuzzes for so many seconds, an hour if that is not said; what is found is kept in `target/fuzz/corpus`.
pub fn run(options: &[String]) -> Result {
    let seconds = match options {
        [] => LONG,
        [number] => number.parse().during(|| "cargo xtask fuzz takes seconds".into())?,
        _ => return Err(Failure::new("`cargo xtask fuzz` takes seconds and nothing else")),
    };
    let program = build("fuzz", &[])?;
    let corpus = dir().join("corpus");
    files::make(&corpus)?;
    shell::run(fuzzer(&program, seconds).arg(&corpus).arg(seeds()))
}

fn dir() -> PathBuf {
    files::target().join("fuzz")
}

fn seeds() -> PathBuf {
    files::root().join("tests/c/fuzz/seeds")
}

fn fuzzer(program: &Path, seconds: u32) -> Command {
    let mut fuzz = shell::command(program);
    fuzz.env("ASAN_OPTIONS", "malloc_context_size=4:quarantine_size_mb=32");
    fuzz.arg(format!("-max_total_time={seconds}")).args([
        "-max_len=1536",
        "-len_control=0",
        "-entropic=0",
        "-reload=0",
        "-timeout=60",
        "-malloc_limit_mb=600",
        "-rss_limit_mb=3000",
        "-print_funcs=0",
        "-print_pcs=0",
    ]);
    fuzz.arg(format!("-artifact_prefix={}/", dir().display()));
    fuzz
}

/// A buffer that is smaller than it is said to be is found by the fuzzer, or it finds nothing at all.
fn find_planted() -> Result {
    let program = build("planted", &["-DPLANTED"])?;
    let found = dir().join("found");
    files::make_empty(&found)?;
    let mut fuzz = fuzzer(&program, SECONDS);
    fuzz.args([PLANTED_RUNS, CHANCES]);
    let told = fuzz.arg(&found).arg(seeds()).output().during(|| "starting the fuzzer".into())?;
    let told = String::from_utf8_lossy(&told.stderr).into_owned();
    let seen = told.contains("heap-buffer-overflow") && told.contains("call_write_vertices");
    if !seen {
        return Err(Failure::new("the fuzzer does not see a buffer that is too small"));
    }
    println!("the fuzzer found what was planted");
    Ok(())
}

/// Links the calls with the library and the fuzzer.
fn build(name: &str, flags: &[&str]) -> Result<PathBuf> {
    let library = library("address", &COVERAGE, &[])?;
    let engine = engine()?;
    let (object, program) = (dir().join(name).with_extension("o"), dir().join(name));
    let source = files::root().join("tests/c/fuzz/fuzz.c");
    let mut cc = c::strict(&source);
    shell::run(cc.args(flags).arg("-c").arg(&source).arg("-o").arg(&object))?;
    let mut link = shell::command("c++");
    link.arg("-o").arg(&program).arg(&object).arg(&library).arg(&engine);
    shell::run(link.args(runtime("asan")?).args(["-lm", "-lpthread", "-ldl"]))?;
    Ok(program)
}

/// The static library with a sanitizer in it, and with checks and assertions; `more` is for cargo.
pub fn library(sanitizer: &str, flags: &[&str], more: &[&str]) -> Result<PathBuf> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err(Failure::new("Rust brings its sanitizers for Linux on x86-64 only"));
    }
    let built = files::target().join(sanitizer);
    let mut cargo = shell::cargo(&["build", "--profile=sanitized", "--package=muslin-c"]);
    cargo.arg("--target").arg(TARGET).arg("--target-dir").arg(&built).args(more);
    let flags: Vec<&str> = flags.iter().copied().chain(["-Cforce-frame-pointers=yes"]).collect();
    // Sanitizers are not a stable part of the compiler; they are there in every one.
    cargo.env("RUSTC_BOOTSTRAP", "1").env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo.env("RUSTFLAGS", format!("-Zsanitizer={sanitizer} {}", flags.join(" ")));
    shell::run(&mut cargo)?;
    Ok(built.join(TARGET).join("sanitized/libmuslin.a"))
}

/// What the linker needs for a sanitizer's own library.
pub fn runtime(name: &str) -> Result<Vec<String>> {
    let mut rustc = shell::command("rustc");
    let dir = shell::output(rustc.args(["--print", "target-libdir", "--target", TARGET]))?;
    let found = files::ending(Path::new(dir.trim()), &format!("_rt.{name}.a"))?;
    let whole = ["-Wl,--whole-archive", "-Wl,--no-whole-archive"].map(String::from);
    let [before, after] = whole;
    Ok(vec![before, found[0].display().to_string(), after])
}

/// libFuzzer, compiled once.
fn engine() -> Result<PathBuf> {
    let (sources, objects) = (sources::LIBFUZZER.fetch()?, dir().join("engine"));
    let library = dir().join("libfuzzer.a");
    if library.exists() {
        return Ok(library);
    }
    files::make_empty(&objects)?;
    let mut ar = shell::command("ar");
    ar.arg("rcs").arg(&library);
    for source in files::ending(&sources, ".cpp")? {
        let object = objects.join(source.file_stem().unwrap_or_default()).with_extension("o");
        let mut cc = shell::command("c++");
        cc.args(["-std=c++17", "-O1", "-w", "-c"]).arg(&source).arg("-o").arg(&object);
        shell::run(&mut cc)?;
        ar.arg(&object);
    }
    shell::run(&mut ar)?;
    Ok(library)
}
