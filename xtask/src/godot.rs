//! The extension for Godot: builds it, and tests it in a Godot without a window, then with one.
//!
//! ```text
//! bindings/godot ─▶ libmuslin_godot ─┐
//! bindings/godot/project ────────────┴▶ target/godot/project ─▶ import ─▶ tests ─▶ picture
//! docs/manual/godot.md ──────────────▶ blocks of GDScript, run by the tests
//! ```

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::readme::{self, GODOT_PAGE};
use crate::setup::{self, Need};
use crate::{engine_download, files, picture, shell};

/// What the tests need beside Rust and Godot.
pub const NEEDS: &[&Need] = &[&setup::XVFB];

/// The environment variable with the path of Godot.
const VARIABLE: &str = "GODOT";

/// The oldest Godot that loads the extension.
const OLDEST: (u32, u32) = (4, 3);

/// What Godot or the extension prints where a test went wrong without failing a check.
const DEFECTS: [&str; 3] = ["SCRIPT ERROR", "panicked", "Parse Error"];

fn bindings() -> PathBuf {
    files::root().join("bindings/godot")
}

fn work() -> PathBuf {
    files::target().join("godot")
}

fn library_name() -> String {
    format!("{DLL_PREFIX}muslin_godot{DLL_SUFFIX}")
}

/// `cargo xtask godot`: builds the extension into the project that shows it.
pub fn build() -> Result {
    build_library(&["build", "--release", "--locked"])?;
    let folder = bindings().join("project/addons/muslin/bin");
    install_library("release", &folder)?;
    println!("open bindings/godot/project in Godot; addons/muslin is the extension");
    Ok(())
}

/// Builds the extension, lints it, and runs its tests.
pub fn test() -> Result {
    let godot = Godot::find()?;
    setup::ensure_component("clippy", "clippy")?;
    build_library(&["build", "--locked"])?;
    build_library(&["test", "--locked", "--lib"])?;
    build_library(&["clippy", "--locked", "--all-targets", "--", "-D", "warnings"])?;
    let project = work().join("project");
    files::create_empty_dir(&project)?;
    for part in ["addons", "cloth.gdshader", "main.gd", "main.tscn", "project.godot"] {
        copy(&bindings().join("project").join(part), &project.join(part))?;
    }
    install_library("debug", &project.join("addons/muslin/bin"))?;
    copy(&bindings().join("tests/test_cloth.gd"), &project.join("test_cloth.gd"))?;
    write_blocks(&project.join("manual"))?;
    // A Godot without a window that finds a new extension crashes when it ends (godot issue 111048),
    // so the extension is listed before.
    files::create_dir(&project.join(".godot"))?;
    let list = project.join(".godot/extension_list.cfg");
    files::write(&list, "res://addons/muslin/muslin.gdextension\n")?;
    godot.run(&project, &["--headless", "--import"])?;
    let tests = ["--fixed-fps", "60", "--script", "res://test_cloth.gd"];
    godot.run(&project, &[&["--headless"][..], &tests].concat())?;
    godot.run_on_screen(&project, &tests)?;
    enable_editor_tests(&project)?;
    godot.run(&project, &["--headless", "--editor"])?;
    let file = work().join("godot.png");
    std::fs::remove_file(&file).ok(); // it may be missing
    let name = file.display().to_string();
    godot.run_on_screen(&project, &["--fixed-fps", "60", "--", "--shot", &name])?;
    picture::check(&file)
}

/// Runs cargo for the extension, which is a workspace of its own.
fn build_library(args: &[&str]) -> Result {
    let mut words = args.to_vec();
    let end = words.iter().position(|word| *word == "--").unwrap_or(words.len());
    let target = work().display().to_string();
    words.splice(end..end, ["--target-dir", &target]);
    shell::run(shell::cargo(&words).current_dir(bindings()))
}

fn install_library(profile: &str, folder: &Path) -> Result {
    files::create_dir(folder)?;
    copy(&work().join(profile).join(library_name()), &folder.join(library_name()))
}

fn copy(from: &Path, to: &Path) -> Result {
    if from.is_dir() {
        return files::copy_dir(from, to);
    }
    std::fs::copy(from, to).during(|| format!("copying {}", from.display()))?;
    Ok(())
}

/// Adds the plugin that tests the node in the editor and then ends it.
fn enable_editor_tests(project: &Path) -> Result {
    copy(&bindings().join("tests/editor"), &project.join("addons/editor_tests"))?;
    let settings = project.join("project.godot");
    let plugin = "PackedStringArray(\"res://addons/editor_tests/plugin.cfg\")";
    let text = files::read(&settings)?;
    files::write(&settings, &format!("{text}\n[editor_plugins]\n\nenabled={plugin}\n"))
}

/// Writes each block of GDScript of the manual as a script, which the tests run.
fn write_blocks(folder: &Path) -> Result {
    files::create_dir(folder)?;
    let blocks = readme::blocks_in(GODOT_PAGE, "gdscript")?;
    if blocks.is_empty() {
        return Err(Failure::new(format!("{GODOT_PAGE} has no block of GDScript")));
    }
    for (line, text) in blocks {
        files::write(&folder.join(format!("line_{line}.gd")), &text)?;
    }
    Ok(())
}

