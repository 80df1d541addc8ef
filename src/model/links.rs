//! Links: distance constraints between two particles.
//!
//! ```text
//! a ●───── rest ─────● b      E = ½ (|b − a| − rest)² / compliance
//! ```
//! Compliance is the inverse spring constant (XPBD; Macklin et al., MIG 2016). A link is defined by
//! corners of triangles, not by particles: when a vertex splits, the link follows the triangles
//! that it lies on, and is deactivated when they have separated.
//!
//! Reads `Mesh`, `Material` and `Maps`; writes columns, one entry per link.
//!
//! Invariant: `spec` alone determines `a`, `b` and `active` on a given mesh.

use crate::math::column::Column;
use crate::math::heap_bytes::heap_bytes;
use crate::math::min;
use crate::math::shared::Shared;
use crate::mesh::{Corner, Mesh, NONE, next_corner};
use crate::model::link_ends::LinkEnds;
use crate::model::maps::{Map, Maps};
use crate::model::material::Material;
use serde::{Deserialize, Serialize};

/// What a link resists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u32)]
pub enum LinkKind {
    /// Stretch: between neighbours along the threads of a grid, or along the edges of another mesh.
    Stretch = 0,
    /// Shear: between diagonal neighbours of a grid.
    Shear = 1,
    /// Bending: between particles two cells apart on a grid, or between the two vertices opposite
    /// an edge of another mesh.
    Bend = 2,
}

/// Thread direction of a link: selects the stiffness of the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum ThreadDirection {
    Weft,
    Warp,
}

/// What a link lies on, which decides how long it exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum LinkSupport {
    /// An edge of a triangle: the link is always active.
    Edge,
    /// Across the edge that starts at this corner: active until the edge opens.
    AcrossEdge(Corner),
    /// Along two consecutive edges: active while these two corners are the same vertex.
    TwoEdges([Corner; 2]),
    /// Removed by a cut; other links have replaced it.
    Removed,
}

/// Definition of a link, independent of vertex splits. Field order is part of the save format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LinkSpec {
    /// What the link resists.
    pub kind: LinkKind,
    /// Thread direction of the link.
    pub direction: ThreadDirection,
    /// Corners at its two ends.
    pub ends: [Corner; 2],
    /// What it lies on.
    pub support: LinkSupport,
    /// Spring constant relative to the stiffness of the material; 1 for a stretch link inside a
    /// grid.
    pub stiffness_scale: f32,
}

impl LinkSpec {
    /// The corners that the link depends on; some may be repeated.
    pub fn dependent_corners(&self) -> [Corner; 4] {
        let [a, b] = self.ends;
        match self.support {
            LinkSupport::Edge | LinkSupport::Removed => [a, b, a, a],
            LinkSupport::AcrossEdge(edge) => [a, b, edge, next_corner(edge)],
            LinkSupport::TwoEdges([left, right]) => [a, b, left, right],
        }
    }
}

/// Links as columns, one entry per link.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    /// Particles at the two ends.
    pub a: LinkEnds,
    pub b: LinkEnds,
    /// Rest length [m].
    pub rest: Shared<Column>,
    /// Inverse spring constant [m/N]; 0 is rigid.
    pub compliance: Shared<Column>,
    /// Whether the link acts; false once its support is gone.
    pub active: Vec<bool>,
    /// Definition.
    pub spec: Shared<Vec<LinkSpec>>,
}

heap_bytes!(Links { a, b, rest, compliance, active, spec } plain {});

/// What compliant links read and write in a substep.
#[derive(Debug)]
pub(crate) struct SoftLinks<'a> {
    /// Inverse spring constants [m/N].
    pub compliance: &'a [f32],
    /// Lagrange multipliers accumulated in this substep.
    pub lambda: &'a mut [f32],
}

impl Links {
    pub fn len(&self) -> usize {
        self.rest.len()
    }

    /// Makes all that damping changes unique.
    pub fn make_lengths_unique(&mut self) {
        self.rest.make_unique();
        self.compliance.make_unique();
    }

    /// Makes all that tears change unique.
    pub fn make_unique(&mut self) {
        self.make_lengths_unique();
        self.a.make_unique();
        self.b.make_unique();
        self.spec.make_unique();
    }

    pub fn kind(&self, link: usize) -> LinkKind {
        self.spec[link].kind
    }

    /// Number of links for which there is memory.
    pub fn capacity(&self) -> usize {
        self.spec.capacity()
    }

    /// Allocates for `capacity` more links.
    pub fn reserve(&mut self, capacity: usize) {
        let in_all = self.len() + capacity;
        self.a.reserve(capacity);
        self.b.reserve(capacity);
        self.rest.reserve(in_all);
        self.compliance.reserve(in_all);
        self.active.reserve_exact(capacity);
        self.spec.reserve_exact(capacity);
    }

    /// Appends a link of rest length `rest` [m]. Its compliance is 0 until `update_compliance`.
    pub fn push(&mut self, mesh: &Mesh, spec: LinkSpec, rest: f32) {
        self.a.push(mesh.vertex(spec.ends[0]));
        self.b.push(mesh.vertex(spec.ends[1]));
        self.rest.push(rest);
        self.compliance.push(0.0);
        self.active.push(true);
        self.spec.push(spec);
    }

    /// Updates the particles and the activity of a link after the mesh changed.
    pub fn update(&mut self, mesh: &Mesh, link: usize) {
        let spec = &self.spec[link];
        // A removed link keeps its particles, which no other link of its colour has.
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

    /// Computes the compliance of a link from the material and its painted stretch.
    pub fn update_compliance(&mut self, link: usize, material: &Material, maps: &Maps) {
        let spec = &self.spec[link];
        let compliance = compliance(spec, material);
        let compliance = if spec.kind == LinkKind::Bend || compliance == 0.0 {
            compliance
        } else {
            painted_compliance(compliance, maps.mean(Map::Stretch, &[self.a[link], self.b[link]]))
        };
        if self.compliance[link] != compliance {
            self.compliance[link] = compliance;
        }
    }
}

/// A batch: consecutive links of one kind and colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LinkBatch {
    pub kind: LinkKind,
    pub first: usize,
    pub count: usize,
}

/// Largest compliance of a link [m/N]. The link does not resist, and products stay finite.
const MAX_COMPLIANCE: f32 = 1.0e12;

/// The compliance [m/N] of a link whose stiffness is multiplied by `scale`.
fn painted_compliance(compliance: f32, scale: f32) -> f32 {
    min(compliance / scale, MAX_COMPLIANCE)
}

/// Inverse spring constant [m/N]: 1 / (stiffness of the material · `stiffness_scale`), or 0 for a
/// stiffness of 0. Bend links are rigid from a bending rigidity of 1 on.
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
    if spring > 0.0 { min(1.0 / spring, MAX_COMPLIANCE) } else { 0.0 }
}
