//! Muslin simulates cloth: it hangs, collides, blows in the wind, is grabbed, tears and is cut.
//!
//! A [`Cloth`] is one value. It is made from a grid ([`GridDesc`]) or from any triangle mesh
//! ([`MeshDesc`]), and it moves in fixed ticks. There is no world to set up and no callback to
//! write. The same calls give the same bits on every platform. Units are metres, kilograms, seconds
//! and radians; y is up by default.
//!
//! # Hang a sheet
//!
//! ```
//! use muslin::{Cloth, GridDesc, Material, PinMode, Preset};
//!
//! let mut cloth = Cloth::grid(&GridDesc {
//!     columns: 40,
//!     rows: 40,
//!     spacing: 0.05, // 1.95 m x 1.95 m
//!     pin_mode: PinMode::TopEdge,
//!     material: Material::preset(Preset::Cotton),
//!     ..GridDesc::default()
//! })?;
//! for _frame in 0..60 {
//!     cloth.advance(1.0 / 60.0)?; // the seconds since the last frame
//!     let view = cloth.view(); // positions, normals, uvs and indices, without a copy
//!     assert_eq!(view.positions.len(), 1600);
//! }
//! assert!(cloth.stats().max_stretch < 0.01);
//! # Ok::<(), muslin::Error>(())
//! ```
//!
//! # Tear it
//!
//! ```
//! use muslin::glam::Vec3;
//! use muslin::{Cloth, EventKind, GridDesc};
//!
//! let mut desc = GridDesc::default();
//! desc.settings.tearing = true;
//! desc.material.tear_stretch = 1.5;
//! let mut cloth = Cloth::grid(&desc)?;
//!
//! // A pointer grabs the particle that a ray hits, and pulls it 3.6 m towards the viewer.
//! let (eye, forward) = (Vec3::new(1.0, -1.0, 5.0), Vec3::NEG_Z);
//! let (grab, start) = cloth.grab_ray(eye, forward, 0.1)?.expect("the ray hits the sheet");
//! for frame in 0..120 {
//!     cloth.move_grab(grab, start + Vec3::Z * 0.03 * frame as f32)?;
//!     cloth.advance(1.0 / 60.0)?;
//! }
//! cloth.release(grab)?;
//!
//! let events = std::iter::from_fn(|| cloth.next_event());
//! assert!(events.filter(|event| event.kind == EventKind::EdgeTorn).count() > 0);
//! # Ok::<(), muslin::Error>(())
//! ```
//!
//! # Map of the types
//!
//! | task | types and calls |
//! | --- | --- |
//! | make a cloth | [`Cloth::grid`] with [`GridDesc`] and [`PinMode`]; [`Cloth::mesh`] with [`MeshDesc`], [`MeshReport`] |
//! | choose how it moves | [`Settings`], [`SelfCollision`], [`Material`], [`Preset`], [`Map`], [`Wind`], [`WindModel`] |
//! | run it | [`Cloth::advance`], [`Cloth::step`], [`Cloth::blend`]; [`Cloth::duplicate`], [`Cloth::advance_many`] |
//! | hold it | [`Cloth::pin`], [`Grab`], [`Attachment`], [`Cloth::set_max_distances`], [`Cloth::set_backstops`] |
//! | let it collide | [`ColliderDesc`], [`Shape`], [`Collider`], [`Impulse`] |
//! | tear, cut and fold it | [`Cloth::tear_edge`], [`Cloth::cut`], [`Cloth::crease`], [`Event`], [`EventKind`] |
//! | draw it | [`View`], [`Changes`]; [`Cloth::write_vertices`] with [`Stream`], [`Attribute`], [`VertexFormat`], [`WriteDesc`]; [`Cloth::write_indices`] with [`IndexFormat`] |
//! | draw a finer mesh that follows it | [`Skin`] with [`SkinDesc`] |
//! | pick and measure | [`Hit`], [`MassProperties`], [`Stats`], [`Stage`], [`LinkKind`], [`Clock`] |
//! | save and compare it | [`Cloth::save`], [`Cloth::restore`], [`Cloth::state_hash`] |
//! | handle errors | [`Error`], [`Result`] |
//!
//! # Features
//!
//! Seven parts can be left out to make programs smaller; by default all are there:
//!
//! | feature | without it |
//! | --- | --- |
//! | `self-collision` | [`SelfCollision::Surface`] is refused; [`SelfCollision::Particles`] works |
//! | `facet-colliders` | [`Shape::Convex`], [`Shape::Mesh`] and [`Shape::Heightfield`] are refused; `Cloth::update_collider` and `Cloth::collide_with` do not exist |
//! | `cut` | `Cloth::cut` does not exist; tears do |
//! | `save` | `Cloth::save` and `Cloth::restore` do not exist |
//! | `sewing` | `Cloth::sew`, `SewDesc` and `SewKind` do not exist |
//! | `shared-rest` | a clone has a copy of the rest shape from the start, which takes more memory |
//! | `skins` | `Skin` and `SkinDesc` do not exist |
//!
//! Refusals are [`Error::MissingFeature`]. A save that needs a missing part is refused too. What a
//! build has moves with the same bits as in a build with everything.
//!
//! - `parallel` (off by default) adds `Cloth::set_threads`: one large cloth uses several threads of
//!   [rayon](https://docs.rs/rayon), with the same bits; and `Cloth::advance_many` spreads the cloths
//!   over threads.
//!
//! Positions and directions are types of [`glam`], which is re-exported.

