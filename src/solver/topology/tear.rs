//! Stage `Tear`: overstretched links tear, the most overstretched first, by splitting a vertex.
//!
//! ```text
//!        ╲ │ ╱                    ╲   ╱
//!    ─────● end ─ ─ ▶ other   ─────● ●─────     The triangles at `end` fall into two fans, one on
//!        ╱ │ ╲                    ╱   ╲         each side of the plane across the link.
//! ```
//! Method: of the two ends of the link, the one that carries more load splits first. The fan on the
//! side of the link gets a new vertex, so no triangle is lost. A link at a crack tip tears
//! at a lower strain, so that crack growth does not depend on the mesh size (see
//! `model::crack_tips`).
//!
//! Reads positions, links, crack tips, settings and material; writes the mesh, particles, pins,
//! anchors, links, tethers, piece labels, crack tips and events.
//! Invariant: at most `max_tears_per_tick` links tear per tick and none of them share a vertex.
//! A tear that the vertex reserve cannot hold does not happen, and one event reports that.

use crate::math::hasher::unit;
use crate::math::sort::sort;
use crate::mesh::split_vertex::{FanArc, OpenedEdge, best_arc};
use crate::mesh::{Fan, NONE, next_corner, triangle_of};
use crate::model::crack_tips;
use crate::model::links::{LinkKind, Links};
use crate::model::maps::Map;
use crate::solver::self_collide::surface::surface_stages;
use crate::solver::topology::piece_labels::PieceLabels;
use crate::solver::topology::tear_scratch::{TearCandidate, TearScratch};
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::events::EventKind;

/// Seed of the random tear strength of the links.
const STRENGTH_SEED: u32 = 0x6d75_736c;

/// Ratio of the residual strain at a crack tip to that on a straight line of links: measured on
/// sheets with long cracks at 4, 8 and 16 substeps, plus a margin of a quarter.
const TIP_RESIDUAL_RATIO: f32 = 16.0;

/// Tears the most overstretched links, at most `max_tears_per_tick`.
pub(crate) fn tear_overstretched(world: &mut World) {
    let mut scratch = core::mem::take(&mut world.scratch.tear);
    collect_candidates(world, &mut scratch.candidates);
    scratch.touched.clear();
    let mut torn = 0;
    for at in 0..scratch.candidates.len() {
        let TearCandidate { a, b, .. } = scratch.candidates[at];
        // A tear changes the load of its neighbours, so they wait for the next tick.
        if scratch.touched.contains(&a) || scratch.touched.contains(&b) {
            continue;
        }
        if !can_tear(world, a) {
            break;
        }
        torn += u32::from(tear_link(world, &mut scratch, a, b));
    }
    refresh_crack_tips(world, &mut scratch);
    if torn > 0 {
        update_after_tears(world, &scratch.touched);
    }
    world.scratch.tear = scratch;
}

/// Tears the edge between two particles, whatever its length, and returns whether it tore.
///
/// It does not tear if there is no such edge or if neither end can split: the edge of a single
/// triangle, or an end that a pin holds.
pub(crate) fn tear_edge(world: &mut World, a: u32, b: u32) -> bool {
    let mut scratch = core::mem::take(&mut world.scratch.tear);
    scratch.touched.clear();
    let torn = can_tear(world, a)
        && (tear_link(world, &mut scratch, a, b) || open_border_edge(world, &mut scratch, a, b));
    refresh_crack_tips(world, &mut scratch);
    if torn {
        update_after_tears(world, &scratch.touched);
    }
    world.scratch.tear = scratch;
    torn
}

/// Separates the two sides of fresh tears, and updates piece labels and tethers.
fn update_after_tears(world: &mut World, touched: &[u32]) {
    surface_stages::separate_splits(world, touched.iter().copied());
    update_pieces(world);
    world.update_tethers(touched);
}

