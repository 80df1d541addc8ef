//! Picking: rays from pixels into the scene, and projections from the scene to pixels.
//!
//! ```text
//! pixel ──▶ normalised device coordinates ──▶ ray ──▶ nearest hit of all cloths
//! ```
//! Reads the camera view, the screen and the cloths; writes nothing but the afterglow of the blade.
//!
//! Invariant: `Screen::normal` and `Screen::pixels` are inverse to each other.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Hit, Result};

use crate::afterglow::Afterglow;
use crate::camera::{Camera, CameraView};

/// The screen, in logical pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Width and height [px].
    pub size: Vec2,
}

impl Screen {
    /// Returns width over height.
    pub fn aspect(&self) -> f32 {
        self.size.x.max(1.0) / self.size.y.max(1.0)
    }

    /// Converts pixels (y down) to normalised device coordinates (-1 to 1, y up).
    pub fn normal(&self, at: Vec2) -> Vec2 {
        let share = at / self.size.max(Vec2::ONE);
        Vec2::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y)
    }

    /// Converts normalised device coordinates (-1 to 1, y up) to pixels (y down).
    pub fn pixels(&self, at: Vec2) -> Vec2 {
        Vec2::new(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y) * self.size
    }
}

/// The objects that pointers act on, borrowed for one event.
pub struct PickContext<'a> {
    /// Cloths of the scene.
    pub cloths: &'a mut [Cloth],
    /// The orbit camera.
    pub camera: &'a mut Camera,
    /// Length in the simulation of one drawn metre [m].
    pub unit: f32,
    /// Camera view of this frame, scaled to the lengths of the simulation.
    pub view: CameraView,
    /// The screen.
    pub screen: Screen,
    /// Whether pointers cut instead of grabbing.
    pub blade: bool,
    /// Trail of the blade.
    pub afterglow: &'a mut Afterglow,
    /// Distance between neighbouring particles [m].
    pub spacing: f32,
    /// Size of the sheet in texture space, in drawn metres.
    pub span: Vec2,
}

impl PickContext<'_> {
    /// Returns the unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.view.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Projects a point to the screen [px]; `None` behind the eye.
    pub fn pixels(&self, at: Vec3) -> Option<Vec2> {
        self.view.project(at, self.screen.aspect()).map(|normal| self.screen.pixels(normal))
    }

    /// Returns the depth of the nearest cloth behind a pixel, along the view direction [m].
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn depth(&self, at: Vec2) -> Result<Option<f32>> {
        let hit = self.nearest(at)?;
        Ok(hit.map(|(_, hit)| (hit.position - self.view.eye).dot(self.view.forward())))
    }

    /// Returns the index of the cloth nearest to the eye behind a pixel, and the hit.
    pub fn nearest(&self, at: Vec2) -> Result<Option<(usize, Hit)>> {
        let direction = self.ray(at);
        let mut nearest: Option<(usize, Hit)> = None;
        for (i, cloth) in self.cloths.iter().enumerate() {
            let within = nearest.as_ref().map_or(100.0, |(_, hit)| hit.distance);
            if let Some(hit) = cloth.raycast(self.view.eye, direction, within)? {
                nearest = Some((i, hit));
            }
        }
        Ok(nearest)
    }

    /// Returns the point behind a pixel at a depth along the view direction [m].
    pub fn at_depth(&self, at: Vec2, depth: f32) -> Vec3 {
        let ray = self.ray(at);
        self.view.eye + ray * (depth / ray.dot(self.view.forward()))
    }

    /// Returns the approximate length of a cloth edge on the screen [px].
    pub fn edge_pixels(&self) -> f32 {
        let away = self.view.eye.distance(self.view.target);
        self.spacing * self.view.focal_length_pixels(self.screen.size.y) / away.max(0.1)
    }

    /// Appends a pixel to the trail of the blade; `first` begins a new path.
    pub fn glow(&mut self, at: Vec2, first: bool) {
        self.afterglow.add(self.screen.normal(at), first);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_and_normalised_device_coordinates_are_inverse_to_each_other() {
        let screen = Screen { size: Vec2::new(390.0, 844.0) };
        let at = Vec2::new(17.0, 800.0);
        assert!(screen.pixels(screen.normal(at)).distance(at) < 1.0e-3);
        assert_eq!(screen.normal(Vec2::ZERO), Vec2::new(-1.0, 1.0));
    }
}
