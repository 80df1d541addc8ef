//! Scenes of cloth: the demo shows them, `tests/scenes.rs` plays them, the benchmarks time them.

mod ball;
mod flag;
mod hanging_sheet;
pub mod receipt;

pub use ball::SheetOnBall;
pub use flag::Flag;
pub use hanging_sheet::HangingSheet;
use muslin::Cloth;
pub use receipt::{Receipt, Sheet};

/// A cloth in a situation, and what must be seen there.
pub trait Scene {
    /// What it is called.
    const NAME: &'static str;
    /// What there is to see.
    const ABOUT: &'static str;

    /// The cloth as it is when the scene opens.
    fn build() -> Cloth;

    /// Whether what must be seen is there.
    ///
    /// # Errors
    /// A sentence that says what is not.
    fn check(cloth: &Cloth) -> Result<(), String>;
}

/// A scene after `ticks` ticks.
pub fn play<S: Scene>(ticks: u32) -> Cloth {
    let mut cloth = S::build();
    cloth.step(ticks);
    cloth
}
