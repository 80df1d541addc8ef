//! Links: what joins which particles, at what length, how stiffly.
//!
//! A link is anchored to corners of triangles, not to particles: when a vertex splits, the link
//! follows the triangle that it lies on, and one whose triangles have parted is gone.

use crate::math::column::Column;
use crate::mesh::{Corner, Mesh, NONE, next_corner};
use crate::model::link_ends::LinkEnds;
use crate::model::material::Material;
use serde::{Deserialize, Serialize};

/// What a link resists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u32)]
pub enum LinkKind {
    /// Structural: between neighbours along the threads, or along the edges of a free mesh.
    Stretch = 0,
    /// Between diagonal neighbours of a grid.
    Shear = 1,
    /// Between particles two cells apart, or across the edge of a free mesh.
    Bend = 2,
}

/// Which of the material's two stretch stiffnesses holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum ThreadDirection {
    Weft,
    Warp,
}

/// What a link lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum LinkSupport {
    /// An edge of a triangle: for ever.
    Edge,
    /// The edge, starting at this corner, across which it reaches: until that opens.
    AcrossEdge(Corner),
    /// Two edges in a row: until these two corners are no longer the same vertex.
    TwoEdges([Corner; 2]),
    /// Nothing any more: a cut divided what it lay on, and other links have taken its place.
    Removed,
}

/// What stays of a link when its particles change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LinkSpec {
    pub kind: LinkKind,
    pub direction: ThreadDirection,
    pub ends: [Corner; 2],
    pub support: LinkSupport,
    /// Spring constant over material stiffness: 1 for a stretch link inside a grid.
    pub stiffness_scale: f32,
}

impl LinkSpec {
    /// The corners that it depends on, some of them named more than once.
    pub fn dependent_corners(&self) -> [Corner; 4] {
        let [a, b] = self.ends;
        match self.support {
            LinkSupport::Edge | LinkSupport::Removed => [a, b, a, a],
            LinkSupport::AcrossEdge(edge) => [a, b, edge, next_corner(edge)],
            LinkSupport::TwoEdges([left, right]) => [a, b, left, right],
        }
    }
}

/// Links as columns, one entry a link.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    pub a: LinkEnds,
    pub b: LinkEnds,
    /// Length at rest [m].
    pub rest: Column,
    /// Inverse spring constant [m/N]; 0 is rigid.
    pub compliance: Column,
    /// Accumulated multiplier of this substep.
    pub lambda: Column,
    /// False once torn.
    pub active: Vec<bool>,
    pub spec: Vec<LinkSpec>,
}

impl Links {
    pub fn len(&self) -> usize {
        self.rest.len()
    }

    pub fn kind(&self, link: usize) -> LinkKind {
        self.spec[link].kind
    }

    pub fn reserve(&mut self, capacity: usize) {
        let in_all = self.len() + capacity;
        self.a.reserve(capacity);
        self.b.reserve(capacity);
        self.rest.reserve(in_all);
        self.compliance.reserve(in_all);
        self.lambda.reserve(in_all);
        self.active.reserve_exact(capacity);
        self.spec.reserve_exact(capacity);
    }

    pub fn push(&mut self, mesh: &Mesh, spec: LinkSpec, rest: f32) {
        self.a.push(mesh.vertex(spec.ends[0]));
        self.b.push(mesh.vertex(spec.ends[1]));
        self.rest.push(rest);
        self.compliance.push(0.0);
        self.lambda.push(0.0);
        self.active.push(true);
        self.spec.push(spec);
    }

    /// Follows the mesh after a split.
    pub fn update(&mut self, mesh: &Mesh, link: usize) {
        let spec = &self.spec[link];
        // One that is gone keeps its particles, which no other link of its colour has.
        if spec.support == LinkSupport::Removed {
            self.active[link] = false;
            return;
        }
        self.a.set(link, mesh.vertex(spec.ends[0]));
        self.b.set(link, mesh.vertex(spec.ends[1]));
        self.active[link] = match spec.support {
            LinkSupport::Edge => true,
            LinkSupport::AcrossEdge(edge) => mesh.across(edge) != NONE,
            LinkSupport::TwoEdges([left, right]) => mesh.vertex(left) == mesh.vertex(right),
            LinkSupport::Removed => false,
        };
    }

    /// Takes on a material's stiffness.
    pub fn update_compliance(&mut self, link: usize, material: &Material) {
        let spec = &self.spec[link];
        self.compliance[link] = compliance(spec, material);
    }
}

/// Links of one kind and colour, next to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LinkBatch {
    pub kind: LinkKind,
    pub first: usize,
    pub count: usize,
}

fn compliance(spec: &LinkSpec, material: &Material) -> f32 {
    let (weft, warp) = (material.stretch_stiffness_weft, material.stretch_stiffness_warp);
    let stiffness = match (spec.kind, spec.direction) {
        (LinkKind::Stretch, ThreadDirection::Weft) => weft,
        (LinkKind::Stretch, ThreadDirection::Warp) => warp,
        (LinkKind::Shear, _) if material.shear_stiffness > 0.0 => material.shear_stiffness,
        (LinkKind::Shear, _) => 0.5 * (weft + warp),
        (LinkKind::Bend, _) if material.bend_stiffness >= 1.0 => 0.0,
        (LinkKind::Bend, _) => material.bend_stiffness,
    };
    let spring = stiffness * spec.stiffness_scale;
    if spring > 0.0 { 1.0 / spring } else { 0.0 }
}
