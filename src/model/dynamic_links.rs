//! Dynamic links, and the update of all links after the mesh changed.
//!
//! An opened edge needs a link on its second side, and a cut needs links at its new vertices. These
//! links are appended to `Constraints::dynamic`, so that the batches and colours of the original
//! links never change.
//!
//! A link number is the index in its list, plus `DYNAMIC` for a dynamic link.
//!
//! Reads `Mesh`, `Material` and `Maps`; writes `Constraints`.
//!
//! Invariant: after `update_site` for every changed site and one `rebuild_sparse`, all links agree
//! with the mesh.

use crate::math::reserve::ReserveTotal;
use crate::mesh::{Corner, Mesh, NONE, next_corner};
use crate::model::constraints::{Constraints, edge_of};
use crate::model::links::{LinkSpec, LinkSupport, Links};
use crate::model::maps::Maps;
use crate::model::material::Material;
use glam::Vec3;

/// Flag in the number of a dynamic link.
pub(super) const DYNAMIC: u32 = 1 << 31;

impl Constraints {
    /// Sets the unit vectors along weft and warp of a grid at rest.
    pub fn set_thread_directions(&mut self, thread_directions: [Vec3; 2]) {
        self.thread_directions = Some(thread_directions);
    }

    /// Allocates for `count` more dynamic links, and for `sites` sites in all.
    pub fn reserve(&mut self, count: usize, sites: usize) {
        self.dynamic.reserve(count);
        self.sparse.reserve(self.dynamic.len() + count);
        self.coloring.reserve(self.dynamic.len() + count, sites);
        self.dynamic_sites.reserve_exact(count);
        self.dynamic_next.reserve_exact(count);
        self.dynamic_head.reserve_total(sites);
        if let Some(rows) = &mut self.rows {
            rows.reserve();
        }
        self.chains.blocks.reserve_breaks(&self.links);
    }

    /// The list and index of a link number.
    pub(super) fn link(&self, number: u32) -> (&Links, usize) {
        if number >= DYNAMIC {
            (&self.dynamic, (number - DYNAMIC) as usize)
        } else {
            (&self.links, number as usize)
        }
    }

    /// The list and index of a link number, for changing its definition; marks an original link as
    /// changed.
    pub(super) fn link_mut(&mut self, number: u32) -> (&mut Links, usize) {
        if number >= DYNAMIC {
            (&mut self.dynamic, (number - DYNAMIC) as usize)
        } else {
            self.is_changed[number as usize] = true;
            (&mut self.links, number as usize)
        }
    }

    /// Appends a dynamic link and returns its number.
    pub(super) fn push_dynamic(
        &mut self,
        mesh: &Mesh,
        spec: LinkSpec,
        rest: f32,
        (material, maps): (&Material, &Maps),
    ) -> u32 {
        let new = self.dynamic.len();
        self.dynamic.push(mesh, spec, rest);
        self.dynamic.update_compliance(new, material, maps);
        if spec.support == LinkSupport::Removed {
            self.dynamic.active[new] = false;
        }
        let mut sites =
            spec.dependent_corners().map(|corner| mesh.source[mesh.vertex(corner) as usize]);
        for at in 1..4 {
            if sites[..at].contains(&sites[at]) {
                sites[at] = NONE;
            }
        }
        let most = sites.iter().filter(|site| **site != NONE).max().map_or(0, |site| site + 1);
        if self.dynamic_head.len() < most as usize {
            self.dynamic_head.resize(most as usize, NONE);
        }
        let heads = &mut self.dynamic_head;
        self.dynamic_next.push(sites.map(|site| heads.get(site as usize).copied().unwrap_or(NONE)));
        for site in sites.into_iter().filter(|site| *site != NONE) {
            heads[site as usize] = new as u32;
        }
        self.dynamic_sites.push(sites);
        let number = DYNAMIC | new as u32;
        if spec.support == LinkSupport::Edge {
            self.link_of_edge[edge_of(spec.ends) as usize] = number;
        }
        number
    }

    /// Gives the second side of an opened edge its own link. Each of the two links keeps half of
    /// the stiffness.
    ///
    /// The caller has reserved capacity.
    pub fn open_edge(
        &mut self,
        mesh: &Mesh,
        sides: [Corner; 2],
        (material, maps): (&Material, &Maps),
    ) {
        let of = |edge: Corner| self.link_of_edge[edge as usize];
        let (number, bare) =
            if of(sides[0]) == NONE { (of(sides[1]), sides[0]) } else { (of(sides[0]), sides[1]) };
        // Every edge has a link, except in corrupt saves.
        if number == NONE {
            return;
        }
        let (links, at) = self.link_mut(number);
        links.spec[at].stiffness_scale *= 0.5;
        links.update_compliance(at, material, maps);
        let spec = LinkSpec { ends: [bare, next_corner(bare)], ..links.spec[at] };
        let rest = links.rest[at];
        self.push_dynamic(mesh, spec, rest, (material, maps));
    }

