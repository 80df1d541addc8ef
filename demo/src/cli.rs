//! The command line: a window by default, or a picture.

use std::path::PathBuf;

use crate::controls::{self, Kind};
use crate::gesture::Gesture;
use crate::settings::Settings;
use crate::shot::Shot;

/// What `--help` prints.
pub const USAGE: &str = "\
The demo of Muslin: a hanging sheet to pull, blow at and tear.

  (no option)         a window; settings are kept from run to run
  --shot FILE.png     draw a picture without a window and stop
    --size WxH        its size in pixels (1280x720)
    --frames N        ticks of 1/60 s that the scene plays first (240)
    --play GESTURE    hands play in the last of them: tear, yank or cut; --tear is --play tear
    --strip N         a film strip: N pictures of that size side by side (1)
    --times           draw every tick, and say what the stages of a frame take
    --orbit X,Y       drag the camera, in heights of the screen (0,0)
    --zoom F          multiply the camera's distance (1)
  --NAME VALUE        give a control a value: wind, gravity, stiffness, damping,
                      fabric (0 silk, 1 cotton, 2 denim, 3 flag), pinning (0 top edge,
                      1 top corners, 2 corners), resolution (0 to 4: 24, 40, 56, 96, 128)
  --wireframe         draw the links
  --tearing           let over-stretched links tear
  --web               serve the demo as a page (through `cargo xtask demo --web`)
  --help              this text";

/// What the user asks for.
#[derive(Debug, PartialEq)]
pub enum Task {
    /// The usage text.
    Help,
    /// A window, with the controls that were given on top of the kept ones.
    Window(Vec<(&'static str, f32)>),
    /// A picture.
    Shot(PathBuf, Box<Shot>),
    /// A page, which another command builds and serves.
    Web,
}

/// Reads the arguments.
///
/// # Errors
/// A sentence that names the argument and the rule.
pub fn parse(args: impl IntoIterator<Item = String>) -> Result<Task, String> {
    // `--size=1x1` is `--size 1x1`.
    let mut args = args.into_iter().flat_map(|arg| match arg.split_once('=') {
        Some((name, value)) if name.starts_with("--") => vec![name.into(), value.into()],
        _ => vec![arg],
    });
    let mut shot = Shot::default();
    let mut file = None;
    let mut values = Vec::new();
    let mut only_for_shots = None;
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("{arg} needs a value"));
        match arg.as_str() {
            "--help" | "-h" => return Ok(Task::Help),
            "--web" => return Ok(Task::Web),
            "--shot" => file = Some(PathBuf::from(value()?)),
            "--size" => shot.size = size(&value()?)?,
            "--frames" => shot.ticks = number(&arg, &value()?)?,
            "--orbit" => {
                let text = value()?;
                let (x, y) = text.split_once(',').ok_or("--orbit must look like 0.3,-0.1")?;
                shot.orbit = glam::Vec2::new(finite(&arg, x)?, finite(&arg, y)?);
            }
            "--zoom" => shot.zoom = finite(&arg, &value()?)?,
            "--tear" => shot.play = Some(Gesture::Tear),
            "--play" => shot.play = Some(gesture(&value()?)?),
            "--times" => shot.times = true,
            "--strip" => shot.strip = frames(&value()?)?,
            other => {
                let control = other
                    .strip_prefix("--")
                    .and_then(controls::find)
                    .ok_or_else(|| format!("{other} is no option; --help lists them"))?;
                match control.kind {
                    Kind::Switch { .. } => values.push((control.name, 1.0)),
                    Kind::Button(_) => return Err(format!("{other} is a button, not an option")),
                    _ => values.push((control.name, finite(other, &value()?)?)),
                }
                continue;
            }
        }
        if arg != "--shot" {
            only_for_shots = Some(arg);
        }
    }
    match (file, only_for_shots) {
        (Some(file), _) => {
            apply(&values, &mut shot.settings);
            Ok(Task::Shot(file, Box::new(shot)))
        }
        (None, Some(option)) => Err(format!("{option} needs --shot FILE.png")),
        (None, None) => Ok(Task::Window(values)),
    }
}

/// Gives the controls their values.
pub fn apply(values: &[(&'static str, f32)], settings: &mut Settings) {
    for (name, value) in values {
        if let Some(control) = controls::find(name) {
            control.set(settings, *value);
        }
    }
}

fn number(option: &str, text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("{option} must be a whole number, not {text:?}"))
}

fn finite(option: &str, text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|v: &f32| v.is_finite())
        .ok_or_else(|| format!("{option} must be a number, not {text:?}"))
}

fn gesture(name: &str) -> Result<Gesture, String> {
    let known = Gesture::ALL.iter().find(|(known, _)| *known == name);
    let names = Gesture::ALL.map(|(name, _)| name).join(", ");
    known.map(|(_, g)| *g).ok_or_else(|| format!("--play must be one of {names}, not {name:?}"))
}

fn frames(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|n| (1..=16).contains(n));
    count.ok_or_else(|| format!("--strip must be 1 to 16, not {text:?}"))
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |side: &str| side.parse().ok().filter(|n| (16..=8192).contains(n));
    text.split_once('x')
        .and_then(|(w, h)| Some([side(w)?, side(h)?]))
        .ok_or_else(|| format!("--size must look like 1280x720, 16 to 8192 a side, not {text:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Task, String> {
        parse(line.split_whitespace().map(String::from))
    }

    #[test]
    fn a_shot_takes_its_options_and_any_control() {
        let task = parsed("--shot a.png --size=390x844 --frames 60 --tear --wind 2 --wireframe");
        let Ok(Task::Shot(file, shot)) = task else {
            panic!("{task:?}");
        };
        assert_eq!(file, PathBuf::from("a.png"));
        assert_eq!((shot.size, shot.ticks, shot.play), ([390, 844], 60, Some(Gesture::Tear)));
        assert!(shot.settings.wireframe && (shot.settings.wind - 2.0).abs() < 1.0e-5);
    }

    #[test]
    fn no_argument_is_a_window() {
        assert_eq!(parsed(""), Ok(Task::Window(Vec::new())));
    }

    #[test]
    fn a_wrong_argument_is_named() {
        for (line, named) in [
            ("--shot", "--shot"),
            ("--shot a.png --size 12", "--size"),
            ("--shot a.png --size 1x99999", "--size"),
            ("--shot a.png --frames many", "--frames"),
            ("--wind strong", "--wind"),
            ("--frames 3", "--shot"),
            ("--shot a.png --play dead", "--play"),
            ("--shot a.png --strip 0", "--strip"),
            ("--sail", "--sail"),
            ("--reset", "--reset"),
        ] {
            let error = parsed(line).unwrap_err();
            assert!(error.contains(named), "{line}: {error}");
        }
    }
}
