//! Packing of descriptors into flat lists of numbers and back.
//!
//! A list holds the fields one after the other, in the order of the tables in `package/fields.js`;
//! vectors take three numbers, rotations four, switches and choices one. An f64 holds every f32
//! and every u32 exactly, so no value changes on the way.
//!
//! Invariant: each `pack_…` writes the order that its `unpack_…` reads.

use core::slice::Iter;
use glam::{Quat, Vec3};
use muslin::{GridDesc, Material, MeshDesc, PinMode, SelfCollision, Settings, Wind, WindModel};

/// Reads a flat list from its start. A missing number reads as NaN, a missing count as 0; the core
/// refuses both.
pub(crate) struct Reader<'a>(Iter<'a, f64>);

impl<'a> Reader<'a> {
    pub fn new(list: &'a [f64]) -> Self {
        Self(list.iter())
    }

    fn next(&mut self) -> f64 {
        self.0.next().copied().unwrap_or(f64::NAN)
    }

    pub fn number(&mut self) -> f32 {
        self.next() as f32
    }

    pub fn count(&mut self) -> u32 {
        self.next() as u32
    }

    fn switch(&mut self) -> bool {
        self.next() != 0.0
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    pub fn rotation(&mut self) -> Quat {
        Quat::from_xyzw(self.number(), self.number(), self.number(), self.number())
    }
}

/// Appends values to a flat list.
#[derive(Default)]
pub(crate) struct Writer(pub Vec<f64>);

impl Writer {
    pub fn number(&mut self, value: f32) {
        self.0.push(f64::from(value));
    }

    pub fn numbers(&mut self, values: &[f32]) {
        values.iter().for_each(|value| self.number(*value));
    }

    pub fn count(&mut self, value: u32) {
        self.0.push(f64::from(value));
    }

    pub fn counts(&mut self, values: &[u32]) {
        values.iter().for_each(|value| self.count(*value));
    }

    fn switch(&mut self, value: bool) {
        self.count(u32::from(value));
    }

