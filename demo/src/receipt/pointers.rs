//! Pointers on the receipt: each one grabs the paper at one particle or orbits the camera.
//!
//! Method: a press grabs the particle nearest to the pick ray. The grab follows its pointer with
//! exponential smoothing, in the plane through it that is parallel to the screen. A grab can be
//! left in place, so that one pointer can hold several points.
//!
//! Reads pointer events; writes grabs and the goal of the camera through [`ReceiptPickContext`].
//!
//! Invariant: a released or lost pointer releases its grab, unless grabs are left in place.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Grab, Result};
use muslin_scenes::receipt::FLOOR;

use crate::camera::{Camera, CameraView};
use crate::picking::Screen;
use crate::pointer::{Cursor, orbit_and_pinch};

/// Greatest distance between a pick ray and the particle that it grabs, in units.
const GRAB_RADIUS: f32 = 0.5;
/// Time constant of the smoothing [s]: long enough that a toss does not depend on the time of the
/// last pointer event.
const SMOOTHING_TIME: f32 = 0.02;
/// Limits of a grab target around the origin and over the floor, in units.
const TARGET_LIMITS: Vec3 = Vec3::new(7.0, 9.0, 7.0);
const CLEARANCE: f32 = 0.04;
/// Distance that a dragged grab keeps in front of other layers of paper, in units; and least
/// distance along the sheet of another layer [cells].
const LAYER_DISTANCE: f32 = 0.14;
const LAYER_CELLS: u32 = 9;

/// Type of a press.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressKind {
    /// The left mouse button, a finger or a pen.
    Main,
    /// The right mouse button: it always orbits the camera.
    Turn,
}

/// A grab of one particle.
#[derive(Debug)]
struct ParticleGrab {
    grab: Grab,
    particle: u32,
    /// Current and final position of the grab [m].
    now: Vec3,
    goal: Vec3,
}

#[derive(Debug)]
enum ReceiptHold {
    Paper(ParticleGrab),
    Camera,
}

#[derive(Debug)]
struct ReceiptPointer {
    /// `None` after the pointer has left its grab in place.
    id: Option<u32>,
    at: Vec2,
    hold: ReceiptHold,
}

/// All pressed pointers and all grabs left in place.
#[derive(Debug, Default)]
pub struct ReceiptPointers {
    down: Vec<ReceiptPointer>,
    hover: Option<Vec2>,
    leave_in_place: bool,
}

/// The objects that pointers act on, borrowed for one event.
pub struct ReceiptPickContext<'a> {
    /// Cloth of the receipt.
    pub cloth: &'a mut Cloth,
    /// The orbit camera, in units.
    pub camera: &'a mut Camera,
    /// Camera view of this frame, in metres.
    pub view: CameraView,
    /// The screen.
    pub screen: Screen,
    /// Particles across the sheet.
    pub columns: u32,
    /// Whether a grab slides over paper in front of it instead of passing through.
    pub slides: bool,
    /// Length of a unit [m].
    pub unit: f32,
}

impl ReceiptPointers {
    /// Returns whether there is a pressed pointer or a grab left in place.
    pub fn is_any_down(&self) -> bool {
        !self.down.is_empty()
    }

    /// Returns whether any pointer grabs the paper.
    pub fn holds_cloth(&self) -> bool {
        self.grabs().next().is_some()
    }

