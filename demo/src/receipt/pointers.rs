//! ReceiptPointers on the receipt: each pointer holds the paper at one place, or the camera. ReceiptPointers may be left
//! where they are, so that one pointer is as good as two.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Grab, Result};
use muslin_scenes::receipt::FLOOR;

use crate::camera::{Camera, CameraView};
use crate::picking::Screen;
use crate::pointer::{Cursor, orbit_and_pinch};

/// How far beside a ray a particle may be that it takes hold of, in units.
const GRAB: f32 = 0.5;
/// How quickly a hand follows its pointer [s]: smooth enough that a toss has the hand's speed whenever the
/// last move of the pointer came.
const FOLLOW: f32 = 0.02;
/// How far from the middle of the scene a hand may go, and over the floor, in units.
const REACH: Vec3 = Vec3::new(7.0, 9.0, 7.0);
const CLEARANCE: f32 = 0.04;
/// How far in front of other paper a hand slides over it, in units, and from how many cells away along the
/// sheet paper is other paper.
const SLIDE: f32 = 0.14;
const OTHER: u32 = 9;

/// What a pointer came down with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressKind {
    /// The left button of a mouse, a finger, a pen.
    Main,
    /// The right button: it always takes the camera.
    Turn,
}

/// A hand on the paper.
#[derive(Debug)]
struct ParticleGrab {
    grab: Grab,
    particle: u32,
    /// Where it is, and where its pointer wants it [m].
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
    /// `None`: it has gone and left its hand.
    id: Option<u32>,
    at: Vec2,
    hold: ReceiptHold,
}

/// All pointers.
#[derive(Debug, Default)]
pub struct ReceiptPointers {
    down: Vec<ReceiptPointer>,
    hover: Option<Vec2>,
    leave_in_place: bool,
}

/// What pointers act on.
pub struct ReceiptPickContext<'a> {
    /// The receipt.
    pub cloth: &'a mut Cloth,
    /// The camera rig, in units.
    pub camera: &'a mut Camera,
    /// Where the camera is in this frame, in metres.
    pub view: CameraView,
    /// The screen.
    pub screen: Screen,
    /// Particles across the sheet.
    pub columns: u32,
    /// Whether pointers slide over paper that is in front of them, and not through it.
    pub slides: bool,
    /// Length of a unit [m].
    pub unit: f32,
}

impl ReceiptPointers {
    /// Whether any pointer is down.
    pub fn is_any_down(&self) -> bool {
        !self.down.is_empty()
    }

    /// Whether any hand holds paper.
    pub fn holds_cloth(&self) -> bool {
        self.grabs().next().is_some()
    }

    /// What pointers hold: which particle, and where the hand is [m].
    pub fn grabs(&self) -> impl Iterator<Item = (u32, Vec3)> + '_ {
        self.down.iter().filter_map(|pointer| match &pointer.hold {
            ReceiptHold::Paper(held) => Some((held.particle, held.now)),
            ReceiptHold::Camera => None,
        })
    }

    /// A pointer comes down: on paper or near it it takes hold, elsewhere it takes the camera.
    ///
    /// A second finger that lands beside the paper turns both into a pinch.
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

    /// A pointer moves, up or down.
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

    /// A pointer goes up, is cancelled or is lost: it lets go, or leaves its hand there.
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

    /// From now on pointers stay where their pointers leave them; or those that were left let go.
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

    /// The pointer has left the screen.
    pub fn clear_hover(&mut self) {
        self.hover = None;
    }

    /// Sends every hand to where its pointer is, also when only the camera has moved: on the plane through
    /// it that faces the camera, and not through paper that lies in front of it.
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

    /// Moves every hand for a tick.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<()> {
        let share = 1.0 - (-seconds / FOLLOW).exp();
        for pointer in &mut self.down {
            if let ReceiptHold::Paper(held) = &mut pointer.hold {
                held.now = held.now.lerp(held.goal, share);
                cloth.move_grab(held.grab, held.now)?;
            }
        }
        Ok(())
    }

    /// Every hand lets go.
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

    /// Forgets every pointer without asking the cloth, which has been replaced.
    pub fn clear(&mut self) {
        self.down.clear();
    }

    /// What the cursor should say.
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

    /// Fingers that held paper hold the camera now: a pinch begins. ReceiptPointers that were left stay.
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
    /// The unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.view.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Takes hold of what is under a pixel, or near it.
    fn grab_at(&mut self, at: Vec2) -> Result<Option<ParticleGrab>> {
        let (eye, ray) = (self.view.eye, self.ray(at));
        let Some((grab, now)) = self.cloth.grab_ray(eye, ray, GRAB * self.unit)? else {
            return Ok(None);
        };
        let particle = self.cloth.positions().iter().position(|x| *x == now);
        let particle = particle.map_or(0, |particle| particle as u32);
        Ok(Some(ParticleGrab { grab, particle, now, goal: now }))
    }

    /// Where a pointer wants a hand.
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
            let over = (hit.position - self.view.eye).dot(forward) - SLIDE * self.unit;
            if away > OTHER && over < depth {
                depth = over;
            }
        }
        let to = self.view.eye + ray * (depth / ray.dot(forward));
        let near = (to / self.unit).clamp(-REACH, REACH);
        Ok(near.with_y(near.y.max(FLOOR + CLEARANCE)) * self.unit)
    }
}
