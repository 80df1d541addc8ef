//! Pointers (mouse and fingers) on a cloth scene: each one grabs cloth, orbits the camera, cuts, or
//! walks a person.
//!
//! Method: a press picks the nearest cloth by a ray. A grabbed patch then moves in the plane
//! through it that is parallel to the screen.
//!
//! Reads pointer events; writes grabs, cuts and the goal of the camera through [`PickContext`].
//!
//! Invariant: a released or lost pointer releases its grabs.

use glam::{Vec2, Vec3};
use muslin::Result;

use crate::blade::Swipe;
use crate::camera::Camera;
use crate::patch_grab::{FINGERTIP_RADIUS, PatchGrab};
use crate::picking::{PickContext, Screen};
use crate::render::light::{FLOOR, STAGE_CENTRE};

/// Greatest distance of a grabbed particle from the centre of the stage, in drawn metres.
const MAX_PULL: f32 = 4.0;
/// Least height of a grabbed particle over the floor, in drawn metres.
const CLEARANCE: f32 = 0.02;

/// What a pointer does while it is pressed.
#[derive(Debug)]
enum Hold {
    /// Drags a patch of the cloth with this index.
    Cloth(usize, PatchGrab),
    Camera,
    Blade(Swipe),
    /// Walks a person to where the pointer is.
    Walker,
}

#[derive(Debug)]
struct Pointer {
    id: u32,
    at: Vec2,
    hold: Hold,
}

/// Shape of the mouse cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cursor {
    /// The arrow of the platform.
    Default,
    /// The pointer is over cloth.
    Grab,
    /// A pointer drags cloth.
    Grabbing,
    /// The blade is on.
    Crosshair,
}

impl Cursor {
    /// Returns the name in CSS.
    pub fn css(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Grab => "grab",
            Self::Grabbing => "grabbing",
            Self::Crosshair => "crosshair",
        }
    }
}

/// All pressed pointers, and the hover position of the mouse.
#[derive(Debug, Default)]
pub struct Pointers {
    down: Vec<Pointer>,
    hover: Option<Vec2>,
}

impl Pointers {
    /// Returns whether any pointer is pressed.
    pub fn is_any_down(&self) -> bool {
        !self.down.is_empty()
    }

    /// Handles a pressed pointer: it grabs the cloth under it, and orbits the camera elsewhere;
    /// with the blade it cuts everywhere.
    ///
    /// If a finger lands beside the cloth, all pressed fingers start to orbit, so that two of them
    /// pinch.
    ///
    /// # Errors
    /// As [`Cloth::grab_ray`].
    pub fn press(&mut self, id: u32, at: Vec2, pick: &mut PickContext<'_>) -> Result<()> {
        if !at.is_finite() {
            return Ok(());
        }
        self.lift(id, pick)?;
        if pick.blade {
            pick.glow(at, true);
            self.down.push(Pointer { id, at, hold: Hold::Blade(Swipe::new(at)) });
            return Ok(());
        }
        let hold = match grab_at(pick, at)? {
            Some((cloth, hand)) => Hold::Cloth(cloth, hand),
            None => {
                self.turn_grabs_into_orbit(pick)?;
                Hold::Camera
            }
        };
        self.down.push(Pointer { id, at, hold });
        Ok(())
    }

