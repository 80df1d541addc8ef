//! Compares golden hashes: the scenes of `muslin-golden`, simulated on every platform that this
//! machine is or can emulate, must end in the hashes of `tests/golden/golden.txt`.
//!
//! | platform | how it runs |
//! | --- | --- |
//! | native | on this machine, with the widest instructions that it has |
//! | sse2, avx2 | the same program, limited by `MUSLIN_SIMD_LIMIT`; on machines without them under qemu |
//! | neon | under qemu |
//! | wasm, simd128 | in node |
//!
//! Where a limit takes the place of qemu, qemu still plays one scene without the limit: the program
//! must detect the instructions of that processor, and needs no others.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{files, shell, wasm};

const PACKAGE: &str = "muslin-golden";
const AARCH64: &str = "aarch64-unknown-linux-musl";
const X86_64: &str = "x86_64-unknown-linux-musl";
/// These targets contain a C library, and Rust ships a linker, so that no cross compiler is needed.
const LINK: &str = "-C linker=rust-lld";
/// Makes a program obey [`LIMIT`].
const LIMITED: &str = "--cfg muslin_simd_limit";
/// The environment variable that limits the instructions: `sse2` or `avx2`.
const LIMIT: &str = "MUSLIN_SIMD_LIMIT";
/// The scene that qemu plays where a limit takes its place.
const EMULATED_SCENE: &str = "receipt";

/// The profile of the tests and of all platforms, optimised without link-time optimisation: for this
/// machine as a user's own release build, for other targets in one piece. The C library and the npm
/// package are built with link-time optimisation; their own tests compare the hash of a script.
pub const TEST_PROFILE: &str = "release-test";

/// What comparing needs.
pub const NEEDS: &[&Need] = &[&setup::NODE, &setup::QEMU];

/// A processor with its instructions, or an engine, that simulates the scenes.
struct Platform {
    /// The column in the table.
    name: &'static str,
    /// The target and the compiler's flags; none for those of this machine.
    target: Option<(&'static str, &'static str)>,
    runner: Runner,
    /// The instructions that the program must detect; none if any will do.
    instructions: Option<&'static str>,
}