// Without a feature nothing calls the helpers that only its part needs.
#![cfg_attr(
    not(all(
        feature = "cut",
        feature = "facet-colliders",
        feature = "save",
        feature = "self-collision",
        feature = "sewing",
        feature = "shared-rest",
        feature = "skins"
    )),
    allow(dead_code, unused_imports)
)]

mod arena;
mod cloth;
mod error;
mod geometry;
mod math;
#[cfg(all(muslin_simd_limit, target_arch = "x86_64"))]
#[doc(hidden)]
pub use math::simd::best_level_name;
mod mesh;
mod model;
mod solver;
mod state;

pub use crate::cloth::Cloth;
pub use crate::cloth::changes::Changes;
pub use crate::cloth::desc::{AS_MANY_AGAIN, GridDesc, MeshDesc, PinMode};
pub use crate::cloth::mass_properties::MassProperties;
pub use crate::cloth::query::Hit;
#[cfg(feature = "skins")]
pub use crate::cloth::skin::Skin;
#[cfg(feature = "skins")]
pub use crate::cloth::skin::given_mesh::SkinDesc;
pub use crate::cloth::vertex_stream::{
    ALL_VERTICES, Attribute, MAX_STREAMS, Stream, VertexFormat, WriteDesc,
};
pub use crate::cloth::view::{Stats, View};
pub use crate::cloth::write_vertices::IndexFormat;
pub use crate::error::{Error, Result};
pub use crate::mesh::report::MeshReport;
pub use crate::model::links::LinkKind;
pub use crate::model::maps::Map;
pub use crate::model::material::{Material, Preset};
pub use crate::solver::profile::Clock;
pub use crate::solver::stage::Stage;
pub use crate::state::attachments::Attachment;
pub use crate::state::collider_desc::{ColliderDesc, Shape};
pub use crate::state::colliders::{Collider, Impulse};
pub use crate::state::events::{Event, EventKind};
pub use crate::state::grabs::Grab;
pub use crate::state::settings::{SelfCollision, Settings};
#[cfg(feature = "sewing")]
pub use crate::state::sewing::{SewDesc, SewKind};
pub use crate::state::wind::{Wind, WindModel};
pub use glam;

/// Runs the Rust examples of the documents as tests: one item for each page that has some.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../README.md")]
    struct ReadmePage;
    #[doc = include_str!("../docs/manual/concepts.md")]
    struct ConceptsPage;
    #[doc = include_str!("../docs/manual/settings.md")]
    struct SettingsPage;
    #[doc = include_str!("../docs/manual/materials.md")]
    struct MaterialsPage;
    #[doc = include_str!("../docs/manual/meshes.md")]
    struct MeshesPage;
    #[doc = include_str!("../docs/manual/tearing-and-cutting.md")]
    struct TearingAndCuttingPage;
    #[doc = include_str!("../docs/manual/skins.md")]
    struct SkinsPage;
    #[doc = include_str!("../docs/manual/sewing.md")]
    struct SewingPage;
    #[doc = include_str!("../docs/manual/self-collision.md")]
    struct SelfCollisionPage;
    #[doc = include_str!("../docs/manual/guarantees.md")]
    struct GuaranteesPage;
    #[doc = include_str!("../docs/manual/characters.md")]
    struct CharactersPage;
    #[doc = include_str!("../docs/manual/determinism.md")]
    struct DeterminismPage;
    #[doc = include_str!("../docs/manual/performance.md")]
    struct PerformancePage;
    #[doc = include_str!("../docs/manual/integration.md")]
    struct IntegrationPage;
    #[doc = include_str!("../docs/site/index.md")]
    struct SitePage;
}
