//! Links: what joins which particles, at what length, how stiffly.
//!
//! A link is anchored to corners of triangles, not to particles: when a vertex splits, the link
//! follows the triangle that it lies on, and one whose triangles have parted is gone.

use crate::math::column::Column;
use crate::mesh::{Corner, Mesh, NONE, after};
use crate::model::link_ends::Ends;
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
pub(crate) enum Thread {
    Weft,
    Warp,
}

/// What a link lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Support {
    /// An edge of a triangle: for ever.
    Edge,
    /// The edge, starting at this corner, across which it reaches: until that opens.
    Flap(Corner),
    /// Two edges in a row: until these two corners are no longer the same vertex.
    Pair([Corner; 2]),
    /// Nothing any more: a cut divided what it lay on, and other links have taken its place.
    Gone,
}

/// What stays of a link when its particles change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Spec {
    pub kind: LinkKind,
    pub thread: Thread,
    pub anchors: [Corner; 2],
    pub support: Support,
    /// Spring constant over material stiffness: 1 for a stretch link inside a grid.
    pub shape: f32,
}

impl Spec {
    /// The corners that it depends on, some of them named more than once.
    pub fn corners(&self) -> [Corner; 4] {
        let [a, b] = self.anchors;
        match self.support {
            Support::Edge | Support::Gone => [a, b, a, a],
            Support::Flap(edge) => [a, b, edge, after(edge)],
            Support::Pair([left, right]) => [a, b, left, right],
        }
    }
}

/// Links as columns, one entry a link.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    pub a: Ends,
    pub b: Ends,
    /// Length at rest [m].
    pub rest: Column,
    /// Inverse spring constant [m/N]; 0 is rigid.
    pub compliance: Column,
    /// Accumulated multiplier of this substep.
    pub lambda: Column,
    /// False once torn.
    pub active: Vec<bool>,
    pub spec: Vec<Spec>,
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

    pub fn push(&mut self, mesh: &Mesh, spec: Spec, rest: f32) {
        self.a.push(mesh.vertex(spec.anchors[0]));
        self.b.push(mesh.vertex(spec.anchors[1]));
        self.rest.push(rest);
        self.compliance.push(0.0);
        self.lambda.push(0.0);
        self.active.push(true);
        self.spec.push(spec);
    }

    /// Follows the mesh after a split.
    pub fn follow(&mut self, mesh: &Mesh, link: usize) {
        let spec = &self.spec[link];
        // One that is gone keeps its particles, which no other link of its colour has.
        if spec.support == Support::Gone {
            self.active[link] = false;
            return;
        }
        self.a.set(link, mesh.vertex(spec.anchors[0]));
        self.b.set(link, mesh.vertex(spec.anchors[1]));
        self.active[link] = match spec.support {
            Support::Edge => true,
            Support::Flap(edge) => mesh.across(edge) != NONE,
            Support::Pair([left, right]) => mesh.vertex(left) == mesh.vertex(right),
            Support::Gone => false,
        };
    }

    /// Takes on a material's stiffness.
    pub fn stiffen(&mut self, link: usize, material: &Material) {
        let spec = &self.spec[link];
        self.compliance[link] = compliance(spec, material);
    }
}

/// Links of one kind and colour, next to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Batch {
    pub kind: LinkKind,
    pub first: usize,
    pub count: usize,
}

fn compliance(spec: &Spec, material: &Material) -> f32 {
    let (weft, warp) = (material.stretch_stiffness_weft, material.stretch_stiffness_warp);
    let stiffness = match (spec.kind, spec.thread) {
        (LinkKind::Stretch, Thread::Weft) => weft,
        (LinkKind::Stretch, Thread::Warp) => warp,
        (LinkKind::Shear, _) if material.shear_stiffness > 0.0 => material.shear_stiffness,
        (LinkKind::Shear, _) => 0.5 * (weft + warp),
        (LinkKind::Bend, _) if material.bend_stiffness >= 1.0 => 0.0,
        (LinkKind::Bend, _) => material.bend_stiffness,
    };
    let spring = stiffness * spec.shape;
    if spring > 0.0 { 1.0 / spring } else { 0.0 }
}
