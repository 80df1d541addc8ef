//! Command line of the demo: opens a window by default, or writes a picture.
//!
//! Method: one pass over the arguments; every control of [`controls`] is an option too.
//!
//! Reads the arguments; writes a [`Task`].
//!
//! Invariant: an argument that is wrong gives an error that names it; nothing is ignored silently.

use std::path::PathBuf;

use crate::controls::{self, Kind};
use crate::gesture::Gesture;
use crate::receipt;
use crate::scene_kind::SceneKind;
use crate::settings::Settings;
use crate::shot::{ReceiptShot, Shot};

/// Text that `--help` prints.
pub const USAGE: &str = "\
The demo of Muslin: a hanging sheet to pull, blow at and tear, and a receipt to fold, crumple and toss.

  (no option)         a window; settings are kept from run to run
  --shot FILE.png     draw a picture without a window and stop
    --size WxH        its size in pixels (1280x720)
    --frames N        ticks of 1/60 s that the scene plays first (240); tender's are 1/120 s
    --play GESTURE    hands play in the last of them: tear, yank or cut; --tear is --play tear;
                      with tender: fold, letter, crumple or toss
    --strip N         a film strip: N pictures of that size side by side (1)
    --fabrics         the sheet in each fabric, and the receipt, side by side
    --times           draw every tick, and say what the stages of a frame take, and how many there
                      are a second
    --orbit X,Y       drag the camera, in heights of the screen (0,0, or as a gesture is seen best)
    --zoom F          multiply the camera's distance (1, or the same)
  --scene NAME        sheet, flag, ball, discs, curtain, figure, glass, doorway, storm or
                      tender, or their numbers from 0; with tender:
    --wind            it blows
    --brief           links as the brief lays them, not real paper
    --small           24 x 36 particles, as on small screens
  --NAME VALUE        give a control a value: wind, gravity, stiffness, damping,
                      fabric (0 silk, 1 cotton, 2 denim, 3 nylon), pinning (0 top edge,
                      1 top corners, 2 corners), resolution (0 to 4: 24, 40, 56, 96, 128)
  --wireframe         draw the links
  --tearing           let over-stretched links tear
  --web               serve the demo as a page (through `cargo xtask demo --web`)
  --help              this text";

