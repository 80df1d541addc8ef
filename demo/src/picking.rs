//! PICKING DOC

use glam::{Vec2, Vec3};
use muslin::{Cloth, Hit, Result};

use crate::afterglow::Afterglow;
use crate::camera::{Camera, CameraView};

/// The screen that pointers move on, in the pixels that they count in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Width and height.
    pub size: Vec2,
}

impl Screen {
    /// Width over height.
    pub fn aspect(&self) -> f32 {
        self.size.x.max(1.0) / self.size.y.max(1.0)
    }

    /// From pixels, y down, to -1 to 1, y up.
    pub fn normal(&self, at: Vec2) -> Vec2 {
        let share = at / self.size.max(Vec2::ONE);
        Vec2::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y)
    }

    /// From -1 to 1, y up, to pixels, y down.
    pub fn pixels(&self, at: Vec2) -> Vec2 {
        Vec2::new(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y) * self.size
    }
}

/// What pointers act on.
pub struct PickContext<'a> {
    /// The cloths.
    pub cloths: &'a mut [Cloth],
    /// The camera rig.
    pub camera: &'a mut Camera,
    /// Length of what is drawn as a metre [m].
    pub unit: f32,
    /// Where the camera is in this frame, among the cloths as large as they are.
    pub view: CameraView,
    /// The screen.
    pub screen: Screen,
    /// Whether the blade is out.
    pub blade: bool,
    /// The path of the blade.
    pub afterglow: &'a mut Afterglow,
    /// Distance between neighbouring particles [m].
    pub spacing: f32,
    /// What the weave's coordinates span, as it is drawn [m].
    pub span: Vec2,
}

impl PickContext<'_> {
    /// The unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.view.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Where a point appears, in pixels; `None` behind the eye.
    pub fn pixels(&self, at: Vec3) -> Option<Vec2> {
        self.view.project(at, self.screen.aspect()).map(|normal| self.screen.pixels(normal))
    }

    /// How far in front of the eye the cloth is behind a pixel [m].
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn depth(&self, at: Vec2) -> Result<Option<f32>> {
        let hit = self.nearest(at)?;
        Ok(hit.map(|(_, hit)| (hit.position - self.view.eye).dot(self.view.forward())))
    }

    /// The cloth behind a pixel that is nearest to the eye, and where.
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

    /// The point behind a pixel, so far in front of the eye [m].
    pub fn at_depth(&self, at: Vec2, depth: f32) -> Vec3 {
        let ray = self.ray(at);
        self.view.eye + ray * (depth / ray.dot(self.view.forward()))
    }

    /// How many pixels an edge of the cloth covers, about.
    pub fn edge_pixels(&self) -> f32 {
        let away = self.view.eye.distance(self.view.target);
        self.spacing * self.view.focal_length_pixels(self.screen.size.y) / away.max(0.1)
    }

    pub fn glow(&mut self, at: Vec2, first: bool) {
        self.afterglow.add(self.screen.normal(at), first);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_and_normal_coordinates_are_each_others_inverse() {
        let screen = Screen { size: Vec2::new(390.0, 844.0) };
        let at = Vec2::new(17.0, 800.0);
        assert!(screen.pixels(screen.normal(at)).distance(at) < 1.0e-3);
        assert_eq!(screen.normal(Vec2::ZERO), Vec2::new(-1.0, 1.0));
    }
}
