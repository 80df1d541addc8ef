//! Scene: a receipt, a narrow sheet that hangs from two pins above a floor, to fold, crumple and
//! toss.
//!
//! There are two sheets of the same shape. [`Sheet::Brief`] has exactly the numbers of the written
//! brief for this scene and is about five metres wide. [`Sheet::Paper`] is real paper about as
//! large as A4, and is drawn as large as the other. Lengths are given in units of the brief;
//! [`Sheet::unit`] is the length of a unit in metres.

use crate::instance::SceneInstance;
use crate::scene::{Scene, built};
use glam::{Vec2, Vec3};
use muslin::{
    Cloth, ColliderDesc, GridDesc, Material, PinMode, Preset, Result, SelfCollision, Settings,
    Wind, WindModel,
};

/// Columns and rows of the grid.
pub const FULL: [u32; 2] = [40, 60];
/// Columns and rows on small or touch screens, and for users who prefer reduced motion.
pub const SMALL: [u32; 2] = [24, 36];
/// Distance between neighbouring particles [units].
pub const SPACING: f32 = 0.12;
/// Height of the floor [units].
pub const FLOOR: f32 = -4.0;
/// Strength of the wind of the brief [m/s²].
pub const WIND: f32 = 3.0;

/// Substeps per second: 120 ticks of 8 substeps.
const SUBSTEPS_PER_SECOND: f32 = 960.0;
/// Share of the velocity that remains after each substep of the brief.
const VELOCITY_FACTOR: f32 = 0.99;

/// The kind of sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sheet {
    /// Paper of 80 g/m², which hardly stretches and keeps its folds.
    #[default]
    Paper,
    /// The links of the brief.
    Brief,
}

/// The scene of the paper receipt.
#[derive(Clone, Copy, Debug)]
pub struct Receipt;

impl Sheet {
    /// Both sheets, in the order of the controls.
    pub const ALL: [Self; 2] = [Self::Paper, Self::Brief];

    /// Returns the length of a unit [m].
    pub fn unit(self) -> f32 {
        match self {
            Self::Brief => 1.0,
            Self::Paper => PAPER_UNIT,
        }
    }

    /// Returns columns and rows of the grid, for small screens or others.
    pub fn grid_size(self, small: bool) -> [u32; 2] {
        if small { SMALL } else { FULL }
    }

    /// Returns the distance between neighbouring particles [units]. On small screens the sheet of
    /// the brief is smaller; paper keeps its size and has larger cells.
    pub fn spacing(self, small: bool) -> f32 {
        match (self, small) {
            (Self::Paper, true) => SPACING * (FULL[0] - 1) as f32 / (SMALL[0] - 1) as f32,
            _ => SPACING,
        }
    }

    /// Returns width and height [units].
    pub fn span(self, small: bool) -> Vec2 {
        Vec2::from(self.grid_size(small).map(|n| (n - 1) as f32)) * self.spacing(small)
    }

