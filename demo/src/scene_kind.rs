//! SCENEKIND DOC

use serde::{Deserialize, Serialize};

use crate::fabric::Fabric;

/// A scene of the demo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneKind {
    /// The sheet that hangs by its top edge.
    #[default]
    Sheet,
    /// The flag that streams from its pole.
    Flag,
    /// The sheet that falls on a ball.
    Ball,
    /// Discs of three fabrics on pedestals.
    Discs,
    /// The curtain that a ball rolls through.
    Curtain,
}

impl SceneKind {
    /// All of them, in the order of the panel.
    pub const ALL: [Self; 5] = [Self::Sheet, Self::Flag, Self::Ball, Self::Discs, Self::Curtain];
    /// What the panel calls them.
    pub const NAMES: [&'static str; 5] = ["Sheet", "Flag", "Ball", "Discs", "Curtain"];

    /// What its cloth is of when it opens.
    pub fn fabric(self) -> Fabric {
        match self {
            Self::Sheet | Self::Discs | Self::Curtain => Fabric::Silk,
            Self::Flag => Fabric::Flag,
            Self::Ball => Fabric::Cotton,
        }
    }
}
