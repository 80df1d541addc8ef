//! The receipt: a narrow sheet that hangs from two pins over a floor, to fold, crumple and toss.
//!
//! Two sheets share one picture. [`Sheet::Brief`] is the one of the brief, figure by figure, some five
//! metres wide. [`Sheet::Paper`] is real paper as large as a sheet of A4, and drawn as large as the
//! other one: a [`Sheet::unit`] is what the brief calls a unit.

use crate::{Cast, Scene};
use glam::{Vec2, Vec3};
use muslin::{
    Cloth, ColliderDesc, GridDesc, Material, PinMode, Preset, Result, SelfCollision, Settings,
    Wind, WindModel,
};

/// Particles across and down.
pub const FULL: [u32; 2] = [40, 60];
/// The same on small or touch screens, and where people ask for less motion.
pub const SMALL: [u32; 2] = [24, 36];
/// From particle to particle, in units.
pub const SPACING: f32 = 0.12;
/// Height of the floor, in units.
pub const FLOOR: f32 = -4.0;
/// Strength of the brief's wind.
pub const WIND: f32 = 3.0;

/// Substeps a second: the brief's 8 in each of its 120 ticks.
const SUBSTEPS_A_SECOND: f32 = 960.0;
/// The share of its velocity that the brief leaves a particle in each of them.
const KEPT: f32 = 0.99;

/// What the receipt is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sheet {
    /// Paper of 80 g/m² that hardly stretches and keeps its folds.
    #[default]
    Paper,
    /// Links as the brief lays them.
    Brief,
}

/// A receipt on its pins.
#[derive(Clone, Copy, Debug)]
pub struct Receipt;

impl Sheet {
    /// Both, in the order of the controls.
    pub const ALL: [Self; 2] = [Self::Paper, Self::Brief];

    /// Length of the brief's unit [m].
    pub fn unit(self) -> f32 {
        match self {
            Self::Brief => 1.0,
            Self::Paper => PAPER_UNIT,
        }
    }

    /// Particles across and down, for small screens or others.
    pub fn weave(self, small: bool) -> [u32; 2] {
        if small { SMALL } else { FULL }
    }

    /// From particle to particle, in units. The brief's sheet is smaller where it has fewer of them; paper
    /// stays as wide as it is.
    pub fn spacing(self, small: bool) -> f32 {
        match (self, small) {
            (Self::Paper, true) => SPACING * (FULL[0] - 1) as f32 / (SMALL[0] - 1) as f32,
            _ => SPACING,
        }
    }

    /// Width and height, in units.
    pub fn span(self, small: bool) -> Vec2 {
        Vec2::from(self.weave(small).map(|n| (n - 1) as f32)) * self.spacing(small)
    }

    /// The descriptor of a sheet that hangs around the origin by its two top corners.
    pub fn desc(self, small: bool) -> GridDesc {
        let [columns, rows] = self.weave(small);
        let span = self.span(small);
        let (material, settings) = match self {
            Self::Brief => (brief_material(), brief_settings()),
            Self::Paper => (paper_material(), paper_settings()),
        };
        GridDesc {
            columns,
            rows,
            spacing: self.spacing(small) * self.unit(),
            origin: Vec3::new(-0.5 * span.x, 0.5 * span.y, 0.0) * self.unit(),
            pin_mode: PinMode::TopCorners,
            material,
            settings,
            ..GridDesc::default()
        }
    }

    /// The floor under it.
    pub fn floor(self) -> ColliderDesc {
        let position = Vec3::Y * (FLOOR * self.unit());
        match self {
            Self::Brief => ColliderDesc {
                position,
                thickness: 0.0,
                friction: 0.0,
                restitution: 0.2,
                tangential_restitution: 0.8,
                ..ColliderDesc::default()
            },
            // Clear of it, as paper is that curls a little wherever it lies.
            Self::Paper => {
                ColliderDesc { position, thickness: 0.02 * self.unit(), ..ColliderDesc::default() }
            }
        }
    }

    /// The air around it: the brief's field of sines or a draught across the paper, or still air.
    pub fn wind(self, blows: bool) -> Wind {
        match self {
            Self::Brief => Wind {
                model: WindModel::SineField,
                velocity: if blows { Vec3::X * WIND } else { Vec3::ZERO },
                ..Wind::default()
            },
            Self::Paper => Wind {
                velocity: if blows { Vec3::new(0.5, 0.1, -1.0) * 1.6 } else { Vec3::ZERO },
                gust: 0.8,
                wander: 0.7,
                turbulence: 0.35,
                seed: 4,
                ..Wind::default()
            },
        }
    }