    /// Returns the descriptor of a sheet that is centred at the origin and pinned at its top
    /// corners.
    pub fn desc(self, small: bool) -> GridDesc {
        let [columns, rows] = self.grid_size(small);
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

    /// Returns the collider of the floor.
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
            // The gap of paper that curls a little where it lies.
            Self::Paper => {
                ColliderDesc { position, thickness: 0.02 * self.unit(), ..ColliderDesc::default() }
            }
        }
    }

    /// Returns the wind: the sine field of the brief, or a draught across the paper; still air if
    /// it is off.
    pub fn wind(self, is_on: bool) -> Wind {
        match self {
            Self::Brief => Wind {
                model: WindModel::SineField,
                velocity: if is_on { Vec3::X * WIND } else { Vec3::ZERO },
                ..Wind::default()
            },
            Self::Paper => Wind {
                velocity: if is_on { Vec3::new(0.5, 0.1, -1.0) * 1.6 } else { Vec3::ZERO },
                gust: 0.8,
                wander: 0.7,
                turbulence: 0.35,
                seed: 4,
                ..Wind::default()
            },
        }
    }

    /// Creates the receipt above its floor, in still air.
    ///
    /// # Errors
    /// As [`Cloth::grid`]; the descriptors of this file cause none.
    pub fn hang(self, small: bool) -> Result<Cloth> {
        let mut cloth = Cloth::grid(&self.desc(small))?;
        cloth.add_collider(&self.floor())?;
        cloth.set_wind(self.wind(false))?;
        self.apply_initial_state(&mut cloth, small)?;
        Ok(cloth)
    }

    /// Applies what a descriptor cannot state to a new or reset cloth: equal masses for the sheet
    /// of the brief, and for paper the curl of the roll that it came from.
    ///
    /// # Errors
    /// As [`Cloth::set_mass_scales`] and [`Cloth::crease`].
    pub fn apply_initial_state(self, cloth: &mut Cloth, small: bool) -> Result<()> {
        match self {
            Self::Brief => equalize_masses(cloth),
            Self::Paper => apply_curl(cloth, &self.desc(small)),
        }
    }

    /// Returns the other sheet.
    pub fn other(self) -> Self {
        match self {
            Self::Brief => Self::Paper,
            Self::Paper => Self::Brief,
        }
    }
}

/// Gives every particle the mass of a particle in the interior.
fn equalize_masses(cloth: &mut Cloth) -> Result<()> {
    let all: Vec<u32> = (0..cloth.positions().len() as u32).collect();
    let masses: Vec<f32> = all.iter().filter_map(|particle| cloth.mass(*particle)).collect();
    let interior = masses.iter().copied().fold(0.0, f32::max);
    let scales: Vec<f32> = masses.into_iter().map(|mass| interior / mass).collect();
    cloth.set_mass_scales(&all, &scales)
}

/// Curls the sheet to the front, increasingly towards its lower end.
fn apply_curl(cloth: &mut Cloth, desc: &GridDesc) -> Result<()> {
    let end = (desc.rows - 1) as f32;
    let across = Vec3::X * (desc.columns as f32 * desc.spacing);
    for row in 1..desc.rows - 1 {
        let share = row as f32 / end;
        let from = desc.origin - across * 0.1 - Vec3::Y * (row as f32 * desc.spacing);
        cloth.crease(from, from + across * 1.2, CURL * share * share / end)?;
    }
    Ok(())
}

/// Returns a material of rigid links only.
fn brief_material() -> Material {
    Material {
        stretch_stiffness_warp: 0.0,
        stretch_stiffness_weft: 0.0,
        shear_stiffness: 0.0,
        // From 1 on: links over two cells, as rigid as the number of sweeps allows.
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
        damping: -VELOCITY_FACTOR.ln() * SUBSTEPS_PER_SECOND,
        max_displacement: 4.0,
        tethers: false,
        self_collision: SelfCollision::Particles,
        self_distance: 0.08,
        ..Settings::default()
    }
}

fn paper_material() -> Material {
    Material {
        // The lower end of the measured range for this paper.
        bend_stiffness: 2.7e-4,
        // Damps the swing of a fold that is released.
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
        self_distance: SELF_DISTANCE,
        ..Settings::default()
    }
}

/// Length of a unit of paper [m]: particles are 5 mm apart, and the sheet is 195 mm by 295 mm.
const PAPER_UNIT: f32 = 1.0 / 24.0;

/// Distance between layers of paper [m], five times the thickness of paper.
const SELF_DISTANCE: f32 = 0.0005;

/// Strength of the curl [rad]: three times the angle between the top and the lower end.
const CURL: f32 = 2.4;

impl Scene for Receipt {
    const NAME: &'static str = "receipt";
    const ABOUT: &'static str = "Paper on two pins: it hangs almost flat, and its lower end curls.";

