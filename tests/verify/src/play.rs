//! A scene while it runs: the cloth, its bodies, and what moves them.

use crate::checks::bodies::Body;
use crate::checks::stretch::RestShape;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Grab, GridDesc, MeshDesc, Result};

/// A cloth with its bodies.
#[derive(Debug)]
pub struct Play {
    pub cloth: Cloth,
    pub bodies: Vec<Body>,
    /// Grabs with the particle that each holds.
    pub grabs: Vec<(Grab, u32)>,
    /// The shape of the new cloth.
    pub rest: RestShape,
}

impl Play {
    pub fn grid(desc: &GridDesc) -> Result<Self> {
        Ok(Self::new(Cloth::grid(desc)?))
    }

    pub fn mesh(desc: &MeshDesc) -> Result<Self> {
        Ok(Self::new(Cloth::mesh(desc)?))
    }

    /// Starts with a new cloth, which is at rest in its rest shape.
    pub fn new(cloth: Cloth) -> Self {
        let rest = RestShape::of(&cloth);
        Self { cloth, bodies: Vec::new(), grabs: Vec::new(), rest }
    }

    /// Adds a body, and returns its index.
    pub fn add(&mut self, desc: ColliderDesc) -> Result<usize> {
        let collider = self.cloth.add_collider(&desc)?;
        self.bodies.push(Body::new(collider, desc));
        Ok(self.bodies.len() - 1)
    }

    /// Moves a body to a pose that it reaches at the end of the next tick.
    pub fn move_body(&mut self, index: usize, position: Vec3, rotation: Quat) -> Result<()> {
        let body = &mut self.bodies[index];
        (body.desc.position, body.desc.rotation) = (position, rotation);
        self.cloth.move_collider(body.collider, position, rotation)
    }

    /// Gives a mesh body the vertices that it reaches at the end of the next tick.
    pub fn deform_body(&mut self, index: usize, positions: Vec<Vec3>) -> Result<()> {
        let body = &mut self.bodies[index];
        self.cloth.update_collider(body.collider, &positions)?;
        body.deform(positions);
        Ok(())
    }

    pub fn grab(&mut self, particle: u32) -> Result<()> {
        let grab = self.cloth.grab_particle(particle)?;
        self.grabs.push((grab, particle));
        Ok(())
    }

    /// For each particle, whether a pin or a grab holds it.
    pub fn held(&self) -> Vec<bool> {
        let mut held = vec![false; self.cloth.particle_count() as usize];
        let grabbed = self.grabs.iter().map(|(_, particle)| *particle);
        self.cloth.pinned().chain(grabbed).for_each(|particle| held[particle as usize] = true);
        held
    }

    /// Sets the velocity of every particle by its position.
    pub fn set_velocities(&mut self, velocity: impl Fn(Vec3) -> Vec3) -> Result<()> {
        for i in 0..self.cloth.particle_count() {
            if let Some(x) = self.cloth.position(i) {
                self.cloth.set_velocity(i, velocity(x))?;
            }
        }
        Ok(())
    }

    /// Root mean square speed [m/s].
    pub fn rms_speed(&self) -> f32 {
        let count = self.cloth.particle_count();
        let speeds = (0..count).filter_map(|i| self.cloth.velocity(i));
        (speeds.map(|v| v.length_squared()).sum::<f32>() / count as f32).sqrt()
    }

    /// The fastest particle's speed [m/s].
    pub fn max_speed(&self) -> f32 {
        let speeds = (0..self.cloth.particle_count()).filter_map(|i| self.cloth.velocity(i));
        speeds.map(|v| v.length()).fold(0.0, f32::max)
    }
}

/// Acts before a tick, which is counted from 0.
pub type Drive = Box<dyn FnMut(&mut Play, u32) -> Result<()>>;

/// Checks something of the scene's own after a tick; a sentence says what is wrong.
pub type Watch = Box<dyn FnMut(&Play, u32) -> std::result::Result<(), String>>;

/// A scene that is ready to run.
pub struct Setup {
    pub play: Play,
    pub drive: Drive,
    pub watch: Watch,
    /// Whether the cloth is free, in vacuum and without damping, so that its momentum has a budget.
    pub is_free: bool,
}

impl From<Play> for Setup {
    fn from(play: Play) -> Self {
        Self {
            play,
            drive: Box::new(|_, _| Ok(())),
            watch: Box::new(|_, _| Ok(())),
            is_free: false,
        }
    }
}

impl Setup {
    pub fn drive(self, drive: impl FnMut(&mut Play, u32) -> Result<()> + 'static) -> Self {
        Self { drive: Box::new(drive), ..self }
    }

    pub fn watch(
        self,
        watch: impl FnMut(&Play, u32) -> std::result::Result<(), String> + 'static,
    ) -> Self {
        Self { watch: Box::new(watch), ..self }
    }

    /// Checks the budget of momentum too. The settings and the material must not damp.
    pub fn free(self) -> Self {
        Self { is_free: true, ..self }
    }
}

/// A scene of the proof.
pub struct Scene {
    pub name: String,
    /// Ticks to run.
    pub ticks: u32,
    /// Ticks to run with `--short`; none if the scene is left out then.
    pub short_ticks: Option<u32>,
    pub build: Box<dyn Fn() -> Result<Setup>>,
}

impl Scene {
    pub fn new(
        name: impl Into<String>,
        ticks: u32,
        build: impl Fn() -> Result<Setup> + 'static,
    ) -> Self {
        Self { name: name.into(), ticks, short_ticks: None, build: Box::new(build) }
    }

    /// Makes the scene part of the short run, with this many ticks.
    pub fn short(self, ticks: u32) -> Self {
        Self { short_ticks: Some(ticks), ..self }
    }
}
