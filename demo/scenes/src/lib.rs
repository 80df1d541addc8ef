//! Scenes of cloth: the demo shows them, `tests/contract/scenes.rs` checks them, and the benchmarks
//! time them.
//!
//! Each scene is a type that implements [`Scene`]: it builds a [`SceneInstance`] (the cloths, and a
//! ball or a figure that moves them if there is one), and checks that the cloth does what the scene
//! is meant to show.

pub mod disc;
pub mod figure;
pub mod receipt;
pub mod shadow;
pub mod squeeze;

mod curtain;
mod drapes;
mod flag;
mod hanging_sheet;
mod instance;
mod scene;
mod sheet_on_ball;
mod stage;

pub use curtain::Curtain;
pub use drapes::Drapes;
pub use figure::Figure;
pub use flag::Flag;
pub use hanging_sheet::HangingSheet;
pub use instance::{BallMotion, SceneInstance};
pub use receipt::{Receipt, Sheet};
pub use scene::{FLOOR, Scene, play};
pub use sheet_on_ball::SheetOnBall;
pub use squeeze::Squeeze;
