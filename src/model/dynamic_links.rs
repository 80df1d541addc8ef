//! Extra links, and how all links follow the mesh: an opened edge needs a link on its second side, and
//! what a cut divides needs new ones.
//!
//! A link has a number: that in its list, plus `EXTRA` for an extra one.

use crate::mesh::{Corner, Mesh, NONE, after};
use crate::model::constraints::{Constraints, edge_of};
use crate::model::links::{Links, Spec, Support};
use crate::model::material::Material;
use glam::Vec3;

/// Marks the number of an extra link.
pub(super) const EXTRA: u32 = 1 << 31;

impl Constraints {
    /// Which way the threads of a grid run, unit vectors along the weft and the warp.
    pub fn run_along(&mut self, threads: [Vec3; 2]) {
        self.threads = Some(threads);
    }

    /// Makes room for `count` more extra links, and for `sites` in all.
    pub fn reserve(&mut self, count: usize, sites: usize) {
        self.extra.reserve(count);
        self.loose.reserve(self.extra.len() + count);
        self.palette.reserve(self.extra.len() + count, sites);
        self.extra_sites.reserve_exact(count);
        self.extra_next.reserve_exact(count);
        self.extra_head.reserve_exact(sites.saturating_sub(self.extra_head.len()));
        if let Some(rows) = &mut self.rows {
            rows.reserve();
        }
    }

    /// A link by its number.
    pub(super) fn link(&self, number: u32) -> (&Links, usize) {
        if number >= EXTRA {
            (&self.extra, (number - EXTRA) as usize)
        } else {
            (&self.links, number as usize)
        }
    }

    /// A link by its number, to change what it is anchored to or how strong it is.
    pub(super) fn link_mut(&mut self, number: u32) -> (&mut Links, usize) {
        if number >= EXTRA {
            (&mut self.extra, (number - EXTRA) as usize)
        } else {
            self.is_changed[number as usize] = true;
            (&mut self.links, number as usize)
        }
    }

    /// Adds an extra link, and gives its number.
    pub(super) fn add(&mut self, mesh: &Mesh, spec: Spec, rest: f32, material: &Material) -> u32 {
        let new = self.extra.len();
        self.extra.push(mesh, spec, rest);
        self.extra.stiffen(new, material);
        if spec.support == Support::Gone {
            self.extra.active[new] = false;
        }
        let mut sites = spec.corners().map(|corner| mesh.source[mesh.vertex(corner) as usize]);
        for at in 1..4 {
            if sites[..at].contains(&sites[at]) {
                sites[at] = NONE;
            }
        }
        let most = sites.iter().filter(|site| **site != NONE).max().map_or(0, |site| site + 1);
        if self.extra_head.len() < most as usize {
            self.extra_head.resize(most as usize, NONE);
        }
        let heads = &mut self.extra_head;
        self.extra_next.push(sites.map(|site| heads.get(site as usize).copied().unwrap_or(NONE)));
        for site in sites.into_iter().filter(|site| *site != NONE) {
            heads[site as usize] = new as u32;
        }
        self.extra_sites.push(sites);
        let number = EXTRA | new as u32;
        if spec.support == Support::Edge {
            self.link_of_edge[edge_of(spec.anchors) as usize] = number;
        }
        number
    }

    /// Gives the second side of an opened edge a link of its own; either side keeps half the strength.
    ///
    /// The cloth has seen to room for it.
    pub fn open(&mut self, mesh: &Mesh, sides: [Corner; 2], material: &Material) {
        let of = |edge: Corner| self.link_of_edge[edge as usize];
        let (number, bare) =
            if of(sides[0]) == NONE { (of(sides[1]), sides[0]) } else { (of(sides[0]), sides[1]) };
        // No cloth has an edge without a link, but bytes from outside may say so.
        if number == NONE {
            return;
        }
        let (links, at) = self.link_mut(number);
        links.spec[at].shape *= 0.5;
        links.stiffen(at, material);
        let spec = Spec { anchors: [bare, after(bare)], ..links.spec[at] };
        let rest = links.rest[at];
        self.add(mesh, spec, rest, material);
    }

