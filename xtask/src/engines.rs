//! Builds the examples in engines with the commands that their first lines show, runs them on a
//! virtual screen, and checks their pictures.

use std::path::{Path, PathBuf};

use crate::failure::{Failure, Result};
use crate::setup::{self, Need};
use crate::{c, files, picture, shell, sources};

/// What building and running the examples needs.
pub const NEEDS: &[&Need] =
    &[&setup::CXX, &setup::PKG_CONFIG, &setup::XVFB, &setup::RAYLIB, &setup::OGRE, &setup::PYTHON];

/// What the example in Bevy needs beside Rust.
const BEVY_NEEDS: &[&Need] = &[&setup::XVFB, &setup::VULKAN, &setup::X11];

/// The most lines of an example.
const MAX_LINES: usize = 149;
/// The most lines of an example from nothing to its first frame.
const MAX_FIRST_FRAME_LINES: usize = 20;

/// The source files of raylib that drawing needs.
const RAYLIB_PARTS: [&str; 6] = ["rcore", "rshapes", "rtextures", "rtext", "rmodels", "rglfw"];
const RAYLIB_FLAGS: [&str; 6] = [
    "-O1",
    "-w",
    "-D_GNU_SOURCE",
    "-DPLATFORM_DESKTOP_GLFW",
    "-DGRAPHICS_API_OPENGL_33",
    "-D_GLFW_X11",
];

/// Builds the library and all examples, draws their pictures into `target/engines` and checks them.
pub fn test() -> Result {
    c::build()?;
    files::create_dir(&dir())?;
    for name in ["raylib.c", "ogre.cpp", "viewer.py"] {
        check_length(&example(name))?;
    }
    check_length(&bevy_dir().join("src/main.rs"))?;
    check_first_frame("raylib.c")?;
    test_viewer()?;
    test_raylib()?;
    test_ogre()
}

/// `cargo xtask bevy`: builds the example in Bevy, draws its picture and checks it. It is no step
/// of the tests, since it compiles hundreds of crates.
pub fn bevy() -> Result {
    setup::ensure(BEVY_NEEDS)?;
    files::create_dir(&dir())?;
    let target = files::target().join("bevy");
    let mut cargo = shell::cargo(&["build", "--release", "--locked"]);
    cargo.current_dir(bevy_dir()).arg("--target-dir").arg(&target);
    shell::run(&mut cargo)?;
    draw(&target.join("release/muslin-bevy"), &["--shot"], "bevy.png")?;
    println!("the picture is {}", dir().join("bevy.png").display());
    Ok(())
}

fn bevy_dir() -> PathBuf {
    files::root().join("bindings/bevy")
}

fn dir() -> PathBuf {
    files::target().join("engines")
}

fn example(name: &str) -> PathBuf {
    files::root().join("bindings/c/examples").join(name)
}

fn check_length(file: &Path) -> Result {
    let lines = files::read(file)?.lines().count();
    if lines > MAX_LINES {
        let name = file.display();
        return Err(Failure::new(format!(
            "{name} has {lines} lines, and at most {MAX_LINES} are allowed"
        )));
    }
    Ok(())
}

/// Counts the lines between the comments that mark where an example starts and where it draws
/// first.
fn check_first_frame(name: &str) -> Result {
    let lines = lines_of_example(name)?;
    println!("{name}: {lines} lines from nothing to the first frame");
    if lines > MAX_FIRST_FRAME_LINES {
        return Err(Failure::new(format!(
            "{name}: at most {MAX_FIRST_FRAME_LINES} lines are allowed to the first frame"
        )));
    }
    Ok(())
}

/// The lines of an example from nothing to its first frame.
pub fn lines_of_example(name: &str) -> Result<usize> {
    let text = files::read(&example(name))?;
    lines_to_first_frame(&text)
        .ok_or_else(|| Failure::new(format!("{name} has no comments that mark its first frame")))
}

fn lines_to_first_frame(text: &str) -> Option<usize> {
    let (_, rest) = text.split_once("/* From nothing... */")?;
    let (lines, _) = rest.split_once("/* ...to the first frame. */")?;
    Some(lines.lines().filter(|line| !line.trim().is_empty()).count())
}

/// Runs a program on a virtual screen, and checks the picture that it writes.
fn draw(program: &Path, options: &[&str], name: &str) -> Result {
    let file = dir().join(name);
    std::fs::remove_file(&file).ok();
    let mut run = shell::command("xvfb-run");
    run.args(["-a", "-s", "-screen 0 1280x800x24"]).arg(program).args(options).arg(&file);
    // Engines print much, which is dropped.
    shell::output(run.current_dir(dir()))?;
    picture::check(&file)
}

fn test_viewer() -> Result {
    let (root, file) = (files::root(), dir().join("viewer.png"));
    let mut python = shell::command("python3");
    python.arg(example("viewer.py")).arg(root.join("include/muslin.h"));
    python
        .arg(c::release_dir().join("libmuslin.so"))
        .arg(&file)
        .arg(root.join("include/muslin.abi"));
    shell::run(&mut python)?;
    picture::check(&file)
}

fn test_raylib() -> Result {
    let sources = sources::RAYLIB.fetch()?;
    let parts = dir().join("raylib");
    files::create_dir(&parts)?;
    for part in RAYLIB_PARTS {
        let object = parts.join(part).with_extension("o");
        if !object.exists() {
            let mut cc = shell::command("cc");
            cc.args(RAYLIB_FLAGS).arg("-DSUPPORT_MODULE_RAUDIO=0");
            cc.arg("-I").arg(sources.join("external/glfw/include")).arg("-c");
            shell::run(cc.arg(sources.join(part).with_extension("c")).arg("-o").arg(&object))?;
        }
    }
    for name in ["raylib", "figure"] {
        let (source, program) =
            (example(&format!("{name}.c")), dir().join(format!("{name}-example")));
        let mut cc = c::strict_compiler(&source);
        cc.arg("-isystem").arg(&sources).arg("-o").arg(&program).arg(&source);
        cc.args(RAYLIB_PARTS.map(|part| parts.join(part).with_extension("o")));
        cc.arg(c::release_dir().join("libmuslin.a")).args(["-lX11", "-lm", "-lpthread", "-ldl"]);
        shell::run(&mut cc)?;
        draw(&program, &["--shot"], &format!("{name}.png"))?;
    }
    Ok(())
}

fn test_ogre() -> Result {
    let query =
        |options: &[&str]| shell::output(shell::command("pkg-config").args(options).arg("OGRE"));
    let plugins = format!("-DOGRE_PLUGINS=\"{}\"", query(&["--variable=plugindir"])?.trim());
    let (headers, libraries) = (query(&["--cflags-only-I"])?, query(&["--libs"])?);
    let program = dir().join("ogre-example");
    let mut cc = c::strict_compiler(&example("ogre.cpp"));
    for folder in headers.split_whitespace() {
        cc.arg(folder.replacen("-I", "-isystem", 1));
    }
    cc.arg(plugins).arg("-o").arg(&program).arg(example("ogre.cpp"));
    cc.arg(c::release_dir().join("libmuslin.a")).args(libraries.split_whitespace());
    shell::run(cc.args(["-lm", "-lpthread", "-ldl"]))?;
    draw(&program, &[], "ogre.png")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lines_between_the_two_comments_are_counted() {
        let text =
            "a;\n  /* From nothing... */\n  b;\n\n  c;\n  /* ...to the first frame. */\nd;\n";
        assert_eq!(lines_to_first_frame(text), Some(2));
        assert_eq!(lines_to_first_frame("a;\n"), None);
    }
}