/// What runs the program.
enum Runner {
    Native,
    Node,
    Qemu(&'static str, &'static [&'static str]),
}

/// All platforms. Where one differs from the first, both are compared tick by tick. Slow ones come
/// early, since one runs while the next is built.
const PLATFORMS: &[Platform] = &[
    Platform { name: "native", target: None, runner: Runner::Native, instructions: None },
    Platform {
        name: "neon",
        target: Some((AARCH64, LINK)),
        runner: Runner::Qemu("qemu-aarch64", &[]),
        instructions: Some("neon"),
    },
    Platform {
        name: "sse2",
        target: Some((X86_64, LINK)),
        runner: Runner::Qemu("qemu-x86_64", &["-cpu", "Nehalem"]),
        instructions: Some("sse2"),
    },
    Platform {
        name: "avx2",
        target: Some((X86_64, LINK)),
        runner: Runner::Qemu("qemu-x86_64", &["-cpu", "Nehalem,+xsave,+avx,+avx2"]),
        instructions: Some("avx2"),
    },
    Platform {
        name: "wasm",
        target: Some((wasm::TARGET, wasm::PLAIN)),
        runner: Runner::Node,
        instructions: Some("scalar"),
    },
    Platform {
        name: "simd128",
        target: Some((wasm::TARGET, wasm::FLAGS)),
        runner: Runner::Node,
        instructions: Some("simd128"),
    },
];

/// What the program printed on a platform.
struct Report {
    instructions: String,
    table: String,
    time: Duration,
}

/// `cargo xtask bits`: prints the table, or with `--bless` writes the hashes of this machine.
pub fn run(options: &[String]) -> Result {
    match options {
        [] => compare(),
        [bless] if bless == "--bless" => self::bless(),
        _ => Err(Failure::new("`cargo xtask bits` takes only --bless")),
    }
}

/// Step `bits`: the script and the scenes in optimised builds, also under other floating-point
/// modes and on several threads, natively and on the other kind of processor; then the table.
pub fn test() -> Result {
    shell::run(&mut cargo_test(&["--test=golden"]))?;
    if can_emulate() {
        setup::ensure_target(AARCH64)?;
        let modes = ["test", "--package", PACKAGE, "--test", "golden"];
        let mut cargo = cargo_for(&modes, (AARCH64, LINK));
        cargo.env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_RUNNER", "qemu-aarch64");
        shell::run(cargo.args(["--", "modes::every_call", "modes::the_modes"]))?;
    }
    compare()
}

/// Returns a command of cargo that builds with [`TEST_PROFILE`]. All native programs obey [`LIMIT`], so
/// that they share one build of the library.
pub fn cargo(args: &[&str]) -> Command {
    let mut cargo = shell::cargo(args);
    cargo.args(["--profile", TEST_PROFILE]);
    cargo.env("RUSTFLAGS", LIMITED).env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo
}

/// Returns the command that runs tests of `muslin-golden` in an optimised build. A caller may add packages:
/// the library is not built again, because its features stay the same.
pub fn cargo_test(tests: &[&str]) -> Command {
    let mut cargo = cargo(&["test", "--package", PACKAGE]);
    // With the feature a cloth still runs on one thread unless a test asks for more.
    cargo.args(tests).arg("--features=muslin-golden/parallel");
    cargo
}

/// Installs the standard library of every platform.
pub fn ensure_targets() -> Result {
    let targets = PLATFORMS.iter().filter(|p| p.is_available()).filter_map(Platform::target);
    targets.into_iter().try_for_each(|(target, _)| setup::ensure_target(target))
}

/// Simulates the scenes on this machine and writes `golden.txt`.
fn bless() -> Result {
    let native = &PLATFORMS[0];
    let report = native.run(&native.build()?, false)?;
    let golden = golden()?;
    let changed: Vec<_> = report.table.lines().filter(|line| !golden.contains(*line)).collect();
    files::write(&golden_file(), &report.table)?;
    match changed.as_slice() {
        [] => println!("golden.txt has not changed"),
        lines => println!("new in golden.txt:\n{}", lines.join("\n")),
    }
    Ok(())
}

/// Simulates the scenes on all platforms, prints the table, and for each difference the first tick
/// that differs.
fn compare() -> Result {
    setup::ensure(NEEDS)?;
    ensure_targets()?;
    let golden = golden()?;
    let (available, others): (Vec<_>, Vec<_>) = PLATFORMS.iter().partition(|p| p.is_available());
    let reports = run_all(&available)?;
    let differs = |report: &Report| report.table != golden;
    println!("\n{}", table(&golden, &available, &reports));
    for platform in others {
        println!("{:8} not run: qemu emulates other processors on Linux only", platform.name);
    }
    let different: Vec<_> = available.iter().zip(&reports).filter(|(_, p)| differs(p)).collect();
    if different.is_empty() {
        return Ok(());
    }
    for (platform, other) in &different {
        if other.table != reports[0].table {
            let differences = first_differences(platform, available[0])?;
            println!("{}", differences.join("\n"));
        }
    }
    let names: Vec<_> = different.iter().map(|(platform, _)| platform.name).collect();
    let names = names.join(", ");
    Err(Failure::new(if reports.iter().all(|other| other.table == reports[0].table) {
        "all platforms agree with each other but not with golden.txt: say in CHANGELOG.md why the \
         simulation has changed, then run `cargo xtask bits --bless`"
            .into()
    } else {
        format!("bits differ from golden.txt: {names}")
    }))
}

/// Builds for one platform after the other, and runs each program while the next one is built.
fn run_all(platforms: &[&Platform]) -> Result<Vec<Report>> {
    thread::scope(|scope| {
        let mut runs = Vec::new();
        for platform in platforms {
            let program = platform.build()?;
            runs.push(scope.spawn(move || {
                let report = platform.run(&program, false)?;
                platform.check_detection(&program, &report.table)?;
                Ok(report)
            }));
        }
        let join = |run: thread::ScopedJoinHandle<_>| match run.join() {
            Ok(report) => report,
            Err(panic) => std::panic::resume_unwind(panic),
        };
        runs.into_iter().map(join).collect()
    })
}

impl Platform {
    /// Whether this machine is the platform or can emulate it.
    fn is_available(&self) -> bool {
        !matches!(self.runner, Runner::Qemu(..)) || can_emulate()
    }

    /// Builds the program and returns a copy of it, since another platform may be built in the same
    /// folder.
    fn build(&self) -> Result<PathBuf> {
        let build = ["build", "--bin", PACKAGE, "--package", PACKAGE];
        shell::run(&mut match self.target() {
            Some(target) => cargo_for(&build, target),
            // The tests of the package need the program, too, so the step has built it.
            None => cargo_test(&["--no-run", "--test=golden"]),
        })?;
        let suffix = match self.runner {
            Runner::Node => ".wasm",
            Runner::Native => std::env::consts::EXE_SUFFIX,
            Runner::Qemu(..) => "",
        };
        let dir = self.target().map_or(files::target(), |(target, _)| files::target().join(target));
        let built = dir.join(TEST_PROFILE).join(format!("{PACKAGE}{suffix}"));
        let programs = files::target().join("golden");
        files::create_dir(&programs)?;
        let copy = programs.join(format!("{}{suffix}", self.name));
        std::fs::copy(&built, &copy).during(|| format!("copying {}", built.display()))?;
        Ok(copy)
    }

    /// The instructions to which the native program is limited; none if it runs without a limit, or if
    /// this machine lacks them.
    fn limit(&self) -> Option<&'static str> {
        self.instructions.filter(|instructions| can_run(instructions))
    }

    /// The target and the compiler's flags; none for the native program.
    fn target(&self) -> Option<(&'static str, &'static str)> {
        self.target.filter(|_| self.limit().is_none())
    }

    /// What runs the program, with its first arguments.
    fn command(&self, program: &Path) -> Command {
        let with = |runner: &str, first: &[&str]| {
            let mut command = shell::command(runner);
            command.args(first).arg(program);
            command
        };
        match self.runner {
            Runner::Native => shell::command(program),
            Runner::Node => with("node", &["tests/golden/run.mjs"]),
            Runner::Qemu(qemu, options) => with(qemu, options),
        }
    }

    /// Runs the program; with `every_tick` it prints a hash after each tick.
    fn run(&self, program: &Path, every_tick: bool) -> Result<Report> {
        let mut command = match self.limit() {
            None => self.command(program),
            Some(limit) => {
                let mut command = shell::command(program);
                command.env(LIMIT, limit);
                command
            }
        };
        self.report(command.args(every_tick.then_some("--every-tick")))
    }

    /// Where a limit takes the place of qemu, plays one scene under qemu without the limit.
    ///
    /// # Errors
    /// Fails unless the program detects the right instructions and prints a row of `table`, which it
    /// printed with the limit.
    fn check_detection(&self, program: &Path, table: &str) -> Result {
        if self.limit().is_none() {
            return Ok(());
        }
        let mut command = self.command(program);
        let row = self.report(command.args(["--scene", EMULATED_SCENE]))?.table;
        if table.contains(&row) {
            return Ok(());
        }
        let command = shell::typed(&command);
        Err(Failure::new(format!("`{command}` ends in other bits than this machine: {row}")))
    }

    /// Runs a command of this platform, and checks the instructions that it reports.
    fn report(&self, command: &mut Command) -> Result<Report> {
        let start = Instant::now();
        let output = shell::output(command)?;
        let time = start.elapsed();
        let Some((first, table)) = output.split_once('\n') else {
            return Err(Failure::new(format!("{} printed nothing", self.name)));
        };
        let instructions = first.trim_start_matches("instructions ").to_string();
        if let Some(expected) = self.instructions.filter(|expected| *expected != instructions) {
            return Err(Failure::new(format!(
                "{} must run with {expected}, but {} reports {instructions}",
                self.name,
                shell::typed(command)
            )));
        }
        Ok(Report { instructions, table: table.into(), time })
    }

    /// What runs the program, in words.
    fn runner_name(&self) -> String {
        match self.runner {
            Runner::Native => "this machine".into(),
            Runner::Node => "node".into(),
            Runner::Qemu(..) if self.limit().is_some() => "this machine, limited to it".into(),
            Runner::Qemu(qemu, options) => format!("{qemu} {}", options.join(" ")).trim().into(),
        }
    }
}

/// Whether this machine runs programs for x86-64 Linux and has these instructions.
fn can_run(instructions: &str) -> bool {
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    return match instructions {
        "sse2" => true,
        "avx2" => std::is_x86_feature_detected!("avx2"),
        _ => false,
    };
    #[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
    {
        let _ = instructions;
        false
    }
}

/// The crate in one piece, as it is shipped: that takes a fifth less time to compile.
const ONE_UNIT: &str = "--config=profile.release-test.codegen-units=1";

/// Cargo for a target, with these compiler flags and none from the environment.
fn cargo_for(args: &[&str], (target, flags): (&str, &str)) -> Command {
    let mut cargo = cargo(args);
    cargo.args(["--target", target, ONE_UNIT]).env("RUSTFLAGS", flags);
    cargo
}

fn can_emulate() -> bool {
    cfg!(target_os = "linux")
}

fn golden_file() -> PathBuf {
    files::root().join("tests/golden/golden.txt")
}

fn golden() -> Result<String> {
    files::read(&golden_file())
}

/// A row for each scene: its golden hash, and whether each platform ends in it; then a row for each
/// platform.
fn table(golden: &str, platforms: &[&Platform], reports: &[Report]) -> String {
    let names: String = platforms.iter().map(|platform| format!(" {:8}", platform.name)).collect();
    let mut text = format!("{:28} {:18}{names}\n", "scene", "golden hash");
    for (scene, hash) in lines(golden) {
        let verdict = |report: &Report| match lines(&report.table).find(|line| line.0 == scene) {
            Some((_, own)) if own == hash => "same",
            Some(_) => "DIFFERS",
            None => "MISSING",
        };
        let verdicts: String =
            reports.iter().map(|report| format!(" {:8}", verdict(report))).collect();
        text += format!("{scene:28} {hash}{verdicts}").trim_end();
        text += "\n";
    }
    let known = |scene: &str| lines(golden).any(|line| line.0 == scene);
    for (scene, hash) in lines(&reports[0].table).filter(|line| !known(line.0)) {
        text += &format!("{scene:28} is not in golden.txt; native ends in {hash}\n");
    }
    for (platform, Report { instructions, time, .. }) in platforms.iter().zip(reports) {
        let (name, about, seconds) = (platform.name, platform.runner_name(), time.as_secs_f32());
        text += &format!("{name:8} {instructions} on {about}, {seconds:.1} s\n");
    }
    text
}

/// The scene and the hash of each line of a table.
fn lines(table: &str) -> impl Iterator<Item = (&str, &str)> {
    table.lines().filter_map(|line| line.split_once(' '))
}

/// For each scene the first tick after which the bits of two platforms differ.
fn first_differences(platform: &Platform, reference: &Platform) -> Result<Vec<String>> {
    let every_tick = |platform: &Platform| platform.run(&platform.build()?, true);
    let (own, right) = (every_tick(platform)?.table, every_tick(reference)?.table);
    let places = first_places(&own, &right);
    let message =
        |place: String| format!("{} differs from {} at {place}", platform.name, reference.name);
    Ok(places.into_iter().map(message).collect())
}

/// For each scene the first tick whose line differs between two tables of every tick.
fn first_places(own: &str, right: &str) -> Vec<String> {
    let mut places: Vec<(&str, String)> = Vec::new();
    for (a, b) in own.lines().zip(right.lines()) {
        let (scene, rest) = b.split_once(' ').unwrap_or((b, ""));
        let is_new = places.last().is_none_or(|(last, _)| *last != scene);
        if a != b && is_new {
            let tick = rest.split(' ').next().unwrap_or_default();
            places.push((scene, format!("tick {tick} of {scene}")));
        }
    }
    places.into_iter().map(|(_, place)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_tick_that_differs_is_found_for_each_scene() {
        let right = "rag 1 0xa\nrag 2 0xb\nrag 3 0xc\nflag 1 0xd\nflag 2 0xe\n";
        let own = "rag 1 0xa\nrag 2 0x0\nrag 3 0x1\nflag 1 0xd\nflag 2 0x2\n";
        assert_eq!(first_places(own, right), ["tick 2 of rag", "tick 2 of flag"]);
        assert!(first_places(right, right).is_empty());
    }

    #[test]
    fn the_table_marks_differences_missing_scenes_and_new_ones() {
        let platforms: Vec<_> = PLATFORMS.iter().take(2).collect();
        let report = |table: &str| Report {
            instructions: "abacus".into(),
            table: table.into(),
            time: Duration::ZERO,
        };
        let reports = [report("rag 0xa\nnew 0xc\n"), report("rag 0xb\nnew 0xc\n")];
        let text = table("rag 0xa\ngone 0xd\n", &platforms, &reports);
        let rows: Vec<Vec<_>> =
            text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(rows[1], ["rag", "0xa", "same", "DIFFERS"]);
        assert_eq!(rows[2], ["gone", "0xd", "MISSING", "MISSING"]);
        assert!(rows[3].starts_with(&["new", "is", "not"]), "{text}");
    }

    #[test]
    fn only_programs_that_obey_the_limit_run_with_it() {
        for platform in PLATFORMS {
            let is_limited = ["sse2", "avx2"].contains(&platform.name);
            assert_eq!(platform.limit().is_some(), is_limited && can_run(platform.name));
            assert!(matches!(platform.runner, Runner::Qemu(..)) || platform.limit().is_none());
        }
        assert!(!can_run("neon"));
    }

    #[test]
    fn the_scene_that_qemu_plays_has_a_golden_hash() {
        assert!(lines(&golden().unwrap()).any(|(scene, _)| scene == EMULATED_SCENE));
    }

    #[test]
    fn the_first_platform_is_this_machine() {
        assert!(matches!(PLATFORMS[0].runner, Runner::Native) && PLATFORMS[0].target.is_none());
    }
}
