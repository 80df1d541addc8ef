//! Solver settings, and the time integration scheme that follows from them. Settings may change
//! between ticks.

use crate::error::{Error, Result, check, check_finite};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Solver settings: tick length, substeps and iterations, gravity, damping, limits, and optional
/// features. All may change between ticks.
///
/// A tick runs `substeps` substeps; each predicts the particles and then sweeps `iterations` times
/// over all links. More of either makes the cloth stiffer. At equal cost, substeps stiffen more
/// than iterations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Length of a tick [s], above 0, at most 1. Default: 1/60.
    pub tick: f32,
    /// Least number of substeps per tick, 1 to 1000. Default: 4.
    ///
    /// Where cloth and colliders move fast relative to each other, a tick runs up to 8 times as
    /// many, but not more than 64 unless this is larger. [`Stats::substeps`](crate::Stats) tells
    /// the number of the last tick.
    pub substeps: u32,
    /// Sweeps over the links per substep, alternating in direction, 1 to 1000. Default: 2.
    ///
    /// With one sweep, integration is of first order, which damps all motion. From two sweeps on it
    /// is of second order (BDF2), and only `damping`, the air and the material damp.
    pub iterations: u32,
    /// Maximum number of ticks that one `advance` runs, at least 1; further backlog is dropped.
    /// Default: 5.
    pub max_ticks_per_advance: u32,
    /// Acceleration of gravity [m/s²]. Default: (0, −9.81, 0).
    pub gravity: Vec3,
    /// Decay rate of velocity [1/s], at least 0: velocity decays as exp(−damping · t), independent
    /// of the step. Default: 0.5.
    pub damping: f32,
    /// Maximum displacement of a particle per substep, relative to the rigid motion of its piece of
    /// cloth, in mean rest lengths, above 0. It also limits the speed of a grabbed particle.
    /// Default: 0.5.
    pub max_displacement: f32,
    /// Strain limit: maximum relative elongation of any stretch or shear link after a tick; 0.02 =
    /// 2 %, 0 = no limit. Default: 0.
    ///
    /// Pins and grabs take precedence: where they hold the cloth further apart, links exceed the
    /// limit; [`Stats::over_stretched`](crate::Stats) and an event report this.
    pub max_stretch: f32,
    /// Enables long-range attachments, which limit the distance of each particle to the pins.
    /// Default: on.
    ///
    /// They carry what the sweeps have not converged to, but not the stretch of soft links under
    /// load. From two iterations on, each straight chain of links is also solved as a whole
    /// (tridiagonal), so that a load reaches the pins in one step. Off, only the sweeps act.
    pub tethers: bool,
    /// How the cloth collides with itself. Default: not at all.
    pub self_collision: SelfCollision,
    /// Gap of self-collision [m], at least 0; 0 = automatic. Default: 0.
    ///
    /// `Surface`: automatic is the material's thickness; at most half of the mean rest length is
    /// used. `Particles`: automatic is two thirds of the mean rest length; at most twice that
    /// length is used.
    pub self_distance: f32,
    /// Enables tearing of overstretched edges, see [`Material::tear_stretch`](crate::Material), and
    /// allocates the memory that tears need. Default: off.
    pub tearing: bool,
    /// Maximum number of vertices that tearing splits in one tick, the most overstretched first, at
    /// least 1. Default: 8.
    pub max_tears_per_tick: u32,
    /// Speed below which a cloth may sleep [m/s], at least 0; 0 = never. Default: 0.
    ///
    /// A cloth falls asleep after half a second without a faster particle. It then does not move,
    /// at nearly no cost, until something changes or touches it. Gusts, turbulence and the sine
    /// field keep it awake. See [`Stats::asleep`](crate::Stats).
    pub sleep_speed: f32,
    /// Over-pressure inside closed pieces of the cloth [Pa], finite. Default: 0.
    ///
    /// A piece is closed if each of its edges has two triangles, as in a ball or a cushion, or if all
    /// of its border is sewn ([`Cloth::sew`](crate::Cloth::sew)) to closed pieces. The pressure is
    /// constant, whatever the volume; a negative one sucks the sides inwards, as a vacuum does.
    /// Outwards is where the volume of the rest shape is positive, whatever the winding. A piece that
    /// is torn or cut open loses its pressure at once. Open cloth, such as a grid, feels none.
    ///
    /// Links stretch under high pressure unless `max_stretch` limits them. Where the pressure alone
    /// would move a particle of a piece by more than `max_displacement` in a substep, all of that
    /// piece gets less.
    pub pressure: f32,
}

/// How a cloth collides with itself. Several pieces of one mesh collide with each other in the same
/// way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum SelfCollision {
    /// No self-collision: layers pass through each other.
    #[default]
    None = 0,
    /// Between surfaces: triangles keep a gap and never cross, with the material's friction.
    ///
    /// - Gap: `self_distance`. Parts whose distance at rest is below two gaps keep half of that
    ///   distance. When a tear or cut opens, its two sides separate by 1/1000 of the mean rest
    ///   length, so that they collide from then on.
    /// - Pinned and grabbed parts push others out of their way. Cloth caught between two of them
    ///   may be forced through.
    /// - Existing intersections (at the start, when this is switched on, or after particles were
    ///   placed) are resolved unless they are held: the smaller part moves back to the side of the
    ///   rest, mostly within a second.
    /// - Cost: about as much as the rest of a tick while few layers touch, several times that for
    ///   stacked layers, 20 to some hundred times that for crumpling sheets of thousands of
    ///   particles.
    Surface = 1,
    /// Between particles, as spheres: cheap, no friction. A fold may slip through where particles
    /// are further apart than `self_distance`. Pairs of one piece that are closer at rest than
    /// `self_distance` or one and a half mean rest lengths are ignored, and so are held particles.
    Particles = 2,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tick: 1.0 / 60.0,
            substeps: 4,
            iterations: 2,
            max_ticks_per_advance: 5,
            gravity: Vec3::new(0.0, -9.81, 0.0),
            damping: 0.5,
            max_displacement: 0.5,
            max_stretch: 0.0,
            tethers: true,
            self_collision: SelfCollision::None,
            self_distance: 0.0,
            tearing: false,
            max_tears_per_tick: 8,
            sleep_speed: 0.0,
            pressure: 0.0,
        }
    }
}

