//! A cantilever strip: clamped level at one end, bent by gravity. Used to compare bending with the
//! heavy elastica.

use super::rms_speed;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, GridDesc, Material, PinMode, Settings};

/// A strip and the simulation settings for it.
#[derive(Clone, Debug)]
pub struct Strip {
    /// Particles along the strip, including the two of the clamp.
    pub nodes: u32,
    /// Particles across the strip.
    pub across: u32,
    /// Length outside the clamp [m].
    pub length: f32,
    pub gravity: f32,
    pub material: Material,
    /// Ticks per second.
    pub rate: u32,
    pub iterations: u32,
    /// Rotation of the whole scene about the vertical [rad].
    pub turn: f32,
    /// Whether the strip runs along the warp.
    pub is_warp: bool,
}

/// Shape of the strip at rest; lengths are divided by the length of the strip.
#[derive(Clone, Copy, Debug)]
pub struct StripAtRest {
    pub drop: f32,
    pub span: f32,
    pub settled: bool,
    pub seconds: f32,
    pub max_stretch: f32,
}

impl StripAtRest {
    pub fn settling_note(&self) -> String {
        let note = if self.settled { "" } else { " did not settle" };
        format!("{note} {:.1} s", self.seconds)
    }
}

impl Default for Strip {
    fn default() -> Self {
        Self {
            nodes: 40,
            across: 4,
            length: 0.2,
            gravity: 9.81,
            material: Material { drag: 0.0, density: 0.15, ..Material::default() },
            rate: 60,
            iterations: 2,
            turn: 0.0,
            is_warp: false,
        }
    }
}

impl Strip {
    /// Sets the bend stiffness so that the gravito-bending number is `gamma`.
    pub fn with_gamma(mut self, gamma: f32) -> Self {
        self.material.bend_stiffness =
            self.material.density * self.gravity * self.length.powi(3) / gamma;
        self
    }

    /// Steps until the RMS speed was below 1 mm/s for half a second, for 20 s at most.
    pub fn simulate_to_rest(&self) -> StripAtRest {
        let spacing = self.length / (self.nodes - 2) as f32;
        let rotation = Quat::from_rotation_y(self.turn);
        let (along, across) = (rotation * Vec3::X, rotation * Vec3::Z);
        let (columns, rows) =
            if self.is_warp { (self.across, self.nodes) } else { (self.nodes, self.across) };
        let desc = GridDesc {
            columns,
            rows,
            spacing,
            right: if self.is_warp { across } else { along },
            down: if self.is_warp { along } else { across },
            pin_mode: PinMode::None,
            material: self.material.clone(),
            settings: Settings {
                damping: 4.0,
                gravity: Vec3::NEG_Y * self.gravity,
                tick: 1.0 / self.rate as f32,
                iterations: self.iterations,
                ..Settings::default()
            },
            ..GridDesc::default()
        };
        let mut cloth = Cloth::grid(&desc).unwrap();
        let (mut clamp, mut tip) = (Vec::new(), Vec::new());
        for particle in 0..columns * rows {
            let (row, column) = (particle / columns, particle % columns);
            let at = if self.is_warp { row } else { column };
            if at < 2 {
                cloth.pin(particle, None).unwrap();
            }
            if at == 1 {
                clamp.push(particle);
            }
            if at == self.nodes - 1 {
                tip.push(particle);
            }
        }
        let (mut calm, mut ticks) = (0, 0);
        while calm < self.rate / 2 && ticks < 20 * self.rate {
            cloth.step(1);
            ticks += 1;
            calm = if rms_speed(&cloth) < 1.0e-3 { calm + 1 } else { 0 };
        }
        let mean = |list: &[u32]| {
            list.iter().map(|i| cloth.positions()[*i as usize]).sum::<Vec3>() / list.len() as f32
        };
        let hung = mean(&tip) - mean(&clamp);
        StripAtRest {
            drop: -hung.y / self.length,
            span: hung.dot(along) / self.length,
            settled: calm >= self.rate / 2,
            seconds: ticks as f32 / self.rate as f32,
            max_stretch: cloth.stats().max_stretch,
        }
    }
}
