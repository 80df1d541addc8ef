//! Hands on the receipt: each pointer holds the paper at one place, or the camera. Hands may be left
//! where they are, so that one pointer is as good as two.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Grab, Result};
use muslin_scenes::receipt::FLOOR;

use crate::camera::{Camera, Sight};
use crate::pointer::{Cursor, Screen, turn};

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
pub enum Button {
    /// The left button of a mouse, a finger, a pen.
    Main,
    /// The right button: it always takes the camera.
    Turn,
}

/// A hand on the paper.
#[derive(Debug)]
struct Grip {
    grab: Grab,
    particle: u32,
    /// Where it is, and where its pointer wants it [m].
    now: Vec3,
    goal: Vec3,
}

#[derive(Debug)]
enum Hold {
    Paper(Grip),
    Camera,
}

#[derive(Debug)]
struct Pointer {
    /// `None`: it has gone and left its hand.
    id: Option<u32>,
    at: Vec2,
    hold: Hold,
}

/// All hands.
#[derive(Debug, Default)]
pub struct Hands {
    down: Vec<Pointer>,
    hover: Option<Vec2>,
    stay: bool,
}

/// What hands act on.
pub struct Table<'a> {
    /// The receipt.
    pub cloth: &'a mut Cloth,
    /// The camera rig, in units.
    pub camera: &'a mut Camera,
    /// Where the camera is in this frame, in metres.
    pub sight: Sight,
    /// The screen.
    pub screen: Screen,
    /// Particles across the sheet.
    pub columns: u32,
    /// Whether hands slide over paper that is in front of them, and not through it.
    pub slides: bool,
    /// Length of a unit [m].
    pub unit: f32,
}

impl Hands {
    /// Whether any pointer is down.
    pub fn any(&self) -> bool {
        !self.down.is_empty()
    }

    /// Whether any hand holds paper.
    pub fn holds_paper(&self) -> bool {
        self.grips().next().is_some()
    }

    /// What hands hold: which particle, and where the hand is [m].
    pub fn grips(&self) -> impl Iterator<Item = (u32, Vec3)> + '_ {
        self.down.iter().filter_map(|pointer| match &pointer.hold {
            Hold::Paper(grip) => Some((grip.particle, grip.now)),
            Hold::Camera => None,
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
        button: Button,
        table: &mut Table<'_>,
    ) -> Result<()> {
        if !at.is_finite() {
            return Ok(());
        }
        self.lift(id, table)?;
        let taken = if button == Button::Main { table.take(at)? } else { None };
        let hold = match taken {
            Some(grip) => Hold::Paper(grip),
            None => {
                self.open_fingers(table)?;
                Hold::Camera
            }
        };
        self.down.push(Pointer { id: Some(id), at, hold });
        Ok(())
    }

    /// A pointer moves, up or down.
    pub fn drag(&mut self, id: u32, to: Vec2, table: &mut Table<'_>) {
        if !to.is_finite() {
            return;
        }
        let Some(moved) = self.down.iter().position(|p| p.id == Some(id)) else {
            self.hover = Some(to);
            return;
        };
        let from = std::mem::replace(&mut self.down[moved].at, to);
        if matches!(self.down[moved].hold, Hold::Camera) {
            let others: Vec<Vec2> = self
                .down
                .iter()
                .filter(|p| p.id != Some(id) && matches!(p.hold, Hold::Camera))
                .map(|p| p.at)
                .collect();
            turn(table.camera, table.screen, [from, to], &others);
        }
    }

    /// A pointer goes up, is cancelled or is lost: it lets go, or leaves its hand there.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn lift(&mut self, id: u32, table: &mut Table<'_>) -> Result<()> {
        let Some(i) = self.down.iter().position(|p| p.id == Some(id)) else {
            return Ok(());
        };
        if self.stay && matches!(self.down[i].hold, Hold::Paper(_)) {
            self.down[i].id = None;
            return Ok(());
        }
        match self.down.swap_remove(i).hold {
            Hold::Paper(grip) => table.cloth.release(grip.grab),
            Hold::Camera => Ok(()),
        }
    }