/// Updates `crack_tips` at the vertices that tears changed.
fn refresh_crack_tips(world: &mut World, scratch: &mut TearScratch) {
    world.crack_tips.resize(world.mesh.vertex_count(), false);
    for vertex in &scratch.touched {
        let is_tip = crack_tips::is_crack_tip(&world.mesh, &world.rest, *vertex, &mut scratch.part);
        world.crack_tips[*vertex as usize] = is_tip;
    }
}

/// Whether the vertex reserve holds one more tear. Reports once, at `particle`, if it does not.
fn can_tear(world: &mut World, particle: u32) -> bool {
    if !world.is_reserve_used_up() {
        return true;
    }
    if !world.reserve_reported {
        world.reserve_reported = true;
        let place = world.particles.x.get(particle as usize);
        world.events.push(world.event_at(EventKind::ReserveUsedUp, place));
    }
    false
}

/// Collects the `max_tears_per_tick` links with the largest excess, in order of descending excess
/// and then of links.
fn collect_candidates(world: &World, candidates: &mut Vec<TearCandidate>) {
    candidates.clear();
    let free_slots = candidates.capacity().saturating_sub(1);
    let max_count = (world.settings.max_tears_per_tick as usize).min(free_slots);
    let limit = world.material.tear_stretch - 1.0;
    let variation = world.material.tear_variation;
    let residual = residual_tip_strain(world);
    let tip_strain =
        |limit: f32| crack_tips::tear_strain(limit, &world.material, world.mean_edge, residual);
    let [weakest, _] = world.maps.range(Map::Tear);
    let min_strain = tip_strain(limit * weakest) * (1.0 - 0.5 * variation);
    let p = &world.particles;
    let constraints = &world.constraints;
    let batches = constraints.batches.iter().filter(|batch| batch.kind != LinkKind::Bend);
    let batches = batches.map(|batch| (&constraints.links, batch.first..batch.first + batch.count));
    for (links, range) in batches.chain([(&constraints.dynamic, 0..constraints.dynamic.len())]) {
        for link in range {
            let (a, b, rest) = (links.a[link], links.b[link], links.rest[link]);
            let span = p.x.get(b as usize) - p.x.get(a as usize);
            // Early out on squared length for links below the strain of the weakest possible link.
            // The factor 1 - 1e-5 covers the different rounding of squares.
            let safe_length = rest * (1.0 + min_strain) * (1.0 - 1.0e-5);
            if span.length_squared() <= safe_length * safe_length
                || !links.active[link]
                || links.kind(link) == LinkKind::Bend
            {
                continue;
            }
            let stretch = span.length() / rest - 1.0;
            if stretch <= min_strain {
                continue;
            }
            let is_at_tip = world.crack_tips[a as usize] || world.crack_tips[b as usize];
            let limit = limit * world.maps.mean(Map::Tear, &[a, b]);
            let tear_strain = if is_at_tip { tip_strain(limit) } else { limit };
            let ends = [a, b].map(|end| world.mesh.source[end as usize]);
            let strength = 1.0 + variation * (unit(STRENGTH_SEED, &ends) - 0.5);
            let excess = stretch / (tear_strain * strength);
            if excess <= 1.0 {
                continue;
            }
            let at = candidates.partition_point(|other| other.excess >= excess);
            if at < max_count {
                candidates.insert(at, TearCandidate { excess, a, b });
                candidates.truncate(max_count);
            }
        }
    }
}

/// Largest residual strain that the solver leaves at a crack tip of a hanging, swinging cloth.
///
/// A crack tip also carries the load beside the crack, so this is `TIP_RESIDUAL_RATIO` times the
/// residual on a straight line of links (see `line_solver`):
/// ratio · g · n · h² / (2 · sweeps · edge), with n the number of links on the longest line.
fn residual_tip_strain(world: &World) -> f32 {
    let settings = &world.settings;
    let (h, sweeps) = (world.regular_scheme().h, settings.iterations as f32);
    let load = settings.gravity.length() * world.constraints.chains.longest as f32;
    TIP_RESIDUAL_RATIO * load * h * h / (2.0 * sweeps * world.mean_edge)
}