    /// Handles a pointer that moves, pressed or not.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn drag(&mut self, id: u32, to: Vec2, pick: &mut PickContext<'_>) -> Result<()> {
        if !to.is_finite() {
            return Ok(());
        }
        let Some(moved) = self.down.iter().position(|p| p.id == id) else {
            self.hover = Some(to);
            return Ok(());
        };
        let from = std::mem::replace(&mut self.down[moved].at, to);
        if let Hold::Blade(swipe) = &mut self.down[moved].hold {
            pick.glow(to, false);
            return swipe.cut_to(to, false, pick);
        }
        if matches!(self.down[moved].hold, Hold::Camera) {
            let others: Vec<Vec2> = self
                .down
                .iter()
                .filter(|p| p.id != id && matches!(p.hold, Hold::Camera))
                .map(|p| p.at)
                .collect();
            orbit_and_pinch(pick.camera, pick.screen, [from, to], &others);
        }
        self.update_targets(pick)
    }

    /// Handles a pointer that is released, cancelled or lost: it releases its grabs.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32, pick: &mut PickContext<'_>) -> Result<()> {
        let Some(i) = self.down.iter().position(|p| p.id == id) else {
            return Ok(());
        };
        let pointer = self.down.swap_remove(i);
        match pointer.hold {
            Hold::Cloth(cloth, hand) => hand.release(&mut pick.cloths[cloth]),
            Hold::Blade(mut swipe) => swipe.cut_to(pointer.at, true, pick),
            Hold::Camera | Hold::Walker => Ok(()),
        }
    }

    /// Handles the release of all pressed pointers.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift_all(&mut self, pick: &mut PickContext<'_>) -> Result<()> {
        while let Some(id) = self.down.first().map(|pointer| pointer.id) {
            self.lift(id, pick)?;
        }
        Ok(())
    }

    /// Handles a pressed pointer that orbits the camera, whatever is under it.
    pub fn press_camera(&mut self, id: u32, at: Vec2) {
        self.down.push(Pointer { id, at, hold: Hold::Camera });
    }

    /// Handles a pressed pointer that walks a person.
    pub fn press_walker(&mut self, id: u32, at: Vec2) {
        self.down.push(Pointer { id, at, hold: Hold::Walker });
    }

    /// Returns where the mouse is while no pointer is pressed [px].
    pub fn hover(&self) -> Option<Vec2> {
        self.hover.filter(|_| self.down.is_empty())
    }

    /// Returns where a person is to walk: to a pointer that was pressed for it, or to the mouse
    /// while nothing is pressed.
    pub fn walker_target(&self) -> Option<Vec2> {
        let held = self.down.iter().find(|p| matches!(p.hold, Hold::Walker)).map(|p| p.at);
        held.or(self.hover())
    }

    /// Removes the hover position: the mouse has left the screen.
    pub fn clear_hover(&mut self) {
        self.hover = None;
    }

    /// Updates the targets of all grabs from the pointers and the camera, which may have moved
    /// alone.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn update_targets(&mut self, pick: &mut PickContext<'_>) -> Result<()> {
        let forward = pick.view.forward();
        for pointer in &mut self.down {
            if let Hold::Cloth(cloth, hand) = &mut pointer.hold {
                let depth = (hand.at() - pick.view.eye).dot(forward);
                let to = clamp_to_stage(pick.at_depth(pointer.at, depth) / pick.unit) * pick.unit;
                hand.move_to(to, &mut pick.cloths[*cloth])?;
            }
        }
        Ok(())
    }

    /// Releases the cloth of every pointer and lets them orbit the camera: a pinch begins.
    fn turn_grabs_into_orbit(&mut self, pick: &mut PickContext<'_>) -> Result<()> {
        for pointer in &mut self.down {
            if matches!(pointer.hold, Hold::Cloth(..))
                && let Hold::Cloth(cloth, hand) = std::mem::replace(&mut pointer.hold, Hold::Camera)
            {
                hand.release(&mut pick.cloths[cloth])?;
            }
        }
        Ok(())
    }

    /// Removes every pointer without releasing grabs: the cloth has been replaced.
    pub fn clear(&mut self) {
        self.down.clear();
    }

    /// Returns the shape of the mouse cursor.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn cursor(&self, pick: &mut PickContext<'_>) -> Result<Cursor> {
        if self.down.iter().any(|p| matches!(p.hold, Hold::Cloth(..) | Hold::Walker)) {
            return Ok(Cursor::Grabbing);
        }
        if pick.blade || self.down.iter().any(|p| matches!(p.hold, Hold::Blade(_))) {
            return Ok(Cursor::Crosshair);
        }
        match self.hover {
            Some(at) if self.down.is_empty() => {
                let hit = pick.nearest(at)?;
                Ok(if hit.is_some() { Cursor::Grab } else { Cursor::Default })
            }
            _ => Ok(Cursor::Default),
        }
    }
}

/// Orbits the camera by the move of a pointer [px]; with exactly one of `others` on the camera too,
/// it also zooms by the ratio of their distances (pinch).
pub fn orbit_and_pinch(
    camera: &mut Camera,
    screen: Screen,
    [from, to]: [Vec2; 2],
    others: &[Vec2],
) {
    let height = screen.size.y.max(1.0);
    // Each finger orbits by its share, so that the camera follows the midpoint of the fingers.
    camera.orbit((to - from) / (height * (others.len() + 1) as f32));
    if let [other] = others {
        let (before, after) = (from.distance(*other), to.distance(*other));
        if before > 1.0 && after > 1.0 {
            camera.zoom(before / after);
        }
    }
}

/// Grabs a patch of the cloth behind a pixel, or of a cloth close to the ray; returns the index of
/// the cloth.
fn grab_at(pick: &mut PickContext<'_>, at: Vec2) -> Result<Option<(usize, PatchGrab)>> {
    let ray = [pick.view.eye, pick.ray(at)];
    let (span, fingertip) = (pick.span * pick.unit, FINGERTIP_RADIUS * pick.unit);
    let radius = 0.6 * pick.spacing;
    let hit = pick.nearest(at)?.map(|(cloth, _)| cloth);
    let beside = (0..pick.cloths.len()).filter(|_| hit.is_none());
    for cloth in hit.into_iter().chain(beside) {
        let taken = PatchGrab::grab_ray(&mut pick.cloths[cloth], ray, radius, span, fingertip)?;
        if let Some(hand) = taken {
            return Ok(Some((cloth, hand)));
        }
    }
    Ok(None)
}

fn clamp_to_stage(at: Vec3) -> Vec3 {
    let mut near = STAGE_CENTRE + (at - STAGE_CENTRE).clamp_length_max(MAX_PULL);
    near.y = near.y.max(FLOOR + CLEARANCE);
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grab_targets_stay_on_the_stage_and_above_the_floor() {
        let far = clamp_to_stage(Vec3::new(5.0, -300.0, 2.0));
        assert!(far.distance(STAGE_CENTRE) <= MAX_PULL + 1.0e-3 && far.y >= FLOOR);
        let near = Vec3::new(0.3, 0.4, 0.5);
        assert!(clamp_to_stage(near).distance(near) < 1.0e-6);
    }
}
