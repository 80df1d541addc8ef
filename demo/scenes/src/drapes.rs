//! Scene: the drape test. Discs of three fabrics hang over pedestals side by side, as in a
//! drapemeter (Cusick 1965, BS 5058, ISO 9073-9): the softer the fabric, the smaller its shadow.

use crate::disc::Disc;
use crate::instance::SceneInstance;
use crate::scene::{FLOOR, Scene};
use crate::shadow::{self, Outline};
use glam::Vec3;
use muslin::{Cloth, ColliderDesc, Material, MeshDesc, Preset, Result, Settings, Shape};
use std::f32::consts::TAU;

/// Discs of silk, cotton and denim, each on its own pedestal.
#[derive(Clone, Copy, Debug)]
pub struct Drapes;

impl Drapes {
    /// Radius of a disc [m].
    pub const RADIUS: f32 = 0.15;
    /// Radius of a pedestal [m].
    pub const PEDESTAL: f32 = 0.09;
    /// Centres of the discs, at the top of the pedestals [m].
    pub const CENTRES: [Vec3; 3] = [
        Vec3::new(-0.36, Self::TOP, 0.0),
        Vec3::new(0.0, Self::TOP, 0.0),
        Vec3::new(0.36, Self::TOP, 0.0),
    ];
    /// Fabrics of the discs.
    pub const FABRICS: [Preset; 3] = [Preset::Silk, Preset::Cotton, Preset::Denim];
    /// Number of sides of the prism that is the collider of a pedestal.
    const SIDES: u32 = 24;
    /// Height of a pedestal [m].
    pub const HEIGHT: f32 = 0.33;
    /// Length that is drawn as one metre [m]. The discs have the size of a drapemeter, so they are
    /// drawn enlarged.
    pub const UNIT: f32 = 0.4;
    const TOP: f32 = FLOOR * Self::UNIT + Self::HEIGHT;

    /// Returns the descriptor of a flat disc around `centre` [m], with this many rings of
    /// particles.
    pub fn desc(rings: u32, centre: Vec3, material: Material) -> MeshDesc {
        let disc = Disc::new(Self::RADIUS, rings, 0.0);
        // Tiny height differences, as in any real fabric: a perfectly even disc has no centre to
        // start a fold.
        let uneven = |i: usize| 1.0e-4 * ((i as f32 * 2.399).sin() + 1.0);
        let positions = disc.positions.iter().enumerate();
        MeshDesc {
            positions: positions.map(|(i, x)| centre + *x + Vec3::Y * (uneven(i) + LIFT)).collect(),
            indices: disc.indices,
            uvs: disc.uvs,
            material,
            settings: Self::settings(),
            ..MeshDesc::default()
        }
    }

    /// Returns the settings. In a tick such a small cloth falls far relative to its edges, so it
    /// has twice the usual substeps.
    fn settings() -> Settings {
        Settings { damping: 1.5, substeps: 8, max_stretch: 0.03, ..Settings::default() }
    }

    /// Adds the pedestal under the disc around `centre` as a collider.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn add_pedestal(cloth: &mut Cloth, centre: Vec3) -> Result<()> {
        let corner = |i: u32| {
            let (z, x) = (TAU * i as f32 / Self::SIDES as f32).sin_cos();
            Vec3::new(x, 0.0, z) * Self::PEDESTAL
        };
        let corners = (0..Self::SIDES).map(corner);
        let positions = corners.flat_map(|x| [x, x - Vec3::Y * Self::HEIGHT]).collect();
        let pedestal = ColliderDesc {
            shape: Shape::Convex,
            position: centre,
            positions,
            friction: 0.6,
            ..ColliderDesc::default()
        };
        cloth.add_collider(&pedestal).map(|_| ())
    }

    /// Adds the floor that the pedestals stand on, `clearance` [m] higher than it is drawn.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn add_floor(cloth: &mut Cloth, clearance: f32) -> Result<()> {
        let position = Vec3::Y * (FLOOR + clearance) * Self::UNIT;
        cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).map(|_| ())
    }

    /// Returns the drape coefficient: the share of the ring around the pedestal that the disc
    /// shades, seen from above.
    pub fn drape_coefficient(cloth: &Cloth) -> f32 {
        shadow::drape_coefficient(cloth, Self::PEDESTAL, Self::RADIUS)
    }

    fn create_disc(preset: Preset, centre: Vec3) -> Result<Cloth> {
        let mut cloth = Cloth::mesh(&Self::desc(15, centre, Material::preset(preset)))?;
        Self::add_pedestal(&mut cloth, centre)?;
        Ok(cloth)
    }
}

/// Initial height of a disc above its pedestal [m].
const LIFT: f32 = 0.002;

impl Scene for Drapes {
    const NAME: &'static str = "disc on a pedestal in three fabrics";
    const ABOUT: &'static str = "Silk falls in many folds, cotton in a few, denim hardly bends.";

    fn build() -> SceneInstance {
        let discs = Self::FABRICS.iter().zip(Self::CENTRES);
        let cloths: Result<Vec<_>> =
            discs.map(|(preset, centre)| Self::create_disc(*preset, centre)).collect();
        match cloths {
            Ok(cloths) => cloths.into(),
            Err(error) => unreachable!("the descriptors of the scene are wrong: {error}"),
        }
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        for (cloth, (preset, centre)) in
            instance.cloths.iter().zip(Self::FABRICS.iter().zip(Self::CENTRES))
        {
            let depth = |x: &Vec3| {
                let x = *x - centre;
                let side_depth = Self::PEDESTAL * (TAU / Self::SIDES as f32 / 2.0).cos()
                    - x.with_y(0.0).length();
                side_depth.min(-x.y)
            };
            let deepest = cloth.positions().iter().map(depth).fold(f32::MIN, f32::max);
            if deepest > 0.5e-3 {
                return Err(format!("{preset:?} is {deepest} m inside its pedestal"));
            }
            let offset = (cloth.positions()[0] - centre).with_y(0.0).length();
            if offset > 0.01 {
                return Err(format!("{preset:?} slid {offset} m off its pedestal"));
            }
            let stretch = cloth.stats().max_stretch;
            if stretch > 0.05 {
                return Err(format!("the largest stretch of {preset:?} is {stretch}"));
            }
        }
        let coefficients: Vec<_> = instance.cloths.iter().map(Self::drape_coefficient).collect();
        if !coefficients.is_sorted_by(|soft, stiff| soft < stiff) {
            return Err(format!(
                "the drape coefficients of silk, cotton and denim do not increase: {coefficients:?}"
            ));
        }
        let folds = |cloth: &Cloth| Outline::from_cloth(cloth, Self::RADIUS).count_folds();
        let most_folds = instance.cloths.iter().map(folds).max().unwrap_or(0);
        if most_folds < 3 {
            return Err(format!("no disc has 3 folds: the most is {most_folds}"));
        }
        Ok(())
    }
}
