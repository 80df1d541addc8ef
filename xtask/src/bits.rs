//! The table of golden hashes: the scenes of `muslin-golden`, played on every platform that this machine
//! is or can imitate, must end in what `tests/golden/golden.txt` says.

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
/// These targets bring all of a C library that a program needs, and Rust its own linker.
const LINK: &str = "-C linker=rust-lld";

/// What the table needs on this machine.
pub const NEEDS: &[&Need] = &[&setup::NODE, &setup::QEMU];

/// A machine that plays the scenes.
struct Platform {
    /// Its column in the table.
    name: &'static str,
    /// The target and the compiler's flags; the machine's own if there are none.
    built_for: Option<(&'static str, &'static str)>,
    player: Player,
    /// The instructions that it must turn out to have; whatever there are if none.
    has: Option<&'static str>,
}

/// What runs the program.
enum Player {
    Itself,
    Node,
    Qemu(&'static str, &'static [&'static str]),
}

/// All of them; the others are compared with the first tick by tick where they differ. Those that take
/// longest come early, since one is played while the next is built.
const PLATFORMS: &[Platform] = &[
    Platform { name: "native", built_for: None, player: Player::Itself, has: None },
    Platform {
        name: "neon",
        built_for: Some((AARCH64, LINK)),
        player: Player::Qemu("qemu-aarch64", &[]),
        has: Some("neon"),
    },
    Platform {
        name: "sse2",
        built_for: Some((X86_64, LINK)),
        player: Player::Qemu("qemu-x86_64", &["-cpu", "Nehalem"]),
        has: Some("sse2"),
    },
    Platform {
        name: "avx2",
        built_for: Some((X86_64, LINK)),
        player: Player::Qemu("qemu-x86_64", &["-cpu", "Nehalem,+xsave,+avx,+avx2"]),
        has: Some("avx2"),
    },
    Platform {
        name: "wasm",
        built_for: Some((wasm::TARGET, wasm::PLAIN)),
        player: Player::Node,
        has: Some("scalar"),
    },
    Platform {
        name: "simd128",
        built_for: Some((wasm::TARGET, wasm::FLAGS)),
        player: Player::Node,
        has: Some("simd128"),
    },
];

/// What a platform has played.
struct Played {
    instructions: String,
    table: String,
    time: Duration,
}

/// `cargo xtask bits`: shows the table, or with `--bless` writes what the scenes end in now.
pub fn run(options: &[String]) -> Result {
    match options {
        [] => compare(),
        [bless] if bless == "--bless" => self::bless(),
        _ => Err(Failure::new("`cargo xtask bits` takes only --bless")),
    }
}

/// The step of the tests: the script and the scenes in release, also under strange floating-point
/// modes and cut up for several threads, natively and on the other kind of processor; then the table.
pub fn test() -> Result {
    let packages = ["--package", "muslin", "--package", PACKAGE];
    let tests = ["test", "--release", "--test", "golden"];
    shell::run(shell::cargo(&tests).args(["--package", PACKAGE]))?;
    let features = ["--features", "muslin/parallel,muslin-golden/parallel"];
    let threads = ["test", "--release", "--lib", "--test", "golden", "--test", "*threads"];
    shell::run(shell::cargo(&threads).args(packages).args(features).args(["--", "threads"]))?;
    if can_emulate() {
        setup::ensure_target(AARCH64)?;
        let modes = ["test", "--release", "--package", PACKAGE, "--test", "golden"];
        let mut cargo = cargo_for(&modes, Some((AARCH64, LINK)));
        cargo.env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_RUNNER", "qemu-aarch64");
        shell::run(cargo.args(["--", "modes::every_call", "modes::the_modes"]))?;
    }
    compare()
}

/// Makes sure that Rust can build for all platforms.
pub fn ensure_targets() -> Result {
    let targets = PLATFORMS.iter().filter(|p| p.is_here()).filter_map(|p| p.built_for);
    targets.into_iter().try_for_each(|(target, _)| setup::ensure_target(target))
}

/// Plays the scenes here and writes the table anew.
fn bless() -> Result {
    let native = &PLATFORMS[0];
    let played = native.play(&native.build()?, false)?;
    let golden = golden()?;
    let changed: Vec<_> = played.table.lines().filter(|line| !golden.contains(*line)).collect();
    files::write(&golden_file(), &played.table)?;
    match changed.as_slice() {
        [] => println!("golden.txt is as it was"),
        lines => println!("new in golden.txt:\n{}", lines.join("\n")),
    }
    Ok(())
}

/// Plays the scenes on all platforms, prints the table, and where bits differ, since when.
fn compare() -> Result {
    setup::ensure(NEEDS)?;
    ensure_targets()?;
    let golden = golden()?;
    let (here, elsewhere): (Vec<_>, Vec<_>) = PLATFORMS.iter().partition(|p| p.is_here());
    let played = play_all(&here)?;
    let differs = |played: &Played| played.table != golden;
    println!("\n{}", shown(&golden, &here, &played));
    for platform in elsewhere {
        println!("{:8} not played: qemu imitates other processors on Linux only", platform.name);
    }
    if cfg!(target_arch = "x86_64") && played[0].instructions != "avx512" {
        println!("avx512   not played: this machine has no AVX-512, and qemu imitates none");
    }
    let different: Vec<_> = here.iter().zip(&played).filter(|(_, p)| differs(p)).collect();
    if different.is_empty() {
        return Ok(());
    }
    for (platform, other) in &different {
        if other.table != played[0].table {
            let told = first_differences(platform, here[0])?;
            println!("{}", told.join("\n"));
        }
    }
    let names: Vec<_> = different.iter().map(|(platform, _)| platform.name).collect();
    let names = names.join(", ");
    Err(Failure::new(if played.iter().all(|other| other.table == played[0].table) {
        "all platforms agree, but not with golden.txt: say in CHANGELOG.md why the simulation is a \
         new one, then run `cargo xtask bits --bless`"
            .into()
    } else {
        format!("bits differ from golden.txt: {names}")
    }))
}

/// Builds for one platform after the other; each plays as soon as it is built.
fn play_all(platforms: &[&Platform]) -> Result<Vec<Played>> {
    thread::scope(|scope| {
        let mut players = Vec::new();
        for platform in platforms {
            let program = platform.build()?;
            players.push(scope.spawn(move || platform.play(&program, false)));
        }
        let join = |player: thread::ScopedJoinHandle<_>| match player.join() {
            Ok(played) => played,
            Err(panic) => std::panic::resume_unwind(panic),
        };
        players.into_iter().map(join).collect()
    })
}

impl Platform {
    /// Whether this machine is it or can imitate it.
    fn is_here(&self) -> bool {
        !matches!(self.player, Player::Qemu(..)) || can_emulate()
    }

    /// Builds its program. It is copied, since another platform's may be built in the same place.
    fn build(&self) -> Result<PathBuf> {
        let build = ["build", "--release", "--bin", PACKAGE, "--package", PACKAGE];
        shell::run(&mut cargo_for(&build, self.built_for))?;
        let end = match self.player {
            Player::Node => ".wasm",
            Player::Itself => std::env::consts::EXE_SUFFIX,
            Player::Qemu(..) => "",
        };
        let dir =
            self.built_for.map_or(files::target(), |(target, _)| files::target().join(target));
        let built = dir.join("release").join(format!("{PACKAGE}{end}"));
        let programs = files::target().join("golden");
        files::make(&programs)?;
        let copy = programs.join(format!("{}{end}", self.name));
        std::fs::copy(&built, &copy).during(|| format!("copying {}", built.display()))?;
        Ok(copy)
    }

    /// Runs its program.
    fn play(&self, program: &Path, every_tick: bool) -> Result<Played> {
        let mut command = match self.player {
            Player::Itself => shell::command(program),
            Player::Node => shell::command("node"),
            Player::Qemu(qemu, _) => shell::command(qemu),
        };
        match self.player {
            Player::Itself => &mut command,
            Player::Node => command.arg("tests/golden/run.mjs").arg(program),
            Player::Qemu(_, options) => command.args(options).arg(program),
        };
        let start = Instant::now();
        let report = shell::output(command.args(every_tick.then_some("--every-tick")))?;
        let time = start.elapsed();
        let Some((first, table)) = report.split_once('\n') else {
            return Err(Failure::new(format!("{} played nothing", self.name)));
        };
        let instructions = first.trim_start_matches("instructions ").to_string();
        if let Some(has) = self.has.filter(|has| *has != instructions) {
            return Err(Failure::new(format!(
                "{} is to play with {has}, but {} shows it {instructions}",
                self.name,
                shell::typed(&command)
            )));
        }
        Ok(Played { instructions, table: table.into(), time })
    }

    /// What plays, in words.
    fn about(&self) -> String {
        match self.player {
            Player::Itself => "this machine".into(),
            Player::Node => "node".into(),
            Player::Qemu(qemu, options) => format!("{qemu} {}", options.join(" ")).trim().into(),
        }
    }
}

/// Cargo for a target, with just these flags of the compiler.
fn cargo_for(args: &[&str], built_for: Option<(&str, &str)>) -> Command {
    let mut cargo = shell::cargo(args);
    if let Some((target, flags)) = built_for {
        cargo.args(["--target", target]);
        cargo.env("RUSTFLAGS", flags).env_remove("CARGO_ENCODED_RUSTFLAGS");
    }
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

/// Scene by scene: the hash, and who ends in it.
fn shown(golden: &str, platforms: &[&Platform], played: &[Played]) -> String {
    let names: String = platforms.iter().map(|platform| format!(" {:8}", platform.name)).collect();
    let mut text = format!("{:28} {:18}{names}\n", "scene", "golden hash");
    for (scene, hash) in lines(golden) {
        let ends = |played: &Played| match lines(&played.table).find(|line| line.0 == scene) {
            Some((_, own)) if own == hash => "same",
            Some(_) => "DIFFERS",
            None => "MISSING",
        };
        let ends: String = played.iter().map(|played| format!(" {:8}", ends(played))).collect();
        text += format!("{scene:28} {hash}{ends}").trim_end();
        text += "\n";
    }
    let known = |scene: &str| lines(golden).any(|line| line.0 == scene);
    for (scene, hash) in lines(&played[0].table).filter(|line| !known(line.0)) {
        text += &format!("{scene:28} is not in golden.txt; native ends in {hash}\n");
    }
    for (platform, Played { instructions, time, .. }) in platforms.iter().zip(played) {
        let (name, about, seconds) = (platform.name, platform.about(), time.as_secs_f32());
        text += &format!("{name:8} {instructions} on {about}, {seconds:.1} s\n");
    }
    text
}

/// A table's lines, each a scene and its hash.
fn lines(table: &str) -> impl Iterator<Item = (&str, &str)> {
    table.lines().filter_map(|line| line.split_once(' '))
}

/// For each scene the first tick after which two platforms have other bits.
fn first_differences(platform: &Platform, reference: &Platform) -> Result<Vec<String>> {
    let every_tick = |platform: &Platform| platform.play(&platform.build()?, true);
    let (own, right) = (every_tick(platform)?.table, every_tick(reference)?.table);
    let places = first_places(&own, &right);
    let told = |place: String| format!("{} leaves {} at {place}", platform.name, reference.name);
    Ok(places.into_iter().map(told).collect())
}

/// For each scene the first line, as `scene tick`, that two tables of every tick do not share.
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
    fn the_first_tick_that_differs_is_told_for_each_scene() {
        let right = "rag 1 0xa\nrag 2 0xb\nrag 3 0xc\nflag 1 0xd\nflag 2 0xe\n";
        let own = "rag 1 0xa\nrag 2 0x0\nrag 3 0x1\nflag 1 0xd\nflag 2 0x2\n";
        assert_eq!(first_places(own, right), ["tick 2 of rag", "tick 2 of flag"]);
        assert!(first_places(right, right).is_empty());
    }

    #[test]
    fn the_table_tells_who_ends_elsewhere_and_what_is_new() {
        let platforms: Vec<_> = PLATFORMS.iter().take(2).collect();
        let played = |table: &str| Played {
            instructions: "abacus".into(),
            table: table.into(),
            time: Duration::ZERO,
        };
        let played = [played("rag 0xa\nnew 0xc\n"), played("rag 0xb\nnew 0xc\n")];
        let text = shown("rag 0xa\ngone 0xd\n", &platforms, &played);
        let rows: Vec<Vec<_>> =
            text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(rows[1], ["rag", "0xa", "same", "DIFFERS"]);
        assert_eq!(rows[2], ["gone", "0xd", "MISSING", "MISSING"]);
        assert!(rows[3].starts_with(&["new", "is", "not"]), "{text}");
    }

    #[test]
    fn the_first_platform_is_this_machine() {
        assert!(matches!(PLATFORMS[0].player, Player::Itself) && PLATFORMS[0].built_for.is_none());
    }
}
