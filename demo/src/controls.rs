//! Table of controls: the window draws its rows with egui, the page draws its rows with HTML, and
//! keys are looked up in the same table.
//!
//! Method: each [`Control`] has functions that read and write one field of [`Settings`].
//!
//! Reads values and keys; writes [`Settings`].
//!
//! Invariant: a control never sets a value outside its range, and names and keys are unique.

use serde::Serialize;

use crate::fabric::Fabric;
use crate::scene_kind::SceneKind;
use crate::settings::{DAMPING, GRAVITY, Pinning, RESOLUTIONS, STIFFNESS, Settings, WIND};

/// One control.
pub struct Control {
    /// Name in code; the page, the command line and the tests use it.
    pub name: &'static str,
    /// Label on the panel.
    pub label: &'static str,
    /// Short description.
    pub about: &'static str,
    /// Key. It increases a slider (with Shift: decreases it) and selects the next option of a
    /// choice.
    pub key: char,
    /// Type of the control, with access to its value.
    pub kind: Kind,
}

/// Types of controls.
pub enum Kind {
    /// A number in a range.
    Slider {
        /// Least value.
        min: f32,
        /// Greatest value.
        max: f32,
        /// Distance between neighbouring values.
        step: f32,
        /// Decimal places to show.
        digits: usize,
        /// Unit to show; may be empty.
        unit: &'static str,
        /// Reads the value.
        get: fn(&Settings) -> f32,
        /// Writes the value; [`Control::set`] has clamped it.
        set: fn(&mut Settings, f32),
    },
    /// On or off.
    Switch {
        /// Reads the value.
        get: fn(&Settings) -> bool,
        /// Writes the value.
        set: fn(&mut Settings, bool),
    },
    /// One of several options.
    Choice {
        /// Names of the options.
        options: &'static [&'static str],
        /// Reads the index of the option.
        get: fn(&Settings) -> usize,
        /// Writes the index of the option; [`Control::set`] has clamped it.
        set: fn(&mut Settings, usize),
    },
    /// A button that runs an action.
    Button(Action),
}

/// Actions of buttons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Rebuilds the scene.
    Reset,
    /// Unpins all particles.
    DropPins,
    /// Begins or ends the photo mode.
    Photo,
}

const PINNINGS: [Pinning; 3] = [Pinning::TopEdge, Pinning::TopCorners, Pinning::Corners];

/// All controls, in the order of the panel.
pub static CONTROLS: &[Control] = &[
    Control {
        name: "wind",
        label: "Wind",
        about: "How hard it blows",
        key: 'W',
        kind: Kind::Slider {
            min: *WIND.start(),
            max: *WIND.end(),
            step: 0.05,
            digits: 2,
            unit: "",
            get: |s| s.wind,
            set: |s, v| s.wind = v,
        },
    },
    Control {
        name: "gravity",
        label: "Gravity",
        about: "How hard it pulls down",
        key: 'G',
        kind: Kind::Slider {
            min: *GRAVITY.start(),
            max: *GRAVITY.end(),
            step: 0.1,
            digits: 1,
            unit: "m/s²",
            get: |s| s.gravity,
            set: |s, v| s.gravity = v,
        },
    },
    Control {
        name: "stiffness",
        label: "Stiffness",
        about: "Sweeps over the links in each step",
        key: 'S',
        kind: Kind::Slider {
            min: *STIFFNESS.start(),
            max: *STIFFNESS.end(),
            step: 1.0,
            digits: 0,
            unit: "",
            get: |s| s.stiffness as f32,
            set: |s, v| s.stiffness = v as u32,
        },
    },
    Control {
        name: "damping",
        label: "Damping",
        about: "Velocity lost in each step",
        key: 'D',
        kind: Kind::Slider {
            min: *DAMPING.start(),
            max: *DAMPING.end(),
            step: 0.001,
            digits: 3,
            unit: "",
            get: |s| s.damping,
            set: |s, v| s.damping = v,
        },
    },
    Control {
        name: "wireframe",
        label: "Wireframe",
        about: "Shows the links",
        key: 'F',
        kind: Kind::Switch { get: |s| s.wireframe, set: |s, on| s.wireframe = on },
    },
    Control {
        name: "tearing",
        label: "Tearing",
        about: "Pull hard and it rips",
        key: 'T',
        kind: Kind::Switch { get: |s| s.tearing, set: |s, on| s.tearing = on },
    },
    Control {
        name: "blade",
        label: "Blade",
        about: "Swipe to cut; Shift does it for one swipe",
        key: 'B',
        kind: Kind::Switch { get: |s| s.blade, set: |s, on| s.blade = on },
    },
    Control {
        name: "paused",
        label: "Pause",
        about: "Time stands still",
        key: ' ',
        kind: Kind::Switch { get: |s| s.paused, set: |s, on| s.paused = on },
    },
    Control {
        name: "scene",
        label: "Scene",
        about: "What is on the stage",
        key: 'E',
        kind: Kind::Choice {
            options: &SceneKind::NAMES,
            get: |s| SceneKind::ALL.iter().position(|show| *show == s.scene).unwrap_or(0),
            set: |s, i| {
                s.scene = SceneKind::ALL[i];
                s.fabric = s.scene.fabric();
            },
        },
    },
    Control {
        name: "fabric",
        label: "Fabric",
        about: "What the cloth is of",
        key: 'L',
        kind: Kind::Choice {
            options: &Fabric::NAMES,
            get: |s| Fabric::ALL.iter().position(|f| *f == s.fabric).unwrap_or(0),
            set: |s, i| s.fabric = Fabric::ALL[i],
        },
    },
    Control {
        name: "pinning",
        label: "Pins",
        about: "What holds the sheet up",
        key: 'P',
        kind: Kind::Choice {
            options: &["Top edge", "Top corners", "Corners"],
            get: |s| PINNINGS.iter().position(|p| *p == s.pinning).unwrap_or(0),
            set: |s, i| s.pinning = PINNINGS[i],
        },
    },
    Control {
        name: "resolution",
        label: "Resolution",
        about: "Particles along a side",
        key: 'N',
        kind: Kind::Choice {
            options: &["24", "40", "56", "96", "128"],
            get: |s| RESOLUTIONS.iter().position(|r| *r == s.resolution).unwrap_or(1),
            set: |s, i| s.resolution = RESOLUTIONS[i],
        },
    },
    Control {
        name: "reset",
        label: "Reset",
        about: "Hangs a fresh sheet",
        key: 'R',
        kind: Kind::Button(Action::Reset),
    },
    Control {
        name: "drop",
        label: "Drop pins",
        about: "Lets the sheet fall",
        key: 'X',
        kind: Kind::Button(Action::DropPins),
    },
    Control {
        name: "photo",
        label: "Photo",
        about: "Holds time, hides the panel, saves a large picture",
        key: 'O',
        kind: Kind::Button(Action::Photo),
    },
];

