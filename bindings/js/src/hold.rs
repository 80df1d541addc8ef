//! Pins, grabs, colliders, and tears by hand.

use crate::RawCloth;
use crate::numbers::{self, Reader, Writer};
use crate::refusal::{Result, refusal};
use glam::{Quat, Vec3};
use muslin::{Collider, ColliderDesc, Grab, Shape};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Holds a particle where it is.
    pub fn pin_here(&mut self, particle: u32) -> Result<()> {
        self.cloth.pin(particle, None).map_err(refusal)
    }

    /// Holds a particle at a target.
    pub fn pin_at(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.pin(particle, Some(Vec3::new(x, y, z))).map_err(refusal)
    }

    /// Lets a particle go.
    pub fn unpin(&mut self, particle: u32) -> Result<()> {
        self.cloth.unpin(particle).map_err(refusal)
    }

    /// Lets every particle go.
    pub fn unpin_all(&mut self) {
        self.cloth.unpin_all();
    }

    /// Gives many pins their targets at once.
    pub fn set_pin_targets(&mut self, particles: &[u32], targets: &[f32]) -> Result<()> {
        self.cloth.set_pin_targets(particles, &numbers::vectors(targets)).map_err(refusal)
    }

    /// The pinned particles, lowest first.
    pub fn pinned(&self) -> Vec<u32> {
        self.cloth.pinned().collect()
    }

    /// Puts a particle somewhere.
    pub fn set_position(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.set_position(particle, Vec3::new(x, y, z)).map_err(refusal)
    }

    /// Gives a particle a velocity.
    pub fn set_velocity(&mut self, particle: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.set_velocity(particle, Vec3::new(x, y, z)).map_err(refusal)
    }

    /// Takes hold of a particle; gives the grab's number.
    pub fn grab_particle(&mut self, particle: u32) -> Result<u32> {
        self.cloth.grab_particle(particle).map(Grab::to_bits).map_err(refusal)
    }

    /// Takes hold of what a ray points at; `ray` is its origin and direction. Gives the grab's number
    /// and where it took hold, or nothing.
    pub fn grab_ray(&mut self, ray: &[f64], radius: f32) -> Result<Vec<f64>> {
        let mut ray = Reader::new(ray);
        let grabbed = self.cloth.grab_ray(ray.vector(), ray.vector(), radius).map_err(refusal)?;
        let mut list = Writer::default();
        if let Some((grab, at)) = grabbed {
            list.count(grab.to_bits());
            list.vector(at);
        }
        Ok(list.0)
    }

    /// Gives a grab a new target.
    pub fn move_grab(&mut self, grab: u32, x: f32, y: f32, z: f32) -> Result<()> {
        self.cloth.move_grab(Grab::from_bits(grab), Vec3::new(x, y, z)).map_err(refusal)
    }

    /// Lets a grabbed particle go.
    pub fn release(&mut self, grab: u32) -> Result<()> {
        self.cloth.release(Grab::from_bits(grab)).map_err(refusal)
    }

    /// Adds a collider; gives its number.
    pub fn add_collider(
        &mut self,
        desc: &[f64],
        positions: &[f32],
        indices: &[u32],
        heights: &[f32],
    ) -> Result<u32> {
        let mut list = Reader::new(desc);
        let desc = ColliderDesc {
            shape: Shape::from_number(list.count()).map_err(refusal)?,
            position: list.vector(),
            rotation: list.rotation(),
            friction: list.number(),
            restitution: list.number(),
            tangential_restitution: list.number(),
            thickness: list.number(),
            radius: list.number(),
            top_radius: list.number(),
            half_height: list.number(),
            half_extents: list.vector(),
            spacing: list.number(),
            columns: list.count(),
            rows: list.count(),
            positions: numbers::vectors(positions),
            indices: indices.to_vec(),
            heights: heights.to_vec(),
        };
        self.cloth.add_collider(&desc).map(Collider::to_bits).map_err(refusal)
    }

    /// Moves a collider; `pose` is its position and rotation.
    pub fn move_collider(&mut self, collider: u32, pose: &[f64]) -> Result<()> {
        let mut pose = Reader::new(pose);
        let (position, rotation): (Vec3, Quat) = (pose.vector(), pose.rotation());
        let collider = Collider::from_bits(collider);
        self.cloth.move_collider(collider, position, rotation).map_err(refusal)
    }

    /// Puts a collider somewhere at once; `pose` is its position and rotation.
    pub fn teleport_collider(&mut self, collider: u32, pose: &[f64]) -> Result<()> {
        let mut pose = Reader::new(pose);
        let (position, rotation): (Vec3, Quat) = (pose.vector(), pose.rotation());
        let collider = Collider::from_bits(collider);
        self.cloth.teleport_collider(collider, position, rotation).map_err(refusal)
    }

    /// Removes a collider.
    pub fn remove_collider(&mut self, collider: u32) -> Result<()> {
        self.cloth.remove_collider(Collider::from_bits(collider)).map_err(refusal)
    }

    /// What a collider got in the last tick: momentum, then angular momentum.
    pub fn collider_impulse(&self, collider: u32) -> Result<Vec<f64>> {
        let collider = Collider::from_bits(collider);
        let impulse = self.cloth.collider_impulse(collider).map_err(refusal)?;
        let mut list = Writer::default();
        list.vector(impulse.linear);
        list.vector(impulse.angular);
        Ok(list.0)
    }

    /// Cuts with a blade: `blade` is where it is from, where to, and its sweep; says how many edges opened.
    pub fn cut(&mut self, blade: &[f64]) -> Result<u32> {
        let mut blade = Reader::new(blade);
        let (from, to, sweep) = (blade.vector(), blade.vector(), blade.vector());
        self.cloth.cut(from, to, sweep).map_err(refusal)
    }

    /// Folds along a line: `line` is where it is from and where to.
    pub fn crease(&mut self, line: &[f64], angle: f32) -> Result<()> {
        let mut line = Reader::new(line);
        self.cloth.crease(line.vector(), line.vector(), angle).map_err(refusal)
    }

    /// Tears between two neighbouring particles; says whether it tore.
    pub fn tear_edge(&mut self, particle_a: u32, particle_b: u32) -> Result<bool> {
        self.cloth.tear_edge(particle_a, particle_b).map_err(refusal)
    }
}
