//! Scenes of cloth: the demo shows them, `tests/contract/scenes.rs` checks them, and the benchmarks
//! time them.
//!
//! Each scene is a type that implements [`Scene`]: it builds a [`SceneInstance`] (the cloths, and a
//! ball, a figure or a walker that moves them if there is one), and checks that the cloth does what
//! the scene is meant to show.

pub mod disc;
pub mod figure;
pub mod receipt;
pub mod shadow;
pub mod squeeze;

mod curtain;
mod doorway;
mod drapes;
mod flag;
mod glass_balls;
mod hanging_sheet;
mod instance;
mod scene;
mod sheet_on_ball;
mod stage;
mod torn_flag;
mod walker;

pub use curtain::Curtain;
pub use doorway::Doorway;
pub use drapes::Drapes;
pub use figure::Figure;
pub use flag::Flag;
pub use glass_balls::GlassBalls;
pub use hanging_sheet::HangingSheet;
pub use instance::{BallMotion, SceneInstance};
pub use receipt::{Receipt, Sheet};
pub use scene::{FLOOR, Scene, play};
pub use sheet_on_ball::SheetOnBall;
pub use squeeze::Squeeze;
pub use torn_flag::TornFlag;
pub use walker::Walker;