/// Finds a control by its name.
pub fn find_control(name: &str) -> Option<&'static Control> {
    CONTROLS.iter().find(|c| c.name == name)
}

/// Finds a control by its key, upper or lower case.
pub fn find_control_by_key(key: char) -> Option<&'static Control> {
    CONTROLS.iter().find(|c| c.key.eq_ignore_ascii_case(&key))
}

impl Control {
    /// Returns the value as a number: a switch is 0 or 1, a choice is the index of its option, a
    /// button is 0.
    pub fn get(&self, settings: &Settings) -> f32 {
        match &self.kind {
            Kind::Slider { get, .. } => get(settings),
            Kind::Switch { get, .. } => f32::from(u8::from(get(settings))),
            Kind::Choice { get, .. } => get(settings) as f32,
            Kind::Button(_) => 0.0,
        }
    }

    /// Sets the nearest allowed value; NaN changes nothing.
    pub fn set(&self, settings: &mut Settings, value: f32) {
        if value.is_nan() {
            return;
        }
        match &self.kind {
            Kind::Slider { min, max, step, set, .. } => {
                let steps = ((value.clamp(*min, *max) - min) / step).round();
                // Rounding to four decimal places is exact enough for every step and avoids values
                // such as 9.900001.
                let tidy = ((min + steps * step) * 1.0e4).round() / 1.0e4;
                set(settings, tidy.clamp(*min, *max));
            }
            Kind::Switch { set, .. } => set(settings, value != 0.0),
            Kind::Choice { options, set, .. } => {
                set(settings, value.clamp(0.0, (options.len() - 1) as f32) as usize);
            }
            Kind::Button(_) => {}
        }
    }

    /// Returns whether the control has an effect in the current scene.
    pub fn is_enabled(&self, settings: &Settings) -> bool {
        match self.name {
            "fabric" => settings.scene != SceneKind::Discs,
            "resolution" => settings.scene != SceneKind::Figure,
            "pinning" => {
                matches!(settings.scene, SceneKind::Sheet | SceneKind::Flag | SceneKind::Storm)
            }
            "drop" => !matches!(
                settings.scene,
                SceneKind::Ball | SceneKind::Discs | SceneKind::Figure | SceneKind::Glass
            ),
            _ => true,
        }
    }

    /// Applies a key press: a slider moves by a tenth of its range, backwards with `shift`. Returns
    /// the action of a button.
    pub fn press(&self, settings: &mut Settings, shift: bool) -> Option<Action> {
        let now = self.get(settings);
        match &self.kind {
            Kind::Slider { min, max, step, .. } => {
                let stride = (0.1 * (max - min)).max(*step);
                self.set(settings, if shift { now - stride } else { now + stride });
            }
            Kind::Switch { .. } => self.set(settings, 1.0 - now),
            Kind::Choice { options, .. } => {
                let by = if shift { options.len() - 1 } else { 1 };
                self.set(settings, ((now as usize + by) % options.len()) as f32);
            }
            Kind::Button(action) => return Some(*action),
        }
        None
    }

    /// Returns the name of the key.
    pub fn key_name(&self) -> String {
        match self.key {
            ' ' => "Space".into(),
            key => key.into(),
        }
    }