/// Tears the link between two particles at the end that carries more load, or else at the other.
fn tear_link(world: &mut World, scratch: &mut TearScratch, a: u32, b: u32) -> bool {
    let loads = [a, b].map(|end| load(world, end));
    let ends = if loads[1] > loads[0] { [(b, a), (a, b)] } else { [(a, b), (b, a)] };
    for (end, other) in ends {
        if try_split(world, scratch, end, other) {
            push_edge_torn_event(world, a, b);
            return true;
        }
    }
    false
}

/// Opens the edge itself if one end lies on a border: for an explicit tear between two particles
/// that have no triangles behind them.
fn open_border_edge(world: &mut World, scratch: &mut TearScratch, a: u32, b: u32) -> bool {
    for (end, other) in [(a, b), (b, a)] {
        if world.particles.w[end as usize] <= 0.0 {
            continue;
        }
        world.mesh.gather_fan(world.mesh.corner_of[end as usize], &mut scratch.fan);
        let fan = &scratch.fan;
        let edge = fan.ring.iter().position(|end| *end == other).unwrap_or(0);
        if !fan.is_closed && edge > 0 && edge < fan.corners.len() {
            let arc = FanArc { first: edge, count: fan.corners.len() - edge };
            split_arc(world, scratch, end, arc);
            push_edge_torn_event(world, a, b);
            return true;
        }
    }
    false
}

/// Pushes the event that the edge between two particles tore.
pub(crate) fn push_edge_torn_event(world: &mut World, a: u32, b: u32) {
    let middle = (world.particles.x.get(a as usize) + world.particles.x.get(b as usize)) * 0.5;
    let mut event = world.event_at(EventKind::EdgeTorn, middle);
    (event.particle_a, event.particle_b) = (a, b);
    world.events.push(event);
}

/// Load on a particle: the sum of the strains of its stretched links.
fn load(world: &World, particle: u32) -> f32 {
    let p = &world.particles;
    let pull = |links: &Links, link: usize| {
        let (a, b) = (links.a[link], links.b[link]);
        let pulls = links.active[link]
            && (a == particle || b == particle)
            && links.kind(link) != LinkKind::Bend;
        if !pulls {
            return 0.0;
        }
        let stretch = (p.x.get(b as usize) - p.x.get(a as usize)).length() / links.rest[link] - 1.0;
        if stretch > 0.0 { stretch } else { 0.0 }
    };
    let source = world.mesh.source[particle as usize];
    let links = world
        .constraints
        .links_of_site(source)
        .chain(world.constraints.dynamic_links_of_site(source));
    links.map(|(links, link)| pull(links, link)).sum()
}

/// Splits `end` by the plane through it that is normal to the direction to `other`. Returns false
/// if all triangles lie on one side.
fn try_split(world: &mut World, scratch: &mut TearScratch, end: u32, other: u32) -> bool {
    let at = end as usize;
    if world.particles.w[at] <= 0.0 || scratch.touched.contains(&end) {
        return false;
    }
    let x = &world.particles.x;
    let direction = x.get(other as usize) - x.get(at);
    world.mesh.gather_fan(world.mesh.corner_of[at], &mut scratch.fan);
    scratch.goes_to_new.clear();
    for corner in &scratch.fan.corners {
        let [a, b, c] = world.mesh.triangles[triangle_of(*corner)].map(|v| x.get(v as usize));
        let center = (a + b + c) * (1.0 / 3.0);
        scratch.goes_to_new.push((center - x.get(at)).dot(direction) > 0.0);
    }
    let both_sides = scratch.goes_to_new.contains(&true) && scratch.goes_to_new.contains(&false);
    let arc = if both_sides { best_arc(&scratch.fan, &scratch.goes_to_new) } else { None };
    let Some(arc) = arc else { return false };
    split_arc(world, scratch, end, arc);
    true
}

