//! Refreshes the weights of the links' ends (see `end_weights`) when an inverse mass changed.
//!
//! Pins, grabs, masses and tears change inverse masses, which is rare; comparing the whole column
//! of inverse masses once a substep costs little compared with recomputing the weights of all
//! links.
//!
//! Reads `particles.w`, `material`, `constraints`; writes `scratch.end_weights`, the weights of the
//! sparse links, and for each row of a grid the range of links with even ends.
//! Invariant: runs before the sweeps of a substep, so that kernels never see weights of other
//! masses.

use crate::model::grid_rows::GridRows;
use crate::model::links::LinkKind;
use crate::solver::stretch::link_projection::is_rigid;
use crate::solver::world::World;

/// Recomputes all weights if an inverse mass changed, a kind became rigid or compliant, or sparse
/// links were regrouped.
pub(crate) fn refresh(world: &mut World) {
    let kinds = [LinkKind::Stretch, LinkKind::Shear, LinkKind::Bend];
    let rigid = kinds.map(|kind| is_rigid(&world.material, kind));
    let (constraints, weights) = (&mut world.constraints, &mut world.scratch.end_weights);
    let w = &world.particles.w;
    let rows_are_weighed =
        constraints.rows.as_ref().is_none_or(|rows| rows.sparse.has_inverse_masses());
    let are_weighed = constraints.sparse.has_inverse_masses() && rows_are_weighed;
    if weights.is_current(w, rigid) && are_weighed {
        return;
    }
    weights.reset(w, rigid, constraints.links.len());
    for batch in &constraints.batches {
        let range = batch.first..batch.first + batch.count;
        weights.update(&constraints.links, range, rigid[batch.kind as usize]);
    }
    if let Some(rows) = &mut constraints.rows {
        update_even_ranges(rows, &weights.is_even);
        rows.sparse.compute_inverse_masses(|kind, ends| weights.of(ends, rigid[kind]));
    }
    constraints.sparse.compute_inverse_masses(|kind, ends| weights.of(ends, rigid[kind]));
}

/// Sets each row's `equal_mass` to its longest run of links whose ends have equal weights.
fn update_even_ranges(rows: &mut GridRows, is_even: &[bool]) {
    for row in &mut rows.rows {
        row.equal_mass = [row.first; 2];
        let mut from = row.first;
        for link in row.first..row.first + row.count {
            if !is_even[link as usize] {
                from = link + 1;
            } else if link + 1 - from > row.equal_mass[1] - row.equal_mass[0] {
                row.equal_mass = [from, link + 1];
            }
        }
    }
    rows.rebuild_uniform_runs();
}