    /// A receipt over its floor, in still air.
    ///
    /// # Errors
    /// As [`Cloth::grid`]: none for the sheets' own descriptors.
    pub fn hang(self, small: bool) -> Result<Cloth> {
        let mut cloth = Cloth::grid(&self.desc(small))?;
        cloth.add_collider(&self.floor())?;
        cloth.set_wind(self.wind(false))?;
        self.finish(&mut cloth, small)?;
        Ok(cloth)
    }

    /// Gives a cloth that is as its descriptor made it what that cannot say: particles of the brief's sheet are
    /// equally heavy, and paper has the curl of the roll that it came off.
    ///
    /// # Errors
    /// As [`Cloth::set_mass_scales`] and [`Cloth::crease`].
    pub fn finish(self, cloth: &mut Cloth, small: bool) -> Result<()> {
        match self {
            Self::Brief => weigh_alike(cloth),
            Self::Paper => curl(cloth, &self.desc(small)),
        }
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Brief => Self::Paper,
            Self::Paper => Self::Brief,
        }
    }
}

/// Makes all particles as heavy as those amid the sheet.
fn weigh_alike(cloth: &mut Cloth) -> Result<()> {
    let all: Vec<u32> = (0..cloth.positions().len() as u32).collect();
    let masses: Vec<f32> = all.iter().filter_map(|particle| cloth.mass(*particle)).collect();
    let amid = masses.iter().copied().fold(0.0, f32::max);
    let scales: Vec<f32> = masses.into_iter().map(|mass| amid / mass).collect();
    cloth.set_mass_scales(&all, &scales)
}

/// Curls it forward, towards its end.
fn curl(cloth: &mut Cloth, desc: &GridDesc) -> Result<()> {
    let end = (desc.rows - 1) as f32;
    let across = Vec3::X * (desc.columns as f32 * desc.spacing);
    for row in 1..desc.rows - 1 {
        let share = row as f32 / end;
        let from = desc.origin - across * 0.1 - Vec3::Y * (row as f32 * desc.spacing);
        cloth.crease(from, from + across * 1.2, CURL * share * share / end)?;
    }
    Ok(())
}

/// Nothing but links between particles.
fn brief_material() -> Material {
    Material {
        stretch_stiffness_warp: 0.0,
        stretch_stiffness_weft: 0.0,
        shear_stiffness: 0.0,
        // Links over two cells, as rigid as the sweeps allow.
        bend_stiffness: 1.0,
        drag: 0.0,
        tear_stretch: 0.0,
        ..Material::default()
    }
}

fn brief_settings() -> Settings {
    Settings {
        tick: 1.0 / 120.0,
        substeps: 8,
        iterations: 6,
        gravity: Vec3::new(0.0, -9.81, 0.0),
        damping: -KEPT.ln() * SUBSTEPS_A_SECOND,
        max_displacement: 4.0,
        tethers: false,
        self_collision: SelfCollision::Particles,
        self_distance: 0.08,
        ..Settings::default()
    }
}

fn paper_material() -> Material {
    Material {
        // The lower end of what is measured of such paper.
        bend_stiffness: 2.7e-4,
        // What is folded and let go does not swing.
        bend_damping: 0.003,
        lift: 0.4,
        ..Material::preset(Preset::Paper)
    }
}

fn paper_settings() -> Settings {
    Settings {
        tick: 1.0 / 120.0,
        substeps: 10,
        iterations: 2,
        damping: 5.0,
        self_collision: SelfCollision::Surface,
        self_distance: GAP,
        ..Settings::default()
    }
}

/// Paper's particles are 5 mm apart: it is 195 mm wide and 295 mm long.
const PAPER_UNIT: f32 = 1.0 / 24.0;

/// What layers of paper keep from each other [m]: as if it were five sheets thick.
const GAP: f32 = 0.0005;

/// Three times what the sheet is turned by from its top to its end [rad].
const CURL: f32 = 2.4;

impl Scene for Receipt {
    const NAME: &'static str = "receipt";
    const ABOUT: &'static str = "Paper on two pins: it hangs almost flat and curls at its end.";

