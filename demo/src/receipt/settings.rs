//! What the user may change, and the one pick of controls: pills, rows and keys are looked up in it.

use muslin_scenes::Sheet;
use serde::Serialize;

/// The controls' values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReceiptSettings {
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
pub enum ReceiptAction {
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
pub struct ReceiptControl {
    /// Its name for code.
    pub name: &'static str,
    /// Its name for people.
    pub label: &'static str,
    /// What it does, in a few words.
    pub about: &'static str,
    /// Its key.
    pub key: char,
    /// What it does.
    pub action: ReceiptAction,
    /// Whether it is a pill; the others are keys alone.
    pub is_pill: bool,
}

const fn control(
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: char,
    action: ReceiptAction,
    is_pill: bool,
) -> ReceiptControl {
    ReceiptControl { name, label, about, key, action, is_pill }
}

/// Every control, in the order of the pills.
pub const RECEIPT_CONTROLS: [ReceiptControl; 8] = [
    control("wind", "Wind", "Wind on or off", 'W', ReceiptAction::Wind, true),
    control("drop", "Drop", "Takes it off its pins", 'X', ReceiptAction::Drop, true),
    control("crumple", "Crumple", "Squeezes it into a ball", 'C', ReceiptAction::Crumple, true),
    control("fold", "Fold", "Folds it in half, and in half again", 'F', ReceiptAction::Fold, true),
    control(
        "sheet",
        "Real paper",
        "Real paper, or the brief's links",
        'P',
        ReceiptAction::Sheet,
        true,
    ),
    control("reset", "Reset", "Hangs it up again as new", 'R', ReceiptAction::Reset, true),
    control("paused", "Pause", "Time stands still", ' ', ReceiptAction::Pause, false),
    control(
        "counter",
        "Counter",
        "Frames, particles, constraints",
        'I',
        ReceiptAction::Counter,
        false,
    ),
];

/// The control of this key, whatever its case.
pub fn find_control_by_key(key: char) -> Option<&'static ReceiptControl> {
    RECEIPT_CONTROLS.iter().find(|control| control.key.eq_ignore_ascii_case(&key))
}

/// The control of this name.
pub fn find_control(name: &str) -> Option<&'static ReceiptControl> {
    RECEIPT_CONTROLS.iter().find(|control| control.name == name)
}

impl ReceiptControl {
    /// Its key as it is printed.
    pub fn key_name(&self) -> String {
        match self.key {
            ' ' => "Space".into(),
            key => key.into(),
        }
    }

    /// Whether it is on; `None` for what only happens once.
    pub fn is_on(&self, settings: &ReceiptSettings) -> Option<bool> {
        match self.action {
            ReceiptAction::Wind => Some(settings.wind),
            ReceiptAction::Sheet => Some(settings.sheet == Sheet::Paper),
            ReceiptAction::Pause => Some(settings.paused),
            ReceiptAction::Counter => Some(settings.counter),
            ReceiptAction::Reset
            | ReceiptAction::Drop
            | ReceiptAction::Crumple
            | ReceiptAction::Fold => None,
        }
    }
}

/// A control as the page gets it.
#[derive(Serialize)]
struct ReceiptControlRow {
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: String,
    pill: bool,
    switch: bool,
}

/// The pick as JSON.
pub fn to_json() -> String {
    let rows = RECEIPT_CONTROLS.map(|control| ReceiptControlRow {
        name: control.name,
        label: control.label,
        about: control.about,
        key: control.key_name(),
        pill: control.is_pill,
        switch: control.is_on(&ReceiptSettings::default()).is_some(),
    });
    // Strings and booleans: there is nothing in it that JSON could not say.
    serde_json::to_string(&rows).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_each_used_once() {
        for (i, a) in RECEIPT_CONTROLS.iter().enumerate() {
            assert_eq!(find_control(a.name), Some(a));
            assert_eq!(find_control_by_key(a.key.to_ascii_lowercase()), Some(a));
            for b in &RECEIPT_CONTROLS[i + 1..] {
                assert!(a.name != b.name && a.key != b.key, "{} and {}", a.name, b.name);
            }
        }
    }

    #[test]
    fn the_briefs_keys_do_what_it_says() {
        for (key, action) in [
            ('r', ReceiptAction::Reset),
            (' ', ReceiptAction::Pause),
            ('i', ReceiptAction::Counter),
            ('w', ReceiptAction::Wind),
        ] {
            assert_eq!(find_control_by_key(key).map(|control| control.action), Some(action));
        }
        let usual = ReceiptSettings::default();
        assert!(!usual.wind && !usual.paused && usual.sheet == Sheet::Paper);
    }
}