    /// From now on hands stay where their pointers leave them; or those that were left let go.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn stay(&mut self, on: bool, table: &mut Table<'_>) -> Result<()> {
        self.stay = on;
        if on {
            return Ok(());
        }
        for pointer in self.down.extract_if(.., |pointer| pointer.id.is_none()) {
            if let Hold::Paper(grip) = pointer.hold {
                table.cloth.release(grip.grab)?;
            }
        }
        Ok(())
    }

    /// The pointer has left the screen.
    pub fn leave(&mut self) {
        self.hover = None;
    }

    /// Sends every hand to where its pointer is, also when only the camera has moved: on the plane through
    /// it that faces the camera, and not through paper that lies in front of it.
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub fn follow(&mut self, table: &mut Table<'_>) -> Result<()> {
        for pointer in &mut self.down {
            if let (Some(_), Hold::Paper(grip)) = (pointer.id, &mut pointer.hold) {
                grip.goal = table.goal(pointer.at, grip)?;
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
            if let Hold::Paper(grip) = &mut pointer.hold {
                grip.now = grip.now.lerp(grip.goal, share);
                cloth.move_grab(grip.grab, grip.now)?;
            }
        }
        Ok(())
    }

    /// Every hand lets go.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn open(&mut self, table: &mut Table<'_>) -> Result<()> {
        for pointer in self.down.extract_if(.., |p| matches!(p.hold, Hold::Paper(_))) {
            if let Hold::Paper(grip) = pointer.hold {
                table.cloth.release(grip.grab)?;
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
    pub fn cursor(&self, table: &Table<'_>) -> Result<Cursor> {
        if self.down.iter().any(|p| p.id.is_some() && matches!(p.hold, Hold::Paper(_))) {
            return Ok(Cursor::Grabbing);
        }
        match self.hover {
            Some(at) if self.down.iter().all(|p| p.id.is_none()) => {
                let hit = table.cloth.raycast(table.sight.eye, table.ray(at), f32::INFINITY)?;
                Ok(if hit.is_some() { Cursor::Grab } else { Cursor::Default })
            }
            _ => Ok(Cursor::Default),
        }
    }

    /// Fingers that held paper hold the camera now: a pinch begins. Hands that were left stay.
    fn open_fingers(&mut self, table: &mut Table<'_>) -> Result<()> {
        for pointer in self.down.iter_mut().filter(|pointer| pointer.id.is_some()) {
            if let Hold::Paper(grip) = std::mem::replace(&mut pointer.hold, Hold::Camera) {
                table.cloth.release(grip.grab)?;
            }
        }
        Ok(())
    }
}

impl Table<'_> {
    /// The unit direction from the eye through a pixel.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.sight.ray(self.screen.normal(at), self.screen.aspect())
    }

    /// Takes hold of what is under a pixel, or near it.
    fn take(&mut self, at: Vec2) -> Result<Option<Grip>> {
        let (eye, ray) = (self.sight.eye, self.ray(at));
        let Some((grab, now)) = self.cloth.grab_ray(eye, ray, GRAB * self.unit)? else {
            return Ok(None);
        };
        let particle = self.cloth.positions().iter().position(|x| *x == now);
        let particle = particle.map_or(0, |particle| particle as u32);
        Ok(Some(Grip { grab, particle, now, goal: now }))
    }

    /// Where a pointer wants a hand.
    fn goal(&self, at: Vec2, grip: &Grip) -> Result<Vec3> {
        let (ray, forward) = (self.ray(at), self.sight.forward());
        let mut depth = (grip.goal - self.sight.eye).dot(forward);
        if self.slides
            && let Some(hit) = self.cloth.raycast(self.sight.eye, ray, f32::INFINITY)?
        {
            let cell = |particle: u32| {
                let source = self.cloth.source_vertices()[particle as usize];
                [source / self.columns, source % self.columns]
            };
            let (held, met) = (cell(grip.particle), cell(hit.particle));
            let away = held[0].abs_diff(met[0]).max(held[1].abs_diff(met[1]));
            let over = (hit.position - self.sight.eye).dot(forward) - SLIDE * self.unit;
            if away > OTHER && over < depth {
                depth = over;
            }
        }
        let to = self.sight.eye + ray * (depth / ray.dot(forward));
        let near = (to / self.unit).clamp(-REACH, REACH);
        Ok(near.with_y(near.y.max(FLOOR + CLEARANCE)) * self.unit)
    }
}