/// A Godot that runs here.
struct Godot {
    /// The program, and the words before its own options.
    words: Vec<PathBuf>,
}

impl Godot {
    /// Finds Godot in the environment variable or in `PATH`, or installs one below `target`.
    fn find() -> Result<Self> {
        if let Some(given) = std::env::var_os(VARIABLE) {
            let godot = Self { words: vec![given.into()] };
            godot.check_version().during(|| format!("{VARIABLE} must name a program"))?;
            return Ok(godot);
        }
        let installed = ["godot", "godot4"].into_iter().filter_map(shell::which);
        let mut installed = installed.map(|program| Self { words: vec![program] });
        if let Some(godot) = installed.find(|godot| godot.check_version().is_ok()) {
            return Ok(godot);
        }
        let (major, minor) = OLDEST;
        let words = engine_download::godot().during(|| {
            format!(
                "missing: Godot {major}.{minor} or newer; install it, or set {VARIABLE} to its path"
            )
        })?;
        let godot = Self { words };
        godot.check_version()?;
        Ok(godot)
    }

    fn command(&self) -> Command {
        let mut command = shell::command(&self.words[0]);
        command.args(&self.words[1..]);
        with_own_home(command)
    }

    fn check_version(&self) -> Result {
        let text = shell::output(self.command().arg("--version"))?;
        let version = version(&text);
        if version >= Some(OLDEST) {
            return Ok(());
        }
        let (text, (major, minor)) = (text.trim(), OLDEST);
        Err(Failure::new(format!("Godot {text} is older than {major}.{minor}")))
    }

    /// Runs Godot without a window.
    fn run(&self, project: &Path, options: &[&str]) -> Result {
        let mut command = self.command();
        command.arg("--path").arg(project).args(options);
        run(&mut command)
    }

    /// Runs Godot with a window on a virtual screen, drawn by OpenGL.
    fn run_on_screen(&self, project: &Path, options: &[&str]) -> Result {
        let mut command = shell::command("xvfb-run");
        command.args(["-a", "-s", "-screen 0 1280x800x24"]).args(&self.words);
        command.args(["--rendering-driver", "opengl3", "--audio-driver", "Dummy", "--path"]);
        run(with_own_home(command).arg(project).args(options))
    }
}

/// Lets Godot keep its settings below `target`, not in the home of who runs the tests.
fn with_own_home(mut command: Command) -> Command {
    let home = work().join("home");
    command.env("HOME", &home);
    for (variable, folder) in
        [("XDG_CONFIG_HOME", "config"), ("XDG_DATA_HOME", "data"), ("XDG_CACHE_HOME", "cache")]
    {
        command.env(variable, home.join(folder));
    }
    command
}

/// Runs Godot, and prints what it says.
///
/// # Errors
/// Fails if Godot does, and if a script stopped in the middle.
fn run(command: &mut Command) -> Result {
    let typed = shell::typed(command);
    println!("$ {typed}");
    let done = command.output().during(|| format!("starting `{typed}`"))?;
    let text = [done.stdout, done.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    let has_defect = |line: &&str| DEFECTS.iter().any(|defect| line.contains(defect));
    let defect = text.iter().flat_map(|text| text.lines()).find(has_defect);
    let results = ["ok ", "FAIL", "checks passed"];
    let is_result = |line: &str| results.iter().any(|word| line.contains(word));
    text[0].lines().filter(|line| is_result(line)).for_each(|line| println!("{line}"));
    if done.status.success() && defect.is_none() {
        return Ok(());
    }
    println!("{}\n{}", text[0], text[1]);
    let why = defect.map_or_else(|| done.status.to_string(), String::from);
    Err(Failure::new(format!("`{typed}` failed ({why})")))
}

/// The first two numbers of a version such as `4.6.3.stable`.
fn version(text: &str) -> Option<(u32, u32)> {
    let last = text.lines().rfind(|line| !line.trim().is_empty())?;
    let mut numbers = last.trim().split('.').map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_of_godot_compare_by_number() {
        assert_eq!(version("4.6.3.stable.official.abc\n"), Some((4, 6)));
        assert!(version("4.10.stable") > Some(OLDEST) && version("4.2.2.stable") < Some(OLDEST));
        assert!(version("3.5.2.stable") < Some(OLDEST) && version("") < Some(OLDEST));
    }

    #[test]
    fn the_extension_names_the_libraries_that_are_built() {
        let extension = bindings().join("project/addons/muslin/muslin.gdextension");
        let text = files::read(&extension).unwrap();
        assert!(text.contains(&format!("res://addons/muslin/bin/{}\"", library_name())), "{text}");
        let (major, minor) = OLDEST;
        assert!(text.contains(&format!("compatibility_minimum = {major}.{minor}\n")), "{text}");
    }
}