    /// Brings every link of a site in line with the mesh.
    pub fn follow(&mut self, mesh: &Mesh, site: u32) {
        for at in self.involved_range(site) {
            let link = self.involved[at] as usize;
            self.links.follow(mesh, link);
            self.lines.abreast.forget(link);
            self.hinges.follow_link(mesh, &self.links, link);
            if let Some(rows) = &mut self.rows {
                let ends = (self.links.a[link], self.links.b[link]);
                rows.follow(link, ends, self.links.active[link]);
            }
        }
        let mut at = self.first_extra(site);
        while at != NONE {
            self.extra.follow(mesh, at as usize);
            at = self.next_extra(at, site);
        }
    }

    /// Gathers the links that sweeps find in no row, after some changed. `particles` is how many there
    /// are.
    pub fn gather(&mut self, particles: usize) {
        self.loose.color(&self.extra, particles, &mut self.palette);
        if let Some(rows) = &mut self.rows {
            rows.gather(&self.links, &self.batches);
        }
    }

    /// The links that it was woven with of a site.
    pub fn of_vertex(&self, site: u32) -> impl Iterator<Item = (&Links, usize)> + '_ {
        let range = self.involved_range(site);
        self.involved[range].iter().map(|link| (&self.links, *link as usize))
    }

    /// The extra links of a site, the newest first.
    pub fn extra_of_vertex(&self, site: u32) -> impl Iterator<Item = (&Links, usize)> + '_ {
        let some = |at: u32| (at != NONE).then_some(at);
        let first = some(self.first_extra(site));
        core::iter::successors(first, move |at| some(self.next_extra(*at, site)))
            .map(|at| (&self.extra, at as usize))
    }

    fn involved_range(&self, site: u32) -> core::ops::Range<usize> {
        let bound = |at: usize| self.first.get(at).map_or(self.involved.len(), |at| *at as usize);
        bound(site as usize)..bound(site as usize + 1)
    }

    fn first_extra(&self, site: u32) -> u32 {
        self.extra_head.get(site as usize).copied().unwrap_or(NONE)
    }

    fn next_extra(&self, at: u32, site: u32) -> u32 {
        let slot = self.extra_sites[at as usize].iter().position(|other| *other == site);
        slot.map_or(NONE, |slot| self.extra_next[at as usize][slot])
    }

    /// What became of the links since they were woven: those that changed, and the extra ones.
    pub fn changes(&self) -> Changes {
        let changed = (0..self.links.len()).filter(|link| self.is_changed[*link]);
        Changes {
            woven: changed.map(|link| (link as u32, self.links.spec[link])).collect(),
            extra: self.extra.spec.iter().copied().zip(self.extra.rest.iter().copied()).collect(),
        }
    }

    /// Makes those changes to a fresh weave over the changed mesh; false if they do not fit it.
    ///
    /// Links follow the mesh only when they are told to.
    pub fn change(&mut self, mesh: &Mesh, changes: &Changes, material: &Material) -> bool {
        let corners = 3 * mesh.triangles.len() as u32;
        let fits = |spec: &Spec| {
            spec.corners().iter().all(|corner| *corner < corners)
                && (spec.support != Support::Edge || spec.anchors[0] / 3 == spec.anchors[1] / 3)
                && spec.shape.is_finite()
                && spec.shape >= 0.0
        };
        self.link_of_edge.resize(corners as usize, NONE);
        for (link, spec) in &changes.woven {
            let at = *link as usize;
            let Some(woven) = self.links.spec.get(at).copied() else { return false };
            if !(fits(spec) && spec.kind == woven.kind && spec.thread == woven.thread) {
                return false;
            }
            self.links.spec[at] = *spec;
            self.is_changed[at] = true;
        }
        self.link_of_edge.fill(NONE);
        for (at, spec) in self.links.spec.iter().enumerate() {
            if spec.support == Support::Edge {
                self.link_of_edge[edge_of(spec.anchors) as usize] = at as u32;
            }
        }
        self.reserve(changes.extra.len(), self.extra_head.len());
        for (spec, rest) in &changes.extra {
            if !(fits(spec) && rest.is_finite() && *rest > 0.0) {
                return false;
            }
            self.add(mesh, *spec, *rest, material);
        }
        true
    }
}

/// What became of the links of a cloth since it was woven.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub(crate) struct Changes {
    woven: Vec<(u32, Spec)>,
    extra: Vec<(Spec, f32)>,
}