    /// Returns the value as text, with its unit.
    pub fn text(&self, settings: &Settings) -> String {
        match &self.kind {
            Kind::Slider { digits, unit, .. } => {
                let number = format!("{:.*}", *digits, self.get(settings));
                if unit.is_empty() { number } else { format!("{number} {unit}") }
            }
            Kind::Choice { options, get, .. } => options[get(settings)].into(),
            Kind::Switch { .. } | Kind::Button(_) => String::new(),
        }
    }
}

/// One control in the JSON document for the page.
#[derive(Serialize)]
struct Row {
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: String,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    options: &'static [&'static str],
}

/// Returns the table as JSON: name, label, about, key, kind, and `range` (least, greatest, step) or
/// `options`.
pub fn to_json() -> String {
    let rows: Vec<Row> = CONTROLS
        .iter()
        .map(|c| {
            let (kind, range, options): (_, _, &[&str]) = match &c.kind {
                Kind::Slider { min, max, step, .. } => ("slider", Some([*min, *max, *step]), &[]),
                Kind::Switch { .. } => ("switch", None, &[]),
                Kind::Choice { options, .. } => ("choice", None, options),
                Kind::Button(_) => ("button", None, &[]),
            };
            Row {
                name: c.name,
                label: c.label,
                about: c.about,
                key: c.key_name(),
                kind,
                range,
                options,
            }
        })
        .collect();
    // Strings and finite numbers only, so the conversion cannot fail.
    serde_json::to_string(&rows).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_unique() {
        for (i, a) in CONTROLS.iter().enumerate() {
            for b in &CONTROLS[i + 1..] {
                assert!(a.name != b.name && a.key != b.key, "{} and {}", a.name, b.name);
            }
            assert!(std::ptr::eq(find_control(a.name).unwrap(), a));
            assert!(std::ptr::eq(find_control_by_key(a.key.to_ascii_lowercase()).unwrap(), a));
        }
    }

    #[test]
    fn every_control_returns_the_value_that_was_set() {
        for control in CONTROLS {
            let mut settings = Settings::default();
            let (given, wanted) = match &control.kind {
                Kind::Slider { max, step, .. } => (max - 2.0 * step, max - 2.0 * step),
                Kind::Switch { .. } => (1.0, 1.0),
                Kind::Choice { options, .. } => {
                    (options.len() as f32 - 1.0, options.len() as f32 - 1.0)
                }
                Kind::Button(_) => continue,
            };
            control.set(&mut settings, given);
            let got = control.get(&settings);
            assert!((got - wanted).abs() < 1.0e-5, "{} is {got}", control.name);
            assert_ne!(settings, Settings::default(), "{} changes nothing", control.name);
        }
    }

    #[test]
    fn a_control_stays_in_its_range() {
        for control in CONTROLS {
            for wild in [f32::INFINITY, f32::NEG_INFINITY, 1.0e9, -1.0e9, f32::NAN] {
                let mut settings = Settings::default();
                control.set(&mut settings, wild);
                let mut clamped = settings.clone();
                clamped.clamp();
                assert_eq!(settings, clamped, "{} took {wild}", control.name);
            }
        }
    }

    #[test]
    fn controls_without_effect_in_a_scene_are_disabled() {
        let is_enabled = |name: &str, scene| {
            find_control(name).unwrap().is_enabled(&Settings { scene, ..Settings::default() })
        };
        for scene in SceneKind::ALL {
            assert!(
                is_enabled("wind", scene)
                    && is_enabled("scene", scene)
                    && is_enabled("reset", scene)
            );
        }
        assert!(
            is_enabled("fabric", SceneKind::Curtain) && !is_enabled("fabric", SceneKind::Discs)
        );
        assert!(is_enabled("pinning", SceneKind::Flag) && !is_enabled("pinning", SceneKind::Ball));
        assert!(is_enabled("drop", SceneKind::Curtain) && !is_enabled("drop", SceneKind::Discs));
        assert!(is_enabled("fabric", SceneKind::Figure));
        assert!(is_enabled("pinning", SceneKind::Storm) && is_enabled("drop", SceneKind::Doorway));
        assert!(!is_enabled("drop", SceneKind::Glass));
        for name in ["resolution", "pinning", "drop"] {
            assert!(!is_enabled(name, SceneKind::Figure), "{name}");
        }
    }

    #[test]
    fn keys_increase_decrease_and_wrap_around() {
        let mut settings = Settings::default();
        let wind = find_control_by_key('w').unwrap();
        wind.press(&mut settings, false);
        assert!((settings.wind - 1.1).abs() < 1.0e-5);
        wind.press(&mut settings, true);
        assert!((settings.wind - 0.8).abs() < 1.0e-5);
        let pins = find_control_by_key('P').unwrap();
        for wanted in [Pinning::TopCorners, Pinning::Corners, Pinning::TopEdge] {
            pins.press(&mut settings, false);
            assert_eq!(settings.pinning, wanted);
        }
        assert_eq!(
            find_control_by_key('r').unwrap().press(&mut settings, false),
            Some(Action::Reset)
        );
    }
}