impl Settings {
    /// Largest number of substeps per tick, and of iterations per substep.
    pub(crate) const MAX_SUBSTEPS: u32 = 1000;

    /// Refuses settings that are out of range.
    pub(crate) fn check(&self) -> Result<()> {
        check(self.tick > 0.0 && self.tick <= 1.0, "settings.tick", "be above 0 and at most 1")?;
        let few = |n: u32| (1..=Self::MAX_SUBSTEPS).contains(&n);
        check(few(self.substeps), "settings.substeps", "be from 1 to 1000")?;
        check(few(self.iterations), "settings.iterations", "be from 1 to 1000")?;
        check(self.max_ticks_per_advance >= 1, "settings.max_ticks_per_advance", "be at least 1")?;
        check_finite(self.gravity, "settings.gravity")?;
        let positive = |v: f32| v.is_finite() && v > 0.0;
        let not_negative = |v: f32| v.is_finite() && v >= 0.0;
        check(not_negative(self.damping), "settings.damping", "be at least 0 and finite")?;
        check(
            positive(self.max_displacement),
            "settings.max_displacement",
            "be above 0 and finite",
        )?;
        if cfg!(not(feature = "self-collision")) && self.self_collision == SelfCollision::Surface {
            let (what, feature) = ("surface self-collision", "self-collision");
            return Err(Error::MissingFeature { what, feature });
        }
        check(not_negative(self.max_stretch), "settings.max_stretch", "be at least 0 and finite")?;
        check(
            not_negative(self.self_distance),
            "settings.self_distance",
            "be at least 0 and finite",
        )?;
        check(self.max_tears_per_tick >= 1, "settings.max_tears_per_tick", "be at least 1")?;
        check(not_negative(self.sleep_speed), "settings.sleep_speed", "be at least 0 and finite")?;
        check(self.pressure.is_finite(), "settings.pressure", "be finite")?;
        Ok(())
    }

    /// Maximum number of links that may tear in one tick of a mesh with `triangles` triangles.
    pub(crate) fn max_tears(&self, triangles: usize) -> usize {
        (self.max_tears_per_tick as usize).min(4 * triangles)
    }

    /// The time integration scheme of a tick with `substeps` substeps: BDF2, or BDF1 with a single
    /// iteration.
    pub(crate) fn scheme(&self, substeps: u32) -> BdfScheme {
        let h = self.tick / substeps as f32;
        if self.iterations >= 2 { BdfScheme::second_order(h) } else { BdfScheme::first_order(h) }
    }
}

/// Backward difference formula (BDF) of first or second order: coefficients of prediction and
/// velocity update.
///
/// ```text
/// prediction  d   = extrapolation · d₋ + velocity_step · (v_extrapolated + velocity_step · a)
/// velocity    v   = (new_weight · d − old_weight · d₋) / h
///             v_extrapolated = v + extrapolation · (v − v₋)
/// ```
/// d is the displacement of this substep (the velocity uses it after the constraints were solved),
/// d₋ that of the last one.
///
/// BDF2 loses nearly no energy, whereas BDF1, the usual scheme of position-based dynamics, loses
/// most of it (English and Bridson, "Animating developable surfaces using nonconforming elements",
/// SIGGRAPH 2008). BDF2 needs links that are swept symmetrically, in alternating directions: the
/// phase error of sweeps in one direction would add energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BdfScheme {
    /// Length of a substep [s].
    pub h: f32,
    /// Effective step of a velocity or acceleration [s]: h, or 2/3 h for BDF2.
    pub velocity_step: f32,
    /// Weight of the last change: 0, or 1/3 for BDF2.
    pub extrapolation: f32,
    /// Weight of the displacement of this substep in the velocity: 1, or 3/2 for BDF2.
    pub new_weight: f32,
    /// Weight of the displacement of the last substep in the velocity: 0, or 1/2 for BDF2.
    pub old_weight: f32,
}

impl BdfScheme {
    fn first_order(h: f32) -> Self {
        Self { h, velocity_step: h, extrapolation: 0.0, new_weight: 1.0, old_weight: 0.0 }
    }

    /// The scheme of a substep without history: BDF1, with the extrapolation that the next substep
    /// needs.
    pub fn without_history(self) -> Self {
        Self { velocity_step: self.h, new_weight: 1.0, old_weight: 0.0, ..self }
    }

    fn second_order(h: f32) -> Self {
        Self {
            h,
            velocity_step: h * (2.0 / 3.0),
            extrapolation: 1.0 / 3.0,
            new_weight: 1.5,
            old_weight: 0.5,
        }
    }
}
