//! Fuzzes the C library: `tests/c/fuzz` turns the bytes that libFuzzer generates into calls.
//! Coverage of the library guides libFuzzer, and the address sanitizer checks every access.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{c, files, shell, sources};

/// What fuzzing needs.
pub const NEEDS: &[&Need] = &[&setup::CXX];

/// The target that Rust ships sanitizers for.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// How many sequences of calls step `fuzz` runs, the seeds included.
const BRIEF_RUNS: &str = "-runs=150";
/// How many step `fuzz-long` runs.
const RUNS: &str = "-runs=600";
/// The seed of the generator: the steps run the same sequences each time, and `cargo xtask fuzz`
/// new ones.
const SEED: &str = "-seed=1";
/// The number of sequences within which the fuzzer must find a planted mistake.
const PLANTED_RUNS: &str = "-runs=20000";
/// The longest time that a step fuzzes [s].
const MAX_SECONDS: u32 = 600;
/// How long `cargo xtask fuzz` fuzzes by default [s].
const DEFAULT_SECONDS: u32 = 3600;

/// Compiler options that instrument the library, so that libFuzzer sees its coverage.
const COVERAGE: [&str; 4] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=3",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
];

/// Step `fuzz`: runs the seeds and some sequences that the fuzzer derives from them.
pub fn test_briefly() -> Result {
    // Building takes longer than running: with little optimisation, and in one piece, the step takes less
    // time. Without optimisation it takes no less, because the runs then take as long as the build.
    let quick = ["package.muslin.opt-level=1", "codegen-units=1"];
    let quick = quick.map(|option| format!("--config=profile.sanitized.{option}"));
    fuzz_from_seeds(BRIEF_RUNS, &quick.each_ref().map(String::as_str))
}

/// Step `fuzz-long`: runs the seeds and several hundred sequences, and finds a mistake that is
/// planted in the calls.
pub fn test() -> Result {
    fuzz_from_seeds(RUNS, &[])?;
    find_planted()
}

fn fuzz_from_seeds(runs: &str, options: &[&str]) -> Result {
    let program = build("fuzz", &[], options)?;
    let found = dir().join("found");
    files::create_empty_dir(&found)?;
    let mut fuzz = fuzzer(&program, MAX_SECONDS);
    shell::run(fuzz.args([runs, SEED]).arg(&found).arg(seeds()))
}

/// `cargo xtask fuzz`: fuzzes for the given seconds, or for an hour. Inputs that reach new code are
/// kept in
/// `target/fuzz/corpus`.
pub fn run(options: &[String]) -> Result {
    let seconds = match options {
        [] => DEFAULT_SECONDS,
        [number] => number.parse().during(|| "cargo xtask fuzz takes seconds".into())?,
        _ => return Err(Failure::new("`cargo xtask fuzz` takes seconds and nothing else")),
    };
    let program = build("fuzz", &[], &[])?;
    let corpus = dir().join("corpus");
    files::create_dir(&corpus)?;
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

/// Builds the calls with a buffer that is smaller than its stated size, and fails unless the fuzzer
/// finds that.
fn find_planted() -> Result {
    let program = build("planted", &["-DPLANTED"], &[])?;
    let found = dir().join("found");
    files::create_empty_dir(&found)?;
    let mut fuzz = fuzzer(&program, MAX_SECONDS);
    fuzz.args([PLANTED_RUNS, SEED]);
    let output = fuzz.arg(&found).arg(seeds()).output().during(|| "starting the fuzzer".into())?;
    let output = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_found =
        output.contains("heap-buffer-overflow") && output.contains("call_write_vertices");
    if !is_found {
        return Err(Failure::new("the fuzzer did not find the buffer that is too small"));
    }
    println!("the fuzzer found the planted mistake");
    Ok(())
}

/// Links the calls with the instrumented library and libFuzzer; returns the program. `flags` are for
/// the compiler of the calls, `options` for cargo.
fn build(name: &str, flags: &[&str], options: &[&str]) -> Result<PathBuf> {
    let library = library("address", &COVERAGE, options)?;
    let engine = libfuzzer()?;
    let (object, program) = (dir().join(name).with_extension("o"), dir().join(name));
    let source = files::root().join("tests/c/fuzz/fuzz.c");
    let mut cc = c::strict_compiler(&source);
    shell::run(cc.args(flags).arg("-c").arg(&source).arg("-o").arg(&object))?;
    let mut link = shell::command("c++");
    link.arg("-o").arg(&program).arg(&object).arg(&library).arg(&engine);
    shell::run(link.args(runtime("asan")?).args(["-lm", "-lpthread", "-ldl"]))?;
    Ok(program)
}

/// Builds the static library with a sanitizer, overflow checks and debug assertions; `options` are
/// for cargo.
pub fn library(sanitizer: &str, flags: &[&str], options: &[&str]) -> Result<PathBuf> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err(Failure::new("Rust ships its sanitizers for Linux on x86-64 only"));
    }
    let built = files::target().join(sanitizer);
    let mut cargo = shell::cargo(&["build", "--profile=sanitized", "--package=muslin-c"]);
    cargo.arg("--target").arg(TARGET).arg("--target-dir").arg(&built).args(options);
    let flags: Vec<&str> = flags.iter().copied().chain(["-Cforce-frame-pointers=yes"]).collect();
    // Sanitizers are an unstable option, which stable compilers have too.
    cargo.env("RUSTC_BOOTSTRAP", "1").env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo.env("RUSTFLAGS", format!("-Zsanitizer={sanitizer} {}", flags.join(" ")));
    shell::run(&mut cargo)?;
    Ok(built.join(TARGET).join("sanitized/libmuslin.a"))
}

/// The options that link the runtime of a sanitizer.
pub fn runtime(name: &str) -> Result<Vec<String>> {
    let mut rustc = shell::command("rustc");
    let dir = shell::output(rustc.args(["--print", "target-libdir", "--target", TARGET]))?;
    let found = files::with_suffix(Path::new(dir.trim()), &format!("_rt.{name}.a"))?;
    let whole = ["-Wl,--whole-archive", "-Wl,--no-whole-archive"].map(String::from);
    let [before, after] = whole;
    Ok(vec![before, found[0].display().to_string(), after])
}

/// Compiles libFuzzer, once, and returns the library.
fn libfuzzer() -> Result<PathBuf> {
    let (sources, objects) = (sources::LIBFUZZER.fetch()?, dir().join("engine"));
    let library = dir().join("libfuzzer.a");
    if library.exists() {
        return Ok(library);
    }
    files::create_empty_dir(&objects)?;
    let mut ar = shell::command("ar");
    ar.arg("rcs").arg(&library);
    for source in files::with_suffix(&sources, ".cpp")? {
        let object = objects.join(source.file_stem().unwrap_or_default()).with_extension("o");
        let mut cc = shell::command("c++");
        cc.args(["-std=c++17", "-O1", "-w", "-c"]).arg(&source).arg("-o").arg(&object);
        shell::run(&mut cc)?;
        ar.arg(&object);
    }
    shell::run(&mut ar)?;
    Ok(library)
}