    fn build() -> SceneInstance {
        built(Sheet::Paper.hang(false))
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
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
        let lowest = x.iter().map(|x| x.y).fold(f32::MAX, f32::min) / unit;
        if !(-half.y - 0.1..-half.y + 1.0).contains(&lowest) {
            return Err(format!("the lowest point is at {lowest} units"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.015 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::LinkKind;

    #[test]
    fn the_sheet_of_the_brief_has_the_numbers_of_the_brief() {
        let desc = Sheet::Brief.desc(false);
        assert_eq!((desc.columns, desc.rows, desc.spacing), (40, 60, 0.12));
        assert_eq!(desc.pin_mode, PinMode::TopCorners);
        let small = Sheet::Brief.desc(true);
        assert_eq!((small.columns, small.rows, small.spacing), (24, 36, 0.12));
        let s = &desc.settings;
        assert_eq!((s.tick, s.substeps, s.iterations), (1.0 / 120.0, 8, 6));
        assert_eq!(s.gravity, Vec3::new(0.0, -9.81, 0.0));
        // 0.99 of the velocity remains after each substep.
        let remaining = (-s.damping * s.tick / s.substeps as f32).exp();
        assert!((remaining - 0.99).abs() < 1.0e-6, "{remaining} remains");
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
    fn the_sheet_of_the_brief_has_the_links_of_the_brief() {
        let [columns, rows] = FULL;
        let cloth = Sheet::Brief.hang(false).unwrap();
        let mut counts = [0; 6];
        for (a, b, kind) in cloth.links() {
            let (a, b) = (a.min(b), a.max(b));
            let offset = [b / columns - a / columns, (b % columns).abs_diff(a % columns)];
            let is_falling = b % columns > a % columns;
            let index = match (kind, offset) {
                (LinkKind::Stretch, [0, 1]) => 0,
                (LinkKind::Stretch, [1, 0]) => 1,
                (LinkKind::Shear, [1, 1]) if is_falling => 2,
                (LinkKind::Shear, [1, 1]) => 3,
                (LinkKind::Bend, [0, 2]) => 4,
                (LinkKind::Bend, [2, 0]) => 5,
                other => panic!("the brief has no link {other:?}"),
            };
            counts[index] += 1;
        }
        let (c, r) = (columns, rows);
        let cells = (c - 1) * (r - 1);
        assert_eq!(counts, [(c - 1) * r, c * (r - 1), cells, cells, (c - 2) * r, c * (r - 2)]);
    }

    #[test]
    fn all_particles_of_the_sheet_of_the_brief_have_equal_mass() {
        for small in [false, true] {
            let cloth = Sheet::Brief.hang(small).unwrap();
            let [columns, rows] = Sheet::Brief.grid_size(small);
            let interior = cloth.mass(columns + 1).unwrap();
            for particle in 0..columns * rows {
                let mass = cloth.mass(particle).unwrap();
                assert!(
                    (mass / interior - 1.0).abs() < 1.0e-6,
                    "particle {particle} has {mass} kg"
                );
            }
        }
    }

    #[test]
    fn paper_has_80_grams_per_square_metre_keeps_folds_and_has_about_the_size_of_a4() {
        let desc = Sheet::Paper.desc(false);
        let m = &desc.material;
        assert!(m.density == 0.08 && m.yield_angle > 0.0 && m.yield_creep > 0.0);
        for small in [false, true] {
            let size = Sheet::Paper.span(small) * Sheet::Paper.unit();
            assert!((size.x - 0.195).abs() < 1.0e-3, "the width is {} m", size.x);
            assert!((size.y - 0.295).abs() < 0.011, "the height is {} m", size.y);
        }
    }

    #[test]
    fn the_sheets_hang_above_the_floor() {
        for sheet in Sheet::ALL {
            for small in [false, true] {
                let mut cloth = sheet.hang(small).unwrap();
                cloth.step(240);
                let lowest = cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
                let height = lowest / sheet.unit() - FLOOR;
                assert!(height > 0.1, "{sheet:?} hangs {height} units above the floor");
            }
        }
    }
}
