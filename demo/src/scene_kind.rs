//! The cloth scenes of the demo, by name.
//!
//! Method: a plain enumeration, so that settings and scene setup can share it without importing
//! each other.
//!
//! Reads nothing; [`SceneKind::fabric`] returns the default fabric of a scene.
//!
//! Invariant: `ALL` and `NAMES` have the same order, and the saved settings use the kebab-case
//! names.

use serde::{Deserialize, Serialize};

use crate::fabric::Fabric;

/// A cloth scene of the demo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneKind {
    /// A sheet that hangs by its top edge.
    #[default]
    Sheet,
    /// A flag on its pole.
    Flag,
    /// A sheet that falls on a ball.
    Ball,
    /// Discs of three fabrics on pedestals.
    Discs,
    /// A curtain that a ball rolls through.
    Curtain,
    /// A walking figure in a skirt and a shirt.
    Figure,
    /// A sheet that falls on balls of glass.
    Glass,
    /// A curtain that the pointer walks a person through.
    Doorway,
    /// A torn flag in a storm.
    Storm,
}

impl SceneKind {
    /// All scenes, in the order of the panel.
    pub const ALL: [Self; 9] = [
        Self::Sheet,
        Self::Flag,
        Self::Ball,
        Self::Discs,
        Self::Curtain,
        Self::Figure,
        Self::Glass,
        Self::Doorway,
        Self::Storm,
    ];
    /// Names on the panel.
    pub const NAMES: [&'static str; 9] =
        ["Sheet", "Flag", "Ball", "Discs", "Curtain", "Figure", "Glass", "Doorway", "Storm"];

    /// Returns the fabric that the scene starts with.
    pub fn fabric(self) -> Fabric {
        match self {
            Self::Sheet | Self::Discs | Self::Curtain | Self::Glass => Fabric::Silk,
            Self::Flag | Self::Storm => Fabric::Flag,
            Self::Ball | Self::Figure | Self::Doorway => Fabric::Cotton,
        }
    }
}
