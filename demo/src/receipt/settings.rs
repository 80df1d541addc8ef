//! Settings of the receipt, and the table of its controls for buttons and keys.
//!
//! Method: each control has an action; the table is a constant.
//!
//! Reads names and keys; returns [`ReceiptControl`]s and JSON for the page.
//!
//! Invariant: names and keys are unique.

use muslin_scenes::Sheet;
use serde::Serialize;

/// Values of the controls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReceiptSettings {
    /// Type of the sheet.
    pub sheet: Sheet,
    /// Whether there is wind.
    pub wind: bool,
    /// Whether the simulation is paused.
    pub paused: bool,
    /// Whether the counter is shown.
    pub counter: bool,
}

/// Actions of the controls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReceiptAction {
    /// Switches the wind on or off.
    Wind,
    /// Returns the receipt to its pins.
    Reset,
    /// Removes the pins.
    Drop,
    /// Crumples the receipt into a ball.
    Crumple,
    /// Folds the receipt in half twice.
    Fold,
    /// Selects the other type of sheet.
    Sheet,
    /// Pauses or continues the simulation.
    Pause,
    /// Shows or hides the counter.
    Counter,
}

/// One control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReceiptControl {
    /// Name in code.
    pub name: &'static str,
    /// Label on its button.
    pub label: &'static str,
    /// Short description.
    pub about: &'static str,
    /// Key.
    pub key: char,
    /// Action.
    pub action: ReceiptAction,
    /// Whether it has a button; the others have only a key.
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

/// All controls, in the order of the buttons.
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

/// Finds a control by its key, upper or lower case.
pub fn find_control_by_key(key: char) -> Option<&'static ReceiptControl> {
    RECEIPT_CONTROLS.iter().find(|control| control.key.eq_ignore_ascii_case(&key))
}

/// Finds a control by its name.
pub fn find_control(name: &str) -> Option<&'static ReceiptControl> {
    RECEIPT_CONTROLS.iter().find(|control| control.name == name)
}

impl ReceiptControl {
    /// Returns the name of the key.
    pub fn key_name(&self) -> String {
        match self.key {
            ' ' => "Space".into(),
            key => key.into(),
        }
    }

    /// Returns whether the control is on; `None` for an action without a state.
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

/// One control in the JSON document for the page.
#[derive(Serialize)]
struct ReceiptControlRow {
    name: &'static str,
    label: &'static str,
    about: &'static str,
    key: String,
    pill: bool,
    switch: bool,
}

/// Returns the table as JSON.
pub fn to_json() -> String {
    let rows = RECEIPT_CONTROLS.map(|control| ReceiptControlRow {
        name: control.name,
        label: control.label,
        about: control.about,
        key: control.key_name(),
        pill: control.is_pill,
        switch: control.is_on(&ReceiptSettings::default()).is_some(),
    });
    // Strings and booleans only, so the conversion cannot fail.
    serde_json::to_string(&rows).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_unique() {
        for (i, a) in RECEIPT_CONTROLS.iter().enumerate() {
            assert_eq!(find_control(a.name), Some(a));
            assert_eq!(find_control_by_key(a.key.to_ascii_lowercase()), Some(a));
            for b in &RECEIPT_CONTROLS[i + 1..] {
                assert!(a.name != b.name && a.key != b.key, "{} and {}", a.name, b.name);
            }
        }
    }

    #[test]
    fn the_specified_keys_have_the_specified_actions() {
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
