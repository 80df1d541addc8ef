//! Hands on the scene: each pointer holds a piece of cloth or the camera, or nothing.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Hit, Result};

use crate::blade::{Afterglow, Swipe};
use crate::camera::{Camera, Sight};
use crate::hand::{Hand, TIP};
use crate::render::light::{FLOOR, STAGE_CENTRE};

/// How far a held particle may be pulled from the middle of the stage [m].
const REACH: f32 = 4.0;
/// How near to the floor it may be pulled [m].
const CLEARANCE: f32 = 0.02;

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

/// What a pointer holds.
#[derive(Debug)]
enum Hold {
    /// Of the cloth of this number.
    Cloth(usize, Hand),
    Camera,
    Blade(Swipe),
}

#[derive(Debug)]
struct Pointer {
    id: u32,
    at: Vec2,
    hold: Hold,
}

/// What the mouse's cursor should say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cursor {
    /// Nothing in particular.
    Default,
    /// Here is cloth to grab.
    Grab,
    /// Cloth is held.
    Grabbing,
    /// The blade is out.
    Crosshair,
}

impl Cursor {
    /// Its name in CSS.
    pub fn css(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Grab => "grab",
            Self::Grabbing => "grabbing",
            Self::Crosshair => "crosshair",
        }
    }
}

/// All pointers that are down.
#[derive(Debug, Default)]
pub struct Pointers {
    down: Vec<Pointer>,
    hover: Option<Vec2>,
}

impl Pointers {
    /// Whether any pointer is down.
    pub fn any(&self) -> bool {
        !self.down.is_empty()
    }

    /// A pointer comes down: on cloth it grabs, elsewhere it takes the camera; with the blade out it
    /// cuts, wherever it is.
    ///
    /// A second finger that lands beside the cloth turns both into a pinch.
    ///
    /// # Errors
    /// As [`Cloth::grab_ray`].
    pub fn press(&mut self, id: u32, at: Vec2, scene: &mut Scene<'_>) -> Result<()> {
        if !at.is_finite() {
            return Ok(());
        }
        self.lift(id, scene)?;
        if scene.blade {
            scene.glow(at, true);
            self.down.push(Pointer { id, at, hold: Hold::Blade(Swipe::new(at)) });
            return Ok(());
        }
        let hold = match scene.take(at)? {
            Some((cloth, hand)) => Hold::Cloth(cloth, hand),
            None => {
                self.open_hands(scene)?;
                Hold::Camera
            }
        };
        self.down.push(Pointer { id, at, hold });
        Ok(())
    }

    /// A pointer moves, up or down.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn drag(&mut self, id: u32, to: Vec2, scene: &mut Scene<'_>) -> Result<()> {
        if !to.is_finite() {
            return Ok(());
        }
        let Some(moved) = self.down.iter().position(|p| p.id == id) else {
            self.hover = Some(to);
            return Ok(());
        };
        let from = std::mem::replace(&mut self.down[moved].at, to);
        if let Hold::Blade(swipe) = &mut self.down[moved].hold {
            scene.glow(to, false);
            return swipe.reach(to, false, scene);
        }
        if matches!(self.down[moved].hold, Hold::Camera) {
            let others: Vec<Vec2> = self
                .down
                .iter()
                .filter(|p| p.id != id && matches!(p.hold, Hold::Camera))
                .map(|p| p.at)
                .collect();
            turn(scene.camera, scene.screen, [from, to], &others);
        }
        self.follow(scene)
    }

    /// A pointer goes up, is cancelled or is lost: it lets go.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32, scene: &mut Scene<'_>) -> Result<()> {
        let Some(i) = self.down.iter().position(|p| p.id == id) else {
            return Ok(());
        };
        let pointer = self.down.swap_remove(i);
        match pointer.hold {
            Hold::Cloth(cloth, hand) => hand.release(&mut scene.cloths[cloth]),
            Hold::Blade(mut swipe) => swipe.reach(pointer.at, true, scene),
            Hold::Camera => Ok(()),
        }
    }

    /// The pointer has left the screen.
    pub fn leave(&mut self) {
        self.hover = None;
    }

    /// Holds what is held under its pointer, also when only the camera has moved.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn follow(&mut self, scene: &mut Scene<'_>) -> Result<()> {
        let forward = scene.sight.forward();
        for pointer in &mut self.down {
            if let Hold::Cloth(cloth, hand) = &mut pointer.hold {
                let depth = (hand.at() - scene.sight.eye).dot(forward);
                let to = within_reach(scene.at_depth(pointer.at, depth) / scene.unit) * scene.unit;
                hand.move_to(to, &mut scene.cloths[*cloth])?;
            }
        }
        Ok(())
    }

    /// Every pointer that held cloth now holds the camera: the cloth they held is no more, or a
    /// pinch begins.
    fn open_hands(&mut self, scene: &mut Scene<'_>) -> Result<()> {
        for pointer in &mut self.down {
            if matches!(pointer.hold, Hold::Cloth(..))
                && let Hold::Cloth(cloth, hand) = std::mem::replace(&mut pointer.hold, Hold::Camera)
            {
                hand.release(&mut scene.cloths[cloth])?;
            }
        }
        Ok(())
    }

    /// Forgets every pointer without asking the cloth, which has been replaced.
    pub fn forget(&mut self) {
        self.down.clear();
    }

    /// What the cursor should say.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn cursor(&self, scene: &mut Scene<'_>) -> Result<Cursor> {
        if self.down.iter().any(|p| matches!(p.hold, Hold::Cloth(..))) {
            return Ok(Cursor::Grabbing);
        }
        if scene.blade || self.down.iter().any(|p| matches!(p.hold, Hold::Blade(_))) {
            return Ok(Cursor::Crosshair);
        }
        match self.hover {
            Some(at) if self.down.is_empty() => {
                let hit = scene.nearest(at)?;
                Ok(if hit.is_some() { Cursor::Grab } else { Cursor::Default })
            }
            _ => Ok(Cursor::Default),
        }
    }
}

