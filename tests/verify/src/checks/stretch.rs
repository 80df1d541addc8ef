//! Strain of the links against rest lengths of its own: distances of the new cloth.

use muslin::glam::DVec3;
use muslin::{Cloth, EventKind, LinkKind};
use std::collections::HashSet;

/// Tolerance of the bound, as a share of it.
const TOLERANCE: f64 = 1.0e-3;

/// The shape at rest, and the particles whose links have no rest length of their own.
#[derive(Debug)]
pub struct RestShape {
    positions: Vec<DVec3>,
    /// Particles that a cut added on an edge, and those that were split off from them.
    added: HashSet<u32>,
}

/// What the links do after a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain {
    /// Greatest strain of a stretch or shear link.
    pub greatest: f64,
    /// Whether it is greater than the bound allows.
    pub is_broken: bool,
    /// Whether the statistics report links past the bound.
    pub is_told: bool,
}

impl RestShape {
    /// Reads the shape of a new cloth.
    pub fn of(cloth: &Cloth) -> Self {
        let positions = cloth.positions().iter().map(|x| x.as_dvec3()).collect();
        Self { positions, added: HashSet::new() }
    }

    /// Reads the events of a tick, and notes the particles that cuts added.
    pub fn read_events(&mut self, cloth: &mut Cloth) {
        while let Some(event) = cloth.next_event() {
            let particle = |vertex: u32| cloth.vertex_particles()[vertex as usize];
            let (new, source) = (particle(event.vertex), particle(event.source));
            let is_added = event.kind == EventKind::EdgeDivided
                || event.kind == EventKind::VertexSplit && self.added.contains(&source);
            if is_added {
                self.added.insert(new);
            }
        }
    }

    /// Greatest strain over all stretch and shear links.
    pub fn strain(&self, cloth: &Cloth) -> Strain {
        let particles = cloth.vertex_particles();
        let mut vertex_of = vec![0; cloth.particle_count() as usize];
        for (vertex, particle) in particles.iter().enumerate().rev() {
            vertex_of[*particle as usize] = vertex;
        }
        let source = |particle: u32| {
            let vertex = cloth.source_vertices()[vertex_of[particle as usize]];
            self.positions[vertex as usize]
        };
        let now = |particle: u32| cloth.positions()[vertex_of[particle as usize]].as_dvec3();
        let mut greatest = f64::NEG_INFINITY;
        for (a, b, kind) in cloth.links() {
            let is_bounded = matches!(kind, LinkKind::Stretch | LinkKind::Shear);
            if is_bounded && !self.added.contains(&a) && !self.added.contains(&b) {
                let rest = source(a).distance(source(b));
                greatest = greatest.max(now(a).distance(now(b)) / rest - 1.0);
            }
        }
        let bound = f64::from(cloth.settings().max_stretch);
        Strain {
            greatest,
            is_broken: bound > 0.0 && greatest > bound * (1.0 + TOLERANCE),
            is_told: cloth.stats().over_stretched > 0,
        }
    }
}
