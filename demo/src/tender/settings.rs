//! What the user may change, and the one table of controls: pills, rows and keys are looked up in it.

use muslin_scenes::Sheet;
use serde::Serialize;

/// The controls' values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// What the receipt is made of.
    pub sheet: Sheet,
    /// It blows.
    pub wind: bool,
    /// Time stands still.
    pub paused: bool,
    /// The counter shows.
    pub counter: bool,
}

/// What a control does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Wind on or off.
    Wind,
    /// Back to the pins.
    Reset,
    /// Off the pins.
    Drop,
    /// Into a ball.
    Crumple,
    /// In half, and in half again.
    Fold,
    /// The other sheet.
    Sheet,
    /// Time stands still, or goes on.
    Pause,
    /// The counter, shown or hidden.
    Counter,
}

/// A control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Control {
    /// Its name for code.
    pub name: &'static str,
    /// Its name for people.
    pub label: &'static str,
    /// What it does, in a few words.
    pub about: &'static str,
    /// Its key.
    pub key: char,
    /// What it does.
    pub action: Action,
    /// Whether it is a pill; the others are keys alone.
    pub is_pill: bool,
}

const fn control(
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: char,
    action: Action,
    is_pill: bool,
) -> Control {
    Control { name, label, about, key, action, is_pill }
}

/// Every control, in the order of the pills.
pub const CONTROLS: [Control; 8] = [
    control("wind", "Wind", "Wind on or off", 'W', Action::Wind, true),
    control("drop", "Drop", "Takes it off its pins", 'X', Action::Drop, true),
    control("crumple", "Crumple", "Squeezes it into a ball", 'C', Action::Crumple, true),
    control("fold", "Fold", "Folds it in half, and in half again", 'F', Action::Fold, true),
    control("sheet", "Real paper", "Real paper, or the brief's links", 'P', Action::Sheet, true),
    control("reset", "Reset", "Hangs it up again as new", 'R', Action::Reset, true),
    control("paused", "Pause", "Time stands still", ' ', Action::Pause, false),
    control("counter", "Counter", "Frames, particles, constraints", 'I', Action::Counter, false),
];

/// The control of this key, whatever its case.
pub fn of_key(key: char) -> Option<&'static Control> {
    CONTROLS.iter().find(|control| control.key.eq_ignore_ascii_case(&key))
}

/// The control of this name.
pub fn find(name: &str) -> Option<&'static Control> {
    CONTROLS.iter().find(|control| control.name == name)
}

impl Control {
    /// Its key as it is printed.
    pub fn key_name(&self) -> String {
        match self.key {
            ' ' => "Space".into(),
            key => key.into(),
        }
    }

    /// Whether it is on; `None` for what only happens once.
    pub fn is_on(&self, settings: &Settings) -> Option<bool> {
        match self.action {
            Action::Wind => Some(settings.wind),
            Action::Sheet => Some(settings.sheet == Sheet::Paper),
            Action::Pause => Some(settings.paused),
            Action::Counter => Some(settings.counter),
            Action::Reset | Action::Drop | Action::Crumple | Action::Fold => None,
        }
    }
}

/// A control as the page gets it.
#[derive(Serialize)]
struct Row {
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: String,
    pill: bool,
    switch: bool,
}

/// The table as JSON.
pub fn to_json() -> String {
    let rows = CONTROLS.map(|control| Row {
        name: control.name,
        label: control.label,
        about: control.about,
        key: control.key_name(),
        pill: control.is_pill,
        switch: control.is_on(&Settings::default()).is_some(),
    });
    // Strings and booleans: there is nothing in it that JSON could not say.
    serde_json::to_string(&rows).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_each_used_once() {
        for (i, a) in CONTROLS.iter().enumerate() {
            assert_eq!(find(a.name), Some(a));
            assert_eq!(of_key(a.key.to_ascii_lowercase()), Some(a));
            for b in &CONTROLS[i + 1..] {
                assert!(a.name != b.name && a.key != b.key, "{} and {}", a.name, b.name);
            }
        }
    }

    #[test]
    fn the_briefs_keys_do_what_it_says() {
        for (key, action) in [
            ('r', Action::Reset),
            (' ', Action::Pause),
            ('i', Action::Counter),
            ('w', Action::Wind),
        ] {
            assert_eq!(of_key(key).map(|control| control.action), Some(action));
        }
        let usual = Settings::default();
        assert!(!usual.wind && !usual.paused && usual.sheet == Sheet::Paper);
    }
}