/// Turns the camera by a pointer's way from one pixel to another while `others` hold it too; two of them
/// pinch.
pub fn turn(camera: &mut Camera, screen: Screen, [from, to]: [Vec2; 2], others: &[Vec2]) {
    let height = screen.size.y.max(1.0);
    // Both fingers of a pinch turn the camera by half, so that their middle leads it.
    camera.orbit((to - from) / (height * (others.len() + 1) as f32));
    if let [other] = others {
        let (before, after) = (from.distance(*other), to.distance(*other));
        if before > 1.0 && after > 1.0 {
            camera.zoom(before / after);
        }
    }
}

/// What pointers act on.
pub struct Scene<'a> {
    /// The cloths.
    pub cloths: &'a mut [Cloth],
    /// The camera rig.
    pub camera: &'a mut Camera,
    /// Length of what is drawn as a metre [m].
    pub unit: f32,
    /// Where the camera is in this frame, among the cloths as large as they are.
    pub sight: Sight,
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

impl Scene<'_> {
    /// The unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.sight.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Where a point appears, in pixels; `None` behind the eye.
    pub fn pixels(&self, at: Vec3) -> Option<Vec2> {
        self.sight.project(at, self.screen.aspect()).map(|normal| self.screen.pixels(normal))
    }

    /// How far in front of the eye the cloth is behind a pixel [m].
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn depth(&self, at: Vec2) -> Result<Option<f32>> {
        let hit = self.nearest(at)?;
        Ok(hit.map(|(_, hit)| (hit.position - self.sight.eye).dot(self.sight.forward())))
    }

    /// The cloth behind a pixel that is nearest to the eye, and where.
    fn nearest(&self, at: Vec2) -> Result<Option<(usize, Hit)>> {
        let direction = self.ray(at);
        let mut nearest: Option<(usize, Hit)> = None;
        for (i, cloth) in self.cloths.iter().enumerate() {
            let within = nearest.as_ref().map_or(100.0, |(_, hit)| hit.distance);
            if let Some(hit) = cloth.raycast(self.sight.eye, direction, within)? {
                nearest = Some((i, hit));
            }
        }
        Ok(nearest)
    }

    /// A hand on the cloth behind a pixel, or on one that is nearly there.
    fn take(&mut self, at: Vec2) -> Result<Option<(usize, Hand)>> {
        let ray = [self.sight.eye, self.ray(at)];
        let (span, tip) = (self.span * self.unit, TIP * self.unit);
        let radius = 0.6 * self.spacing;
        let hit = self.nearest(at)?.map(|(cloth, _)| cloth);
        let beside = (0..self.cloths.len()).filter(|_| hit.is_none());
        for cloth in hit.into_iter().chain(beside) {
            let taken = Hand::take(&mut self.cloths[cloth], ray, radius, span, tip)?;
            if let Some(hand) = taken {
                return Ok(Some((cloth, hand)));
            }
        }
        Ok(None)
    }

    /// The point behind a pixel, so far in front of the eye [m].
    pub fn at_depth(&self, at: Vec2, depth: f32) -> Vec3 {
        let ray = self.ray(at);
        self.sight.eye + ray * (depth / ray.dot(self.sight.forward()))
    }

    /// How many pixels an edge of the cloth covers, about.
    pub fn edge_pixels(&self) -> f32 {
        let away = self.sight.eye.distance(self.sight.target);
        self.spacing * self.sight.lens(self.screen.size.y) / away.max(0.1)
    }

    fn glow(&mut self, at: Vec2, first: bool) {
        self.afterglow.add(self.screen.normal(at), first);
    }
}

fn within_reach(at: Vec3) -> Vec3 {
    let mut near = STAGE_CENTRE + (at - STAGE_CENTRE).clamp_length_max(REACH);
    near.y = near.y.max(FLOOR + CLEARANCE);
    near
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

    #[test]
    fn nothing_is_pulled_off_the_stage_or_under_the_floor() {
        let far = within_reach(Vec3::new(5.0, -300.0, 2.0));
        assert!(far.distance(STAGE_CENTRE) <= REACH + 1.0e-3 && far.y >= FLOOR);
        let near = Vec3::new(0.3, 0.4, 0.5);
        assert!(within_reach(near).distance(near) < 1.0e-6);
    }
}
