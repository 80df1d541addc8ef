//! Settings, material and wind, as the properties of the node give them.
//!
//! Reads the properties; writes descriptors that the library then checks.
//! Invariant: a whole number below zero becomes 0, which the library refuses by name.

use crate::choices::{FabricPreset, OF_PRESET, SelfCollisionMode, WindMode};
use crate::convert::to_muslin;
use crate::node::MuslinCloth3D;
use crate::parameters::Parameters;
use godot::classes::Engine;
use godot::obj::Singleton;
use muslin::{Material, Preset, SelfCollision, Settings, Wind, WindModel};

/// A whole number that a descriptor takes; what is out of range becomes 0.
fn count(value: i64) -> u32 {
    u32::try_from(value).unwrap_or(0)
}

impl MuslinCloth3D {
    /// Reads settings, material and wind.
    pub(crate) fn parameters(&self) -> Parameters {
        Parameters { settings: self.settings(), material: self.material(), wind: self.wind() }
    }

    fn settings(&self) -> Settings {
        Settings {
            tick: (1.0 / f64::from(Engine::singleton().get_physics_ticks_per_second())) as f32,
            substeps: count(self.substeps),
            iterations: count(self.iterations),
            gravity: to_muslin(self.gravity),
            damping: self.damping,
            max_displacement: self.max_displacement,
            max_stretch: self.max_stretch,
            tethers: self.tethers,
            self_collision: match self.self_collision {
                SelfCollisionMode::None => SelfCollision::None,
                SelfCollisionMode::Surface => SelfCollision::Surface,
                SelfCollisionMode::Particles => SelfCollision::Particles,
            },
            self_distance: self.self_distance,
            tearing: self.tearing,
            max_tears_per_tick: count(self.max_tears_per_tick),
            sleep_speed: self.sleep_speed,
            pressure: self.pressure,
            ..Settings::default()
        }
    }

    fn material(&self) -> Material {
        let mut material = Material::preset(match self.preset {
            FabricPreset::Silk => Preset::Silk,
            FabricPreset::Cotton => Preset::Cotton,
            FabricPreset::Denim => Preset::Denim,
            FabricPreset::Leather => Preset::Leather,
            FabricPreset::Paper => Preset::Paper,
            FabricPreset::FlagNylon => Preset::FlagNylon,
        });
        for (value, field) in [
            (self.density, &mut material.density),
            (self.thickness, &mut material.thickness),
            (self.stretch_stiffness_warp, &mut material.stretch_stiffness_warp),
            (self.stretch_stiffness_weft, &mut material.stretch_stiffness_weft),
            (self.shear_stiffness, &mut material.shear_stiffness),
            (self.bend_stiffness, &mut material.bend_stiffness),
            (self.bend_damping, &mut material.bend_damping),
            (self.stretch_damping, &mut material.stretch_damping),
            (self.friction, &mut material.friction),
            (self.restitution, &mut material.restitution),
            (self.drag, &mut material.drag),
            (self.lift, &mut material.lift),
            (self.tear_stretch, &mut material.tear_stretch),
            (self.tear_variation, &mut material.tear_variation),
            (self.yield_angle, &mut material.yield_angle),
            (self.yield_creep, &mut material.yield_creep),
            (self.fold_length, &mut material.fold_length),
            (self.yield_hardening, &mut material.yield_hardening),
            (self.yield_weakening, &mut material.yield_weakening),
        ] {
            if value != OF_PRESET {
                *field = value;
            }
        }
        material
    }

    fn wind(&self) -> Wind {
        Wind {
            model: match self.wind_model {
                WindMode::Surface => WindModel::Surface,
                WindMode::SineField => WindModel::SineField,
            },
            velocity: to_muslin(self.wind_velocity),
            gust: self.wind_gust,
            wander: self.wind_wander,
            turbulence: self.wind_turbulence,
            air_density: self.wind_air_density,
            seed: self.wind_seed as u32,
        }
    }
}
