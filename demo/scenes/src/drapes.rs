//! Drapes: a disc on a pedestal, in three fabrics side by side. A drapemeter shows cloth so (Cusick 1965,
//! BS 5058, ISO 9073-9): the less of its shadow is left, the softer it hangs.

use crate::disc::Disc;
use crate::shadow::{self, Outline};
use crate::{Cast, FLOOR, Scene};
use glam::Vec3;
use muslin::{Cloth, ColliderDesc, Material, MeshDesc, Preset, Result, Settings, Shape};
use std::f32::consts::TAU;

/// Silk, cotton and denim, each as a disc on a pedestal of its own.
#[derive(Clone, Copy, Debug)]
pub struct Drapes;

impl Drapes {
    /// Radius of a disc [m].
    pub const RADIUS: f32 = 0.15;
    /// Radius of a pedestal [m].
    pub const PEDESTAL: f32 = 0.09;
    /// The middles of the discs, at the top of the pedestals [m].
    pub const PLACES: [Vec3; 3] = [
        Vec3::new(-0.36, Self::TOP, 0.0),
        Vec3::new(0.0, Self::TOP, 0.0),
        Vec3::new(0.36, Self::TOP, 0.0),
    ];
    /// What they are of.
    pub const FABRICS: [Preset; 3] = [Preset::Silk, Preset::Cotton, Preset::Denim];
    /// Sides of a pedestal, as the cloth feels it.
    const SIDES: u32 = 24;
    /// Height of a pedestal [m].
    pub const HEIGHT: f32 = 0.33;
    /// Discs are as large as on a drapemeter, so they are drawn larger: length of what is drawn as a metre [m].
    pub const UNIT: f32 = 0.4;
    const TOP: f32 = FLOOR * Self::UNIT + Self::HEIGHT;

    /// The descriptor of a flat disc at a place, with so many rings of particles around its middle.
    pub fn desc(rings: u32, place: Vec3, material: Material) -> MeshDesc {
        let disc = Disc::new(Self::RADIUS, rings, 0.0);
        // A weave is never quite even: without it, it could not choose where to fold.
        let uneven = |i: usize| 1.0e-4 * ((i as f32 * 2.399).sin() + 1.0);
        let positions = disc.positions.iter().enumerate();
        MeshDesc {
            positions: positions.map(|(i, x)| place + *x + Vec3::Y * (uneven(i) + LIFT)).collect(),
            indices: disc.indices,
            uvs: disc.uvs,
            material,
            settings: Self::settings(),
            ..MeshDesc::default()
        }
    }

    /// How its time runs. So small a cloth falls a long way in a sixtieth of a second, against its edges: twice the
    /// usual substeps carry it.
    fn settings() -> Settings {
        Settings { damping: 1.5, substeps: 8, max_stretch: 0.03, ..Settings::default() }
    }

    /// Puts the pedestal under the disc at a place.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn put_pedestal(cloth: &mut Cloth, place: Vec3) -> Result<()> {
        let corner = |i: u32| {
            let (z, x) = (TAU * i as f32 / Self::SIDES as f32).sin_cos();
            Vec3::new(x, 0.0, z) * Self::PEDESTAL
        };
        let corners = (0..Self::SIDES).map(corner);
        let positions = corners.flat_map(|x| [x, x - Vec3::Y * Self::HEIGHT]).collect();
        let pedestal = ColliderDesc {
            shape: Shape::Convex,
            position: place,
            positions,
            friction: 0.6,
            ..ColliderDesc::default()
        };
        cloth.add_collider(&pedestal).map(|_| ())
    }

    /// Lays the floor that pedestals stand on, so much higher than it is drawn [m].
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn put_floor(cloth: &mut Cloth, clearance: f32) -> Result<()> {
        let position = Vec3::Y * (FLOOR + clearance) * Self::UNIT;
        cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).map(|_| ())
    }

    /// The share of the ring around the pedestal that the disc shades, seen from above: its drape coefficient.
    pub fn coefficient(cloth: &Cloth) -> f32 {
        shadow::drape_coefficient(cloth, Self::PEDESTAL, Self::RADIUS)
    }

    fn disc(preset: Preset, place: Vec3) -> Result<Cloth> {
        let mut cloth = Cloth::mesh(&Self::desc(15, place, Material::preset(preset)))?;
        Self::put_pedestal(&mut cloth, place)?;
        Ok(cloth)
    }
}

/// How far over its pedestal a disc starts [m].
const LIFT: f32 = 0.002;

impl Scene for Drapes {
    const NAME: &'static str = "disc on a pedestal in three fabrics";
    const ABOUT: &'static str = "Silk falls in many folds, cotton in a few, denim hardly bends.";

    fn build() -> Cast {
        let discs = Self::FABRICS.iter().zip(Self::PLACES);
        let made: Result<Vec<_>> = discs.map(|(preset, at)| Self::disc(*preset, at)).collect();
        match made {
            Ok(cloths) => cloths.into(),
            Err(error) => unreachable!("the scene's own descriptors: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        for (cloth, (preset, place)) in
            cast.cloths.iter().zip(Self::FABRICS.iter().zip(Self::PLACES))
        {
            let inside = |x: &Vec3| {
                let x = *x - place;
                let aside = Self::PEDESTAL * (TAU / Self::SIDES as f32 / 2.0).cos()
                    - x.with_y(0.0).length();
                aside.min(-x.y)
            };
            let deepest = cloth.positions().iter().map(inside).fold(f32::MIN, f32::max);
            if deepest > 0.5e-3 {
                return Err(format!("{preset:?} is {deepest} m inside its pedestal"));
            }
            let aside = (cloth.positions()[0] - place).with_y(0.0).length();
            if aside > 0.01 {
                return Err(format!("{preset:?} slips off its pedestal: by {aside} m"));
            }
            let stretch = cloth.stats().max_stretch;
            if stretch > 0.05 {
                return Err(format!("{preset:?} is stretched by {stretch}"));
            }
        }
        let drapes: Vec<_> = cast.cloths.iter().map(Self::coefficient).collect();
        if !drapes.is_sorted_by(|soft, stiff| soft < stiff) {
            return Err(format!("silk, cotton and denim drape out of order: {drapes:?}"));
        }
        let folds = |cloth: &Cloth| Outline::of(cloth, Self::RADIUS).folds();
        let folded = cast.cloths.iter().map(folds).max().unwrap_or(0);
        if folded < 3 {
            return Err(format!("they hang without folds: {folded}"));
        }
        Ok(())
    }
}