    /// Returns particle and position [m] of each grab.
    pub fn grabs(&self) -> impl Iterator<Item = (u32, Vec3)> + '_ {
        self.down.iter().filter_map(|pointer| match &pointer.hold {
            ReceiptHold::Paper(held) => Some((held.particle, held.now)),
            ReceiptHold::Camera => None,
        })
    }

    /// Handles a pressed pointer: it grabs the paper at or near it, and orbits the camera
    /// elsewhere.
    ///
    /// If a finger lands beside the paper, all pressed fingers start to orbit, so that two of them
    /// pinch.
    ///
    /// # Errors
    /// As [`Cloth::grab_ray`].
    pub fn press(
        &mut self,
        id: u32,
        at: Vec2,
        button: PressKind,
        pick: &mut ReceiptPickContext<'_>,
    ) -> Result<()> {
        if !at.is_finite() {
            return Ok(());
        }
        self.lift(id, pick)?;
        let taken = if button == PressKind::Main { pick.grab_at(at)? } else { None };
        let hold = match taken {
            Some(held) => ReceiptHold::Paper(held),
            None => {
                self.turn_grabs_into_orbit(pick)?;
                ReceiptHold::Camera
            }
        };
        self.down.push(ReceiptPointer { id: Some(id), at, hold });
        Ok(())
    }

    /// Handles a pointer that moves, pressed or not.
    pub fn drag(&mut self, id: u32, to: Vec2, pick: &mut ReceiptPickContext<'_>) {
        if !to.is_finite() {
            return;
        }
        let Some(moved) = self.down.iter().position(|p| p.id == Some(id)) else {
            self.hover = Some(to);
            return;
        };
        let from = std::mem::replace(&mut self.down[moved].at, to);
        if matches!(self.down[moved].hold, ReceiptHold::Camera) {
            let others: Vec<Vec2> = self
                .down
                .iter()
                .filter(|p| p.id != Some(id) && matches!(p.hold, ReceiptHold::Camera))
                .map(|p| p.at)
                .collect();
            orbit_and_pinch(pick.camera, pick.screen, [from, to], &others);
        }
    }

    /// Handles a pointer that is released, cancelled or lost: it releases its grab, or leaves it in
    /// place.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32, pick: &mut ReceiptPickContext<'_>) -> Result<()> {
        let Some(i) = self.down.iter().position(|p| p.id == Some(id)) else {
            return Ok(());
        };
        if self.leave_in_place && matches!(self.down[i].hold, ReceiptHold::Paper(_)) {
            self.down[i].id = None;
            return Ok(());
        }
        match self.down.swap_remove(i).hold {
            ReceiptHold::Paper(held) => pick.cloth.release(held.grab),
            ReceiptHold::Camera => Ok(()),
        }
    }

    /// Sets whether released pointers leave their grabs in place; switching it off releases those
    /// grabs.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn set_leave_in_place(
        &mut self,
        on: bool,
        pick: &mut ReceiptPickContext<'_>,
    ) -> Result<()> {
        self.leave_in_place = on;
        if on {
            return Ok(());
        }
        for pointer in self.down.extract_if(.., |pointer| pointer.id.is_none()) {
            if let ReceiptHold::Paper(held) = pointer.hold {
                pick.cloth.release(held.grab)?;
            }
        }
        Ok(())
    }

    /// Removes the hover position: the mouse has left the screen.
    pub fn clear_hover(&mut self) {
        self.hover = None;
    }

    /// Updates the targets of all grabs from the pointers and the camera: in the plane through the
    /// grab that is parallel to the screen, and in front of other layers of paper.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn update_targets(&mut self, pick: &mut ReceiptPickContext<'_>) -> Result<()> {
        for pointer in &mut self.down {
            if let (Some(_), ReceiptHold::Paper(held)) = (pointer.id, &mut pointer.hold) {
                held.goal = pick.goal(pointer.at, held)?;
            }
        }
        Ok(())
    }

    /// Moves all grabs by one tick of `seconds` [s].
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<()> {
        let share = 1.0 - (-seconds / SMOOTHING_TIME).exp();
        for pointer in &mut self.down {
            if let ReceiptHold::Paper(held) = &mut pointer.hold {
                held.now = held.now.lerp(held.goal, share);
                cloth.move_grab(held.grab, held.now)?;
            }
        }
        Ok(())
    }

    /// Releases all grabs.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn release_all(&mut self, pick: &mut ReceiptPickContext<'_>) -> Result<()> {
        for pointer in self.down.extract_if(.., |p| matches!(p.hold, ReceiptHold::Paper(_))) {
            if let ReceiptHold::Paper(held) = pointer.hold {
                pick.cloth.release(held.grab)?;
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
    pub fn cursor(&self, pick: &ReceiptPickContext<'_>) -> Result<Cursor> {
        if self.down.iter().any(|p| p.id.is_some() && matches!(p.hold, ReceiptHold::Paper(_))) {
            return Ok(Cursor::Grabbing);
        }
        match self.hover {
            Some(at) if self.down.iter().all(|p| p.id.is_none()) => {
                let hit = pick.cloth.raycast(pick.view.eye, pick.ray(at), f32::INFINITY)?;
                Ok(if hit.is_some() { Cursor::Grab } else { Cursor::Default })
            }
            _ => Ok(Cursor::Default),
        }
    }

    /// Releases the grabs of all pressed fingers and lets them orbit the camera: a pinch begins.
    /// Grabs left in place stay.
    fn turn_grabs_into_orbit(&mut self, pick: &mut ReceiptPickContext<'_>) -> Result<()> {
        for pointer in self.down.iter_mut().filter(|pointer| pointer.id.is_some()) {
            if let ReceiptHold::Paper(held) =
                std::mem::replace(&mut pointer.hold, ReceiptHold::Camera)
            {
                pick.cloth.release(held.grab)?;
            }
        }
        Ok(())
    }
}

impl ReceiptPickContext<'_> {
    /// Returns the unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.view.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Grabs the particle at or near a pixel.
    fn grab_at(&mut self, at: Vec2) -> Result<Option<ParticleGrab>> {
        let (eye, ray) = (self.view.eye, self.ray(at));
        let Some((grab, now)) = self.cloth.grab_ray(eye, ray, GRAB_RADIUS * self.unit)? else {
            return Ok(None);
        };
        let particle = self.cloth.positions().iter().position(|x| *x == now);
        let particle = particle.map_or(0, |particle| particle as u32);
        Ok(Some(ParticleGrab { grab, particle, now, goal: now }))
    }

    /// Returns the target of a grab for a pointer at `at`.
    fn goal(&self, at: Vec2, held: &ParticleGrab) -> Result<Vec3> {
        let (ray, forward) = (self.ray(at), self.view.forward());
        let mut depth = (held.goal - self.view.eye).dot(forward);
        if self.slides
            && let Some(hit) = self.cloth.raycast(self.view.eye, ray, f32::INFINITY)?
        {
            let cell = |particle: u32| {
                let source = self.cloth.source_vertices()[particle as usize];
                [source / self.columns, source % self.columns]
            };
            let (held, met) = (cell(held.particle), cell(hit.particle));
            let away = held[0].abs_diff(met[0]).max(held[1].abs_diff(met[1]));
            let over = (hit.position - self.view.eye).dot(forward) - LAYER_DISTANCE * self.unit;
            if away > LAYER_CELLS && over < depth {
                depth = over;
            }
        }
        let to = self.view.eye + ray * (depth / ray.dot(forward));
        let near = (to / self.unit).clamp(-TARGET_LIMITS, TARGET_LIMITS);
        Ok(near.with_y(near.y.max(FLOOR + CLEARANCE)) * self.unit)
    }
}
