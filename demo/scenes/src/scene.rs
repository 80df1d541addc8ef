//! The trait of all scenes, and the settings that they share.

use crate::instance::SceneInstance;
pub use crate::stage::FLOOR;
use muslin::{SelfCollision, Settings};

/// The largest number of particles with which surface collision runs in real time, also on a page.
const MAX_SURFACE_PARTICLES: u32 = 2500;

/// Distance between layers in surface collision, large enough that they are drawn apart [m].
const SELF_DISTANCE: f32 = 0.004;

/// A situation for a cloth, and a check that it does what the scene is meant to show.
pub trait Scene {
    /// Name of the scene.
    const NAME: &'static str;
    /// What the scene shows, in a sentence.
    const ABOUT: &'static str;

    /// Creates the scene in its initial state.
    fn build() -> SceneInstance;

    /// Checks that the scene shows what it is meant to, some time after it began.
    ///
    /// # Errors
    /// A sentence that says what is wrong.
    fn check(instance: &SceneInstance) -> Result<(), String>;
}

/// Returns `settings` with self-collision for a cloth with this many particles: surface collision,
/// or particle collision if surface collision would be too slow.
pub(crate) fn with_self_collision(settings: Settings, particles: u32) -> Settings {
    if particles <= MAX_SURFACE_PARTICLES {
        Settings {
            self_collision: SelfCollision::Surface,
            self_distance: SELF_DISTANCE,
            ..settings
        }
    } else {
        Settings { self_collision: SelfCollision::Particles, ..settings }
    }
}

/// Returns the scene that was created from a descriptor of this crate, which is always valid.
pub(crate) fn built(created: muslin::Result<impl Into<SceneInstance>>) -> SceneInstance {
    match created {
        Ok(scene) => scene.into(),
        Err(error) => unreachable!("the descriptor of the scene is wrong: {error}"),
    }
}

/// Builds a scene and runs `ticks` ticks of it.
pub fn play<S: Scene>(ticks: u32) -> SceneInstance {
    let mut instance = S::build();
    instance.step(ticks);
    instance
}