    pub fn vector(&mut self, value: Vec3) {
        self.numbers(&value.to_array());
    }
}

pub(crate) fn unpack_settings(list: &[f64]) -> Settings {
    let mut list = Reader::new(list);
    Settings {
        tick: list.number(),
        substeps: list.count(),
        iterations: list.count(),
        max_ticks_per_advance: list.count(),
        gravity: list.vector(),
        damping: list.number(),
        max_displacement: list.number(),
        max_stretch: list.number(),
        tethers: list.switch(),
        self_collision: match list.count() {
            0 => SelfCollision::None,
            1 => SelfCollision::Surface,
            _ => SelfCollision::Particles,
        },
        self_distance: list.number(),
        tearing: list.switch(),
        max_tears_per_tick: list.count(),
        sleep_speed: list.number(),
        pressure: list.number(),
    }
}

pub(crate) fn pack_settings(settings: &Settings) -> Vec<f64> {
    let mut list = Writer::default();
    list.number(settings.tick);
    list.counts(&[settings.substeps, settings.iterations, settings.max_ticks_per_advance]);
    list.vector(settings.gravity);
    list.numbers(&[settings.damping, settings.max_displacement, settings.max_stretch]);
    list.switch(settings.tethers);
    list.count(settings.self_collision as u32);
    list.number(settings.self_distance);
    list.switch(settings.tearing);
    list.count(settings.max_tears_per_tick);
    list.numbers(&[settings.sleep_speed, settings.pressure]);
    list.0
}

pub(crate) fn unpack_material(list: &[f64]) -> Material {
    let mut list = Reader::new(list);
    Material {
        density: list.number(),
        thickness: list.number(),
        stretch_stiffness_warp: list.number(),
        stretch_stiffness_weft: list.number(),
        shear_stiffness: list.number(),
        bend_stiffness: list.number(),
        bend_damping: list.number(),
        stretch_damping: list.number(),
        friction: list.number(),
        restitution: list.number(),
        drag: list.number(),
        lift: list.number(),
        tear_stretch: list.number(),
        tear_variation: list.number(),
        yield_angle: list.number(),
        yield_creep: list.number(),
        fold_length: list.number(),
        yield_hardening: list.number(),
        yield_weakening: list.number(),
    }
}

pub(crate) fn pack_material(material: &Material) -> Vec<f64> {
    let mut list = Writer::default();
    list.numbers(&[
        material.density,
        material.thickness,
        material.stretch_stiffness_warp,
        material.stretch_stiffness_weft,
        material.shear_stiffness,
        material.bend_stiffness,
        material.bend_damping,
        material.stretch_damping,
        material.friction,
        material.restitution,
        material.drag,
        material.lift,
        material.tear_stretch,
        material.tear_variation,
        material.yield_angle,
        material.yield_creep,
        material.fold_length,
        material.yield_hardening,
        material.yield_weakening,
    ]);
    list.0
}

pub(crate) fn unpack_wind(list: &[f64]) -> Wind {
    let mut list = Reader::new(list);
    Wind {
        model: if list.count() == 0 { WindModel::Surface } else { WindModel::SineField },
        velocity: list.vector(),
        gust: list.number(),
        wander: list.number(),
        turbulence: list.number(),
        air_density: list.number(),
        seed: list.count(),
    }
}

pub(crate) fn pack_wind(wind: &Wind) -> Vec<f64> {
    let mut list = Writer::default();
    list.count(wind.model as u32);
    list.vector(wind.velocity);
    list.numbers(&[wind.gust, wind.wander, wind.turbulence, wind.air_density]);
    list.count(wind.seed);
    list.0
}

pub(crate) fn unpack_grid(list: &[f64]) -> GridDesc {
    let mut list = Reader::new(list);
    GridDesc {
        columns: list.count(),
        rows: list.count(),
        spacing: list.number(),
        origin: list.vector(),
        right: list.vector(),
        down: list.vector(),
        pin_mode: match list.count() {
            0 => PinMode::None,
            1 => PinMode::TopEdge,
            2 => PinMode::TopCorners,
            _ => PinMode::Corners,
        },
        extra_particles: list.count(),
        ..GridDesc::default()
    }
}

pub(crate) fn pack_grid(desc: &GridDesc) -> Vec<f64> {
    let mut list = Writer::default();
    list.counts(&[desc.columns, desc.rows]);
    list.number(desc.spacing);
    list.vector(desc.origin);
    list.vector(desc.right);
    list.vector(desc.down);
    list.counts(&[desc.pin_mode as u32, desc.extra_particles]);
    list.0
}

pub(crate) fn unpack_mesh(list: &[f64]) -> MeshDesc {
    let mut list = Reader::new(list);
    MeshDesc {
        weld_distance: list.number(),
        extra_particles: list.count(),
        simplify_below: list.number(),
        ..MeshDesc::default()
    }
}

pub(crate) fn pack_mesh(desc: &MeshDesc) -> Vec<f64> {
    let mut list = Writer::default();
    list.number(desc.weld_distance);
    list.count(desc.extra_particles);
    list.number(desc.simplify_below);
    list.0
}

/// Converts x y z x y z … to vectors; drops an incomplete vector at the end.
pub(crate) fn to_vectors(list: &[f32]) -> Vec<Vec3> {
    list.as_chunks::<3>().0.iter().copied().map(Vec3::from_array).collect()
}

/// Converts vectors to x y z x y z ….
pub(crate) fn to_numbers(vectors: &mut dyn Iterator<Item = Vec3>) -> Vec<f32> {
    vectors.flat_map(|v| v.to_array()).collect()
}

/// Converts position and rotation, seven numbers, to a pose.
pub(crate) fn to_pose(list: &[f64]) -> (Vec3, Quat) {
    let mut list = Reader::new(list);
    (list.vector(), list.rotation())
}
