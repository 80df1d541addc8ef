//! Scene: a mannequin walks in a circle and kicks, in a skirt and a loose shirt.
//!
//! ```text
//! motion ─▶ pose ─┬─▶ capsules ─▶ colliders ───────────────┬─▶ coarse cloth ─▶ fine skins
//!                 ├─▶ waist, shoulder seams ─▶ attachments ┘
//!                 └─▶ skinned mesh of the body
//! ```
//! Method: both garments are pieces of one coarse cloth with surface collision, so that they also
//! collide with each other. They collide with tapered capsules around the bones of the body. What is
//! drawn is a fine skin of each garment, and a skinned mesh of the body just inside the capsules.
//!
//! Reads nothing; writes a [`SceneInstance`].
//!
//! Invariant: before each tick colliders and attachments get the pose at the end of that tick.

pub mod body;
pub mod dressed;
pub mod garments;
pub mod motion;
pub mod skeleton;

#[cfg(test)]
mod tests;

use crate::instance::SceneInstance;
use crate::scene::{Scene, built};
use dressed::DressedBody;
use muslin::{Material, Preset, Result, SelfCollision, Settings};

/// A figure in a skirt and a shirt.
#[derive(Clone, Copy, Debug)]
pub struct Figure;

impl Figure {
    /// Returns the settings of the clothes.
    pub fn settings() -> Settings {
        Settings {
            self_collision: SelfCollision::Surface,
            self_distance: 0.005,
            max_stretch: 0.06,
            ..Settings::default()
        }
    }

    /// Creates the clothes, and the body that wears them.
    ///
    /// # Errors
    /// As [`Cloth::mesh`](muslin::Cloth::mesh): a wrong material.
    pub fn dress(material: Material, settings: Settings) -> Result<SceneInstance> {
        let (cloth, body) = DressedBody::dress(material, settings)?;
        Ok(SceneInstance::with_figure(cloth, body))
    }
}

impl Scene for Figure {
    const NAME: &'static str = "figure in a skirt and a shirt";
    const ABOUT: &'static str = "It walks in a circle and kicks, and its clothes stay on.";

    fn build() -> SceneInstance {
        built(Self::dress(Material::preset(Preset::Cotton), Self::settings()))
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let (cloth, body) = (&instance.cloths[0], instance.figure().ok_or("there is no figure")?);
        for x in cloth.positions() {
            if !x.is_finite() {
                return Err(format!("a particle is at {x}"));
            }
            let depth = body.depth_inside(*x);
            if depth > 1.0e-3 {
                return Err(format!("a particle at {x} is {depth} m inside the body"));
            }
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.07 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
