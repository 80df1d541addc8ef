//! Scratch buffers and cached factorisations of stage `Bend`.
//!
//! Data only. A grid uses the plate buffers, any other mesh the hinge buffers; the other buffers
//! stay empty. `bend` and its solvers fill them; nothing in them is state, so a tick gives the same
//! result whether or not a cache is still valid.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::model::plate_elements::{PerKind, PlateElements};
use crate::solver::bend::mesh_implicit::MeshBendScratch;
use crate::solver::bend::plate::PlateScratch;
use glam::Vec3;

/// Buffers of stage `Bend`, kept so that no tick allocates.
#[derive(Clone, Debug, Default)]
pub(crate) struct BendScratch {
    pub plates: PlateScratch,
    /// Unit normals of a grid at its particles; empty until there may be folds.
    pub normal: Columns,
    /// Unit direction in which each plate element is curved at rest, per element kind; empty until
    /// there may be folds.
    pub rest_direction: PerKind<Columns>,
    pub mesh: MeshBendScratch,
    /// Multiplier of each dynamic link that is a hinge [kg m].
    pub hinge_lambda: Vec<Vec3>,
}

heap_bytes!(BendScratch { plates, normal, rest_direction, mesh, hinge_lambda } plain {});

impl BendScratch {
    /// Allocates the buffers of a grid with these `plates`, or of a mesh with these numbers of
    /// `triangles` and `hinges` and at most `capacity` particles.
    pub fn new(
        plates: Option<&PlateElements>,
        triangles: usize,
        hinges: usize,
        capacity: usize,
    ) -> Self {
        Self {
            plates: plates.map(PlateScratch::new).unwrap_or_default(),
            normal: Columns::default(),
            rest_direction: PerKind::default(),
            mesh: if plates.is_some() {
                MeshBendScratch::default()
            } else {
                MeshBendScratch::new(triangles, hinges, capacity)
            },
            hinge_lambda: Vec::new(),
        }
    }

    /// Allocates what folds of a grid of `count` particles need.
    pub fn reserve_folds(&mut self, count: usize) {
        self.normal.resize(count);
        self.rest_direction.iter_mut().for_each(|direction| direction.resize(count));
    }
}