    fn build() -> Cast {
        match Sheet::Paper.hang(false) {
            Ok(cloth) => cloth.into(),
            Err(error) => unreachable!("the scene's own descriptor: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        let cloth = &cast.cloths[0];
        let unit = Sheet::Paper.unit();
        let [columns, _] = FULL;
        let x = cloth.positions();
        let half = Sheet::Paper.span(false) * 0.5;
        for (corner, side) in [(0, -1.0), (columns as usize - 1, 1.0)] {
            let off = x[corner].distance(Vec3::new(side * half.x, half.y, 0.0) * unit);
            if off > 1.0e-4 {
                return Err(format!("a corner is {off} m off its pin"));
            }
        }
        let lowest = x.iter().map(|at| at.y).fold(f32::MAX, f32::min) / unit;
        if !(-half.y - 0.1..-half.y + 1.0).contains(&lowest) {
            return Err(format!("it hangs down to {lowest} units"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.015 {
            return Err(format!("it is stretched by {stretch}"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::LinkKind;

    #[test]
    fn the_briefs_sheet_has_the_briefs_figures() {
        let desc = Sheet::Brief.desc(false);
        assert_eq!((desc.columns, desc.rows, desc.spacing), (40, 60, 0.12));
        assert_eq!(desc.pin_mode, PinMode::TopCorners);
        let small = Sheet::Brief.desc(true);
        assert_eq!((small.columns, small.rows, small.spacing), (24, 36, 0.12));
        let s = &desc.settings;
        assert_eq!((s.tick, s.substeps, s.iterations), (1.0 / 120.0, 8, 6));
        assert_eq!(s.gravity, Vec3::new(0.0, -9.81, 0.0));
        // 0.99 of the velocity is left after each substep.
        let left = (-s.damping * s.tick / s.substeps as f32).exp();
        assert!((left - 0.99).abs() < 1.0e-6, "{left} is left");
        assert_eq!((s.self_collision, s.self_distance), (SelfCollision::Particles, 0.08));
        assert!(!s.tethers && !s.tearing && s.max_stretch == 0.0);
        assert_eq!((desc.material.drag, desc.material.lift), (0.0, 0.0));
        let floor = Sheet::Brief.floor();
        assert_eq!(floor.position, Vec3::new(0.0, -4.0, 0.0));
        assert_eq!((floor.tangential_restitution, floor.restitution), (0.8, 0.2));
        assert_eq!((floor.friction, floor.thickness), (0.0, 0.0));
        let wind = Sheet::Brief.wind(true);
        assert_eq!((wind.model, wind.velocity.length()), (WindModel::SineField, 3.0));
        assert_eq!(Sheet::Brief.wind(false).velocity, Vec3::ZERO);
    }

    #[test]
    fn the_briefs_links_are_laid_as_it_lists_them() {
        let [columns, rows] = FULL;
        let cloth = Sheet::Brief.hang(false).unwrap();
        let mut counts = [0; 6];
        for (a, b, kind) in cloth.links() {
            let (a, b) = (a.min(b), a.max(b));
            let way = [b / columns - a / columns, (b % columns).abs_diff(a % columns)];
            let falls = b % columns > a % columns;
            let which = match (kind, way) {
                (LinkKind::Stretch, [0, 1]) => 0,
                (LinkKind::Stretch, [1, 0]) => 1,
                (LinkKind::Shear, [1, 1]) if falls => 2,
                (LinkKind::Shear, [1, 1]) => 3,
                (LinkKind::Bend, [0, 2]) => 4,
                (LinkKind::Bend, [2, 0]) => 5,
                other => panic!("the brief has no {other:?}"),
            };
            counts[which] += 1;
        }
        let (c, r) = (columns, rows);
        let cells = (c - 1) * (r - 1);
        assert_eq!(counts, [(c - 1) * r, c * (r - 1), cells, cells, (c - 2) * r, c * (r - 2)]);
    }

    #[test]
    fn all_particles_of_the_briefs_sheet_weigh_the_same() {
        for small in [false, true] {
            let cloth = Sheet::Brief.hang(small).unwrap();
            let [columns, rows] = Sheet::Brief.weave(small);
            let amid = cloth.mass(columns + 1).unwrap();
            for particle in 0..columns * rows {
                let mass = cloth.mass(particle).unwrap();
                assert!((mass / amid - 1.0).abs() < 1.0e-6, "{particle} weighs {mass} kg");
            }
        }
    }

    #[test]
    fn paper_weighs_80_grams_keeps_folds_and_is_as_large_as_a4() {
        let desc = Sheet::Paper.desc(false);
        let m = &desc.material;
        assert!(m.density == 0.08 && m.yield_angle > 0.0 && m.yield_creep > 0.0);
        for small in [false, true] {
            let size = Sheet::Paper.span(small) * Sheet::Paper.unit();
            assert!((size.x - 0.195).abs() < 1.0e-3, "it is {} m wide", size.x);
            assert!((size.y - 0.295).abs() < 0.011, "it is {} m high", size.y);
        }
    }

    #[test]
    fn the_sheets_hang_clear_of_the_floor() {
        for sheet in Sheet::ALL {
            for small in [false, true] {
                let mut cloth = sheet.hang(small).unwrap();
                cloth.step(240);
                let lowest = cloth.positions().iter().map(|at| at.y).fold(f32::MAX, f32::min);
                let over = lowest / sheet.unit() - FLOOR;
                assert!(over > 0.1, "{sheet:?} hangs {over} units over the floor");
            }
        }
    }
}