/// Gives the triangles of `arc` of `scratch.fan` a new vertex, and updates links and particles.
fn split_arc(world: &mut World, scratch: &mut TearScratch, end: u32, arc: FanArc) {
    // The opened edges may leave two fans at their far ends that share only that vertex, so store
    // the fans as they are before the split.
    let far_ends = far_ends(scratch, arc);
    for (vertex, fan) in far_ends.iter().zip(&mut scratch.far_fans) {
        if let Some(vertex) = vertex {
            world.mesh.gather_fan(world.mesh.corner_of[*vertex as usize], fan);
        }
    }
    let mut opened = core::mem::take(&mut world.scratch.opened_edges);
    opened.clear();
    let new = world.mesh.split_vertex(&scratch.fan, arc, &mut opened);
    push_split_vertex(world, new, end, &mut scratch.mass_fan);
    world.tethers.push_copy_of(end);
    scratch.touched.extend([end, new]);
    for (vertex, fan) in far_ends.into_iter().zip(&scratch.far_fans) {
        let Some(vertex) = vertex else { continue };
        scratch.touched.push(vertex);
        if let Some(parted) = world.mesh.split_non_manifold_vertex(vertex, fan, &mut scratch.part) {
            push_split_vertex(world, parted, vertex, &mut scratch.mass_fan);
            world.tethers.push_copy_of(vertex);
            scratch.touched.push(parted);
        }
    }
    update_links(world, &opened);
    world.scratch.opened_edges = opened;
}

/// Far ends of the edges that a split of `arc` opens: the inner edges at which the arc starts and
/// ends. A border edge is open already and gives `None`.
fn far_ends(scratch: &TearScratch, arc: FanArc) -> [Option<u32>; 2] {
    let fan = &scratch.fan;
    let n = fan.corners.len();
    let inner = |edge: usize| {
        let is_inner = fan.is_closed || (edge > 0 && edge < n);
        is_inner.then(|| fan.ring[edge % fan.ring.len()])
    };
    let first = inner(arc.first);
    let last = inner(arc.first + arc.count);
    if first == last { [first, None] } else { [first, last] }
}

/// Appends the particle of the new vertex `new`, a copy of `from`, and shares mass, pin stiffness
/// and anchor between both. `fan` is a buffer.
pub(crate) fn push_split_vertex(world: &mut World, new: u32, from: u32, fan: &mut Fan) {
    let at = world.particles.push_copy_of(from as usize);
    debug_assert_eq!(at, new as usize);
    world.scratch.push_particle();
    world.mass_scales.push(world.mass_scales.get(from as usize));
    world.maps.push_between([from; 2], 0.0);
    for vertex in [from, new] {
        compute_mass(world, vertex, fan);
    }
    // A pin still holds both vertices, and a soft one with the same stiffness in total.
    if let Some(pin) = world.pins.get(from).copied() {
        world.pins.insert_copy(new, pin);
        if pin.is_soft() {
            share_stiffness(world, [from, new], pin.stiffness);
        }
    }
    if let Some(anchor) = world.anchors.get(from).copied() {
        world.anchors.insert(AnchorConstraint { particle: new, ..anchor });
    }
    [from, new].into_iter().for_each(|vertex| world.refresh_inverse_mass(vertex));
    let mut event = world.event_at(EventKind::VertexSplit, world.particles.x.get(at));
    let events = &mut world.events;
    let mut push_event = |vertex, source| {
        (event.vertex, event.source) = (vertex, source);
        events.push(event);
    };
    match &mut world.seams {
        // `fan` now holds the fan of the new vertex.
        Some(seams) => seams.split_particle(new, &fan.corners, push_event),
        None => push_event(new, from),
    }
}

