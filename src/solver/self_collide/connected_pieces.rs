//! Connected pieces of the mesh as created, before any tear.
//!
//! Union-find over the rest vertices (sites) of all triangles, with path halving; the root of a
//! piece is its lowest site. Both kinds of self-collision use it: sides of one piece that are near
//! each other at rest keep a smaller distance, or none.
//!
//! Reads the mesh; returns a list.
//!
//! Invariant: copies of a split vertex share a site, so tears do not change the pieces.

use crate::mesh::Mesh;

/// The connected piece of each of `sites` sites, named by its lowest site.
pub(crate) fn piece_of_sites(mesh: &Mesh, sites: usize) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..sites as u32).collect();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.source[vertex as usize]);
        for (p, q) in [(a, b), (b, c)] {
            let (p, q) = (find_root(&mut parents, p), find_root(&mut parents, q));
            parents[p.max(q) as usize] = p.min(q);
        }
    }
    (0..sites as u32).map(|site| find_root(&mut parents, site)).collect()
}

/// The root of a site's piece; halves the path to it.
pub(crate) fn find_root(parents: &mut [u32], mut site: u32) -> u32 {
    while parents[site as usize] != site {
        parents[site as usize] = parents[parents[site as usize] as usize];
        site = parents[site as usize];
    }
    site
}