/// What the program must do.
#[derive(Debug, PartialEq)]
pub enum Task {
    /// Print the usage text.
    Help,
    /// Open a window; the given controls override the saved settings.
    ClothWindow(Vec<(&'static str, f32)>),
    /// Open a window with the receipt.
    ReceiptWindow(ReceiptShot),
    /// Write a picture to a file.
    Shot(PathBuf, Box<Shot>),
    /// Serve the page; another command builds it.
    Web,
}

/// Parses the arguments.
///
/// # Errors
/// A sentence that names the argument and the rule.
pub fn parse(args: impl IntoIterator<Item = String>) -> Result<Task, String> {
    // `--size=1x1` means `--size 1x1`.
    let mut args = args.into_iter().flat_map(|arg| match arg.split_once('=') {
        Some((name, value)) if name.starts_with("--") => vec![name.into(), value.into()],
        _ => vec![arg],
    });
    let args: Vec<String> = args.by_ref().collect();
    let of_receipt = args.windows(2).any(|two| two[0] == "--scene" && is_receipt(&two[1]));
    let mut args = args.into_iter();
    let mut shot = Shot { receipt: of_receipt.then(ReceiptShot::default), ..Shot::default() };
    let (mut ticks, mut orbit, mut zoom) = (None, None, None);
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
            "--frames" => ticks = Some(number(&arg, &value()?)?),
            "--orbit" => {
                let text = value()?;
                let (x, y) = text.split_once(',').ok_or("--orbit must look like 0.3,-0.1")?;
                orbit = Some(glam::Vec2::new(finite(&arg, x)?, finite(&arg, y)?));
            }
            "--zoom" => zoom = Some(finite(&arg, &value()?)?),
            "--tear" => shot.play = Some(Gesture::Tear),
            "--play" => match &mut shot.receipt {
                None => shot.play = Some(named("--play", &Gesture::ALL, &value()?)?),
                Some(receipt) => {
                    let all = receipt::gestures::ReceiptGesture::ALL;
                    receipt.play = Some(named("--play", &all, &value()?)?);
                }
            },
            "--scene" => {
                let place = scene(&value()?)?;
                values.push(("scene", place as f32));
                continue;
            }
            "--times" => shot.times = true,
            "--fabrics" => shot.fabrics = true,
            "--strip" => shot.strip = frames(&value()?)?,
            other if shot.receipt.is_some() => {
                let Some(receipt) = &mut shot.receipt else { continue };
                match other {
                    "--wind" => receipt.settings.wind = true,
                    "--brief" => receipt.settings.sheet = muslin_scenes::Sheet::Brief,
                    "--small" => receipt.small = true,
                    _ => return Err(format!("{other} does not go with --scene tender")),
                }
                continue;
            }
            other => {
                let control = other
                    .strip_prefix("--")
                    .and_then(controls::find_control)
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
    let gesture = shot.receipt.as_ref().and_then(|receipt| receipt.play);
    // Gestures of the receipt take longer than the default number of ticks.
    let usual = gesture.map_or(shot.ticks, |gesture| 60 + gesture.ticks());
    shot.ticks = ticks.unwrap_or(usual);
    let seen = gesture.map_or((shot.orbit, shot.zoom), |gesture| gesture.view());
    (shot.orbit, shot.zoom) = (orbit.unwrap_or(seen.0), zoom.unwrap_or(seen.1));
    match (file, only_for_shots) {
        (Some(file), _) => {
            apply(&values, &mut shot.settings);
            Ok(Task::Shot(file, Box::new(shot)))
        }
        (None, Some(option)) => Err(format!("{option} needs --shot FILE.png")),
        (None, None) => Ok(shot.receipt.map_or(Task::ClothWindow(values), Task::ReceiptWindow)),
    }
}

/// Sets the controls to the given values.
pub fn apply(values: &[(&'static str, f32)], settings: &mut Settings) {
    for (name, value) in values {
        if let Some(control) = controls::find_control(name) {
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

/// Returns the entry with this name.
fn named<T: Copy>(option: &str, all: &[(&'static str, T)], name: &str) -> Result<T, String> {
    let known = all.iter().find(|(known, _)| *known == name);
    let names: Vec<_> = all.iter().map(|(name, _)| *name).collect();
    let names = names.join(", ");
    known.map(|(_, it)| *it).ok_or_else(|| format!("{option} must be one of {names}, not {name:?}"))
}

/// Name of the receipt among the scenes; its number follows the numbers of the other scenes.
const RECEIPT: &str = "tender";

/// Returns the number of a scene from its name or number.
fn scene(text: &str) -> Result<usize, String> {
    let names = SceneKind::NAMES.map(str::to_lowercase);
    let names: Vec<&str> = names.iter().map(String::as_str).chain([RECEIPT]).collect();
    let number = text.parse().ok().filter(|number| *number < names.len());
    number.or_else(|| names.iter().position(|name| *name == text)).ok_or_else(|| {
        format!("--scene must be one of {} or their numbers from 0, not {text:?}", names.join(", "))
    })
}

fn is_receipt(text: &str) -> bool {
    scene(text) == Ok(SceneKind::ALL.len())
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
    fn a_shot_accepts_its_options_and_every_control() {
        let task = parsed("--shot a.png --size=390x844 --frames 60 --tear --wind 2 --wireframe");
        let Ok(Task::Shot(file, shot)) = task else {
            panic!("{task:?}");
        };
        assert_eq!(file, PathBuf::from("a.png"));
        assert_eq!((shot.size, shot.ticks, shot.play), ([390, 844], 60, Some(Gesture::Tear)));
        assert!(shot.settings.wireframe && (shot.settings.wind - 2.0).abs() < 1.0e-5);
    }

    #[test]
    fn no_argument_opens_a_window() {
        assert_eq!(parsed(""), Ok(Task::ClothWindow(Vec::new())));
    }

    #[test]
    fn scenes_have_names_and_numbers_and_the_receipt_has_its_own_options() {
        for (line, place) in [
            ("--scene flag", 1.0),
            ("--scene 2", 2.0),
            ("--scene=sheet", 0.0),
            ("--scene curtain", 4.0),
            ("--scene figure", 5.0),
            ("--scene storm", 8.0),
        ] {
            assert_eq!(parsed(line), Ok(Task::ClothWindow(vec![("scene", place)])));
        }
        for line in ["--scene tender --wind --small", "--wind --scene=9 --small"] {
            let Ok(Task::ReceiptWindow(receipt)) = parsed(line) else { panic!("{line}") };
            assert!(receipt.settings.wind && receipt.small);
        }
        let task = parsed("--scene tender --shot a.png --play fold --brief");
        let Ok(Task::Shot(_, shot)) = task else { panic!("{task:?}") };
        let receipt = shot.receipt.unwrap();
        assert_eq!(receipt.play, Some(receipt::gestures::ReceiptGesture::Fold));
        assert_eq!(receipt.settings.sheet, muslin_scenes::Sheet::Brief);
        assert_eq!(shot.ticks, 60 + receipt::gestures::ReceiptGesture::Fold.ticks());
        // A gesture may have its own camera view, but explicit options override it.
        for (line, zoom) in
            [("", receipt::gestures::ReceiptGesture::Letter.view().1), (" --zoom 2", 2.0)]
        {
            let task = parsed(&format!("--scene tender --shot a.png --play letter{line}"));
            let Ok(Task::Shot(_, shot)) = task else { panic!("{task:?}") };
            assert_eq!(
                (shot.orbit, shot.zoom),
                (receipt::gestures::ReceiptGesture::Letter.view().0, zoom)
            );
        }
    }

    #[test]
    fn an_error_names_the_wrong_argument() {
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
            ("--scene rug", "--scene"),
            ("--scene 10", "--scene"),
            ("--scene tender --gravity 3", "--gravity"),
            ("--scene tender --shot a.png --play tear", "--play"),
            ("--reset", "--reset"),
        ] {
            let error = parsed(line).unwrap_err();
            assert!(error.contains(named), "{line}: {error}");
        }
    }
}