/// Shares the stiffness of a pin between two vertices in proportion to their masses.
fn share_stiffness(world: &mut World, vertices: [u32; 2], stiffness: f32) {
    let mass = vertices.map(|vertex| world.particles.mass[vertex as usize]);
    if mass[0] + mass[1] <= 0.0 {
        return;
    }
    for (vertex, own) in vertices.into_iter().zip(mass) {
        if let Some(pin) = world.pins.get_mut(vertex) {
            pin.stiffness = stiffness * (own / (mass[0] + mass[1]));
        }
    }
}

/// Computes the mass of a vertex from its triangles, in triangle order.
fn compute_mass(world: &mut World, vertex: u32, fan: &mut Fan) {
    world.mesh.gather_fan(world.mesh.corner_of[vertex as usize], fan);
    sort(&mut fan.corners);
    let density = world.material.density;
    let share =
        |corner: &u32| world.corner_area[triangle_of(*corner)][*corner as usize % 3] * density;
    let scale = world.mass_scales.get(vertex as usize);
    world.particles.mass[vertex as usize] = fan.corners.iter().map(share).sum::<f32>() * scale;
}

/// Updates the links at opened edges, which get links on both sides.
fn update_links(world: &mut World, opened: &[OpenedEdge]) {
    for sides in opened {
        world.constraints.open_edge(&world.mesh, *sides, (&world.material, &world.maps));
    }
    for [edge, other] in opened {
        for corner in [*edge, next_corner(*edge), *other, next_corner(*other)] {
            let source = world.mesh.source[world.mesh.vertex(corner) as usize];
            world.refresh_constraints_at(source);
        }
    }
}

/// Labels the pieces again after the last tear or cut, pushes an event for each detached piece, and
/// rebuilds the irregular lists.
pub(crate) fn update_pieces(world: &mut World) {
    let old_count = world.pieces;
    let pieces = &mut world.scratch.pieces;
    core::mem::swap(&mut pieces.label, &mut pieces.old_label);
    world.label_pieces();
    if world.pieces > old_count {
        let mut pieces = core::mem::take(&mut world.scratch.pieces);
        push_detached_events(world, &mut pieces, old_count);
        world.scratch.pieces = pieces;
    }
    world.rebuild_irregular_lists();
}

/// Pushes one event for each detached piece: all parts of an old piece but the largest, in the
/// order of their first triangles. `old_count` is the number of old pieces.
fn push_detached_events(world: &mut World, pieces: &mut PieceLabels, old_count: u32) {
    pieces.size.clear();
    pieces.size.resize(world.pieces as usize, 0);
    pieces.successor.clear();
    pieces.successor.resize(old_count as usize, NONE);
    pieces.label.iter().for_each(|label| pieces.size[*label as usize] += 1);
    let size = |piece: u32| pieces.size[piece as usize];
    // Labels follow the order of first triangles, so of two equal parts the earlier one stays.
    let mut next = 0;
    for (label, old) in pieces.label.iter().zip(&pieces.old_label) {
        if *label == next {
            let successor = &mut pieces.successor[*old as usize];
            if *successor == NONE || size(next) > size(*successor) {
                *successor = next;
            }
            next += 1;
        }
    }
    let mut next = 0;
    for (at, (label, old)) in pieces.label.iter().zip(&pieces.old_label).enumerate() {
        if *label != next {
            continue;
        }
        next += 1;
        if pieces.successor[*old as usize] == *label {
            continue;
        }
        let place = world.particles.x.get(world.mesh.triangles[at][0] as usize);
        let mut event = world.event_at(EventKind::PieceDetached, place);
        (event.vertex, event.count) = (world.render_vertex(3 * at as u32), size(*label));
        world.events.push(event);
    }
}

impl World {
    /// Rebuilds `crack_tips` for all vertices.
    pub fn rebuild_crack_tips(&mut self) {
        let mut fan = Fan::default();
        let is_tip = |vertex| crack_tips::is_crack_tip(&self.mesh, &self.rest, vertex, &mut fan);
        self.crack_tips.clear();
        self.crack_tips.extend((0..self.mesh.vertex_count() as u32).map(is_tip));
    }
}