    /// Updates every link that depends on a site after its vertices changed.
    pub fn update_site(&mut self, mesh: &Mesh, site: u32) {
        for at in self.site_range(site) {
            let link = self.links_by_site[at] as usize;
            self.links.update(mesh, link);
            self.chains.blocks.mark_stale(link);
            self.hinges.update_link(mesh, &self.links, link);
            if let Some(rows) = &mut self.rows {
                let ends = (self.links.a[link], self.links.b[link]);
                rows.update_link(link, ends, self.links.active[link]);
            }
        }
        let mut at = self.first_dynamic(site);
        while at != NONE {
            self.dynamic.update(mesh, at as usize);
            at = self.next_dynamic(at, site);
        }
    }

    /// Rebuilds the lists of dynamic and irregular links for the sweeps, after links changed.
    /// `particles` is the number of particles.
    pub fn rebuild_sparse(&mut self, particles: usize) {
        self.sparse.rebuild_colored(&self.dynamic, particles, &mut self.coloring);
        if let Some(rows) = &mut self.rows {
            rows.rebuild_sparse(&self.links, &self.batches);
        }
    }

    /// The original links that depend on a site.
    pub fn links_of_site(&self, site: u32) -> impl Iterator<Item = (&Links, usize)> + '_ {
        let range = self.site_range(site);
        self.links_by_site[range].iter().map(|link| (&self.links, *link as usize))
    }

    /// The dynamic links that depend on a site, the newest first.
    pub fn dynamic_links_of_site(&self, site: u32) -> impl Iterator<Item = (&Links, usize)> + '_ {
        let some = |at: u32| (at != NONE).then_some(at);
        let first = some(self.first_dynamic(site));
        core::iter::successors(first, move |at| some(self.next_dynamic(*at, site)))
            .map(|at| (&self.dynamic, at as usize))
    }

    fn site_range(&self, site: u32) -> core::ops::Range<usize> {
        let bound = |at: usize| {
            self.first_of_site.get(at).map_or(self.links_by_site.len(), |at| *at as usize)
        };
        bound(site as usize)..bound(site as usize + 1)
    }

    fn first_dynamic(&self, site: u32) -> u32 {
        self.dynamic_head.get(site as usize).copied().unwrap_or(NONE)
    }

    fn next_dynamic(&self, at: u32, site: u32) -> u32 {
        let slot = self.dynamic_sites[at as usize].iter().position(|other| *other == site);
        slot.map_or(NONE, |slot| self.dynamic_next[at as usize][slot])
    }

    /// Returns what changed since creation, for a save.
    pub fn link_changes(&self) -> LinkChanges {
        let changed = (0..self.links.len()).filter(|link| self.is_changed[*link]);
        LinkChanges {
            original: changed.map(|link| (link as u32, self.links.spec[link])).collect(),
            dynamic: self
                .dynamic
                .spec
                .iter()
                .copied()
                .zip(self.dynamic.rest.iter().copied())
                .collect(),
        }
    }

    /// Applies saved changes to the fresh links of a mesh that is already torn or cut. Returns
    /// false if they do not fit.
    ///
    /// The caller then runs `update_site` for all sites.
    pub fn apply_changes(
        &mut self,
        mesh: &Mesh,
        link_changes: &LinkChanges,
        material: (&Material, &Maps),
    ) -> bool {
        let corners = 3 * mesh.triangles.len() as u32;
        let fits = |spec: &LinkSpec| {
            spec.dependent_corners().iter().all(|corner| *corner < corners)
                && (spec.support != LinkSupport::Edge || spec.ends[0] / 3 == spec.ends[1] / 3)
                && spec.stiffness_scale.is_finite()
                && spec.stiffness_scale >= 0.0
        };
        self.link_of_edge.resize(corners as usize, NONE);
        for (link, spec) in &link_changes.original {
            let at = *link as usize;
            let Some(created) = self.links.spec.get(at).copied() else { return false };
            if !(fits(spec) && spec.kind == created.kind && spec.direction == created.direction) {
                return false;
            }
            self.links.spec[at] = *spec;
            self.is_changed[at] = true;
        }
        self.link_of_edge.fill(NONE);
        for (at, spec) in self.links.spec.iter().enumerate() {
            if spec.support == LinkSupport::Edge {
                self.link_of_edge[edge_of(spec.ends) as usize] = at as u32;
            }
        }
        self.reserve(link_changes.dynamic.len(), self.dynamic_head.len());
        for (spec, rest) in &link_changes.dynamic {
            if !(fits(spec) && rest.is_finite() && *rest > 0.0) {
                return false;
            }
            self.push_dynamic(mesh, *spec, *rest, material);
        }
        true
    }
}

/// Changes of the links since creation. Field order is part of the save format.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub(crate) struct LinkChanges {
    original: Vec<(u32, LinkSpec)>,
    dynamic: Vec<(LinkSpec, f32)>,
}
