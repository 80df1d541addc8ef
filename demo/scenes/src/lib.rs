//! Scenes of cloth: the demo shows them, `tests/scenes.rs` plays them, the benchmarks time them.

mod ball;
mod cast;
mod curtain;
pub mod disc;
mod drapes;
mod flag;
mod hanging_sheet;
pub mod receipt;
pub mod shadow;
pub mod squeeze;

pub use ball::SheetOnBall;
pub use cast::{Cast, Roll};
pub use curtain::Curtain;
pub use drapes::Drapes;
pub use flag::Flag;
pub use hanging_sheet::HangingSheet;
pub use receipt::{Receipt, Sheet};
pub use squeeze::Squeeze;

use muslin::{SelfCollision, Settings};

/// So many particles keep apart by their surface in real time, on a page as well.
const MOST_BY_SURFACE: u32 = 2500;

/// How far layers keep apart, so that they are drawn apart [m].
const GAP: f32 = 0.004;

/// Height of the floor [m]; where a scene is drawn larger than it is, in what it is drawn in.
pub const FLOOR: f32 = -1.4;

/// Cloth in a situation, and what must be seen there.
pub trait Scene {
    /// What it is called.
    const NAME: &'static str;
    /// What there is to see.
    const ABOUT: &'static str;

    /// The cloths as they are when the scene opens.
    fn build() -> Cast;

    /// Whether what must be seen is there.
    ///
    /// # Errors
    /// A sentence that says what is not.
    fn check(cast: &Cast) -> Result<(), String>;
}

/// The same settings for a cloth of so many particles that folds onto itself: it keeps apart by its surface, or by
/// its particles where that would take too long.
fn apart(settings: Settings, particles: u32) -> Settings {
    if particles <= MOST_BY_SURFACE {
        Settings { self_collision: SelfCollision::Surface, self_distance: GAP, ..settings }
    } else {
        Settings { self_collision: SelfCollision::Particles, ..settings }
    }
}

/// A scene after `ticks` ticks.
pub fn play<S: Scene>(ticks: u32) -> Cast {
    let mut cast = S::build();
    cast.step(ticks);
    cast
}
