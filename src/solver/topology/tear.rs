//! Stage `Tear`: over-stretched links tear, the worst first, by splitting a vertex.
//!
//! The link pulls at its two ends; the one with more load behind it gives way. Its triangles fall
//! in two fans by the plane across the link, and the fan on the link's side gets a new vertex.

use crate::math::mixer::unit;
use crate::math::sort::sort;
use crate::mesh::split_vertex::{Arc, Opening, best_arc};
use crate::mesh::{Fan, NONE, triangle_of};
use crate::model::crack_tips;
use crate::model::links::{LinkKind, Links};
use crate::solver::self_collide::surface::split_separation;
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::events::{Event, EventKind};

/// Seed of the weave's unevenness.
const WEAVE_SEED: u32 = 0x6d75_736c;

/// How many times what is left on a line is left at a tip: measured on sheets with long slits, at 4, 8
/// and 16 substeps, and a quarter more.
const CROWDED: f32 = 16.0;

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct TearScratch {
    worst: Vec<Candidate>,
    fan: Fan,
    far: [Fan; 2],
    part: Fan,
    weigh: Fan,
    moves: Vec<bool>,
    touched: Vec<u32>,
}

/// Which triangles hang together, now and before the last tears.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    pub label: Vec<u32>,
    old_label: Vec<u32>,
    size: Vec<u32>,
    /// For each old piece, the new one that counts as what is left of it.
    stays: Vec<u32>,
}

impl Pieces {
    /// A triangle more, parted from another one.
    pub fn divide(&mut self, triangle: usize) {
        self.label.push(self.label[triangle]);
        self.old_label.push(NONE);
    }

    /// Makes room for as many pieces as there are triangles.
    pub fn reserve(&mut self) {
        let count = self.label.len();
        self.size.reserve_exact(count.saturating_sub(self.size.len()));
        self.stays.reserve_exact(count.saturating_sub(self.stays.len()));
    }

    pub fn new(triangles: usize) -> Self {
        Self {
            label: vec![0; triangles],
            old_label: vec![0; triangles],
            size: Vec::with_capacity(triangles),
            stays: Vec::with_capacity(triangles),
        }
    }
}

/// An over-stretched link.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Stretch over the stretch at which this link tears.
    excess: f32,
    a: u32,
    b: u32,
}

impl TearScratch {
    /// Makes room for `max_tears` in one tick.
    pub fn reserve(&mut self, max_tears: usize) {
        self.worst.reserve_exact((max_tears + 1).saturating_sub(self.worst.len()));
    }

    /// Room for `max_tears` in one tick.
    pub fn with_capacity(max_tears: usize) -> Self {
        // A fan is as large as the vertex has triangles; 64 is far beyond any mesh worth tearing,
        // and a larger one costs one allocation, once.
        let fan = || Fan {
            corners: Vec::with_capacity(64),
            spokes: Vec::with_capacity(65),
            is_closed: false,
        };
        Self {
            worst: Vec::with_capacity(max_tears + 1),
            fan: fan(),
            far: [fan(), fan()],
            part: fan(),
            weigh: fan(),
            moves: Vec::with_capacity(64),
            touched: Vec::with_capacity(8 * max_tears.min(1024)),
        }
    }
}

/// Tears what is over-stretched, at most `max_tears_per_tick` vertices.
pub(crate) fn tear(world: &mut World) {
    let mut scratch = core::mem::take(&mut world.scratch.tear);
    find_worst(world, &mut scratch.worst);
    scratch.touched.clear();
    let mut torn = 0;
    for at in 0..scratch.worst.len() {
        let Candidate { a, b, .. } = scratch.worst[at];
        // One tear changes what its neighbours carry: they have to wait for the next tick.
        if scratch.touched.contains(&a) || scratch.touched.contains(&b) {
            continue;
        }
        if !has_room(world, a) {
            break;
        }
        torn += u32::from(tear_between(world, &mut scratch, a, b));
    }
    follow_tips(world, &mut scratch);
    if torn > 0 {
        split_separation::part(world, scratch.touched.iter().copied());
        settle(world);
        world.tether_around(&scratch.touched);
    }
    world.scratch.tear = scratch;
}

/// Tears the edge between two particles, whatever its length. False if there is none, or if neither
/// end can give way: a lone triangle's, or one held by a pin.
pub(crate) fn tear_edge(world: &mut World, a: u32, b: u32) -> bool {
    let mut scratch = core::mem::take(&mut world.scratch.tear);
    scratch.touched.clear();
    let torn = has_room(world, a)
        && (tear_between(world, &mut scratch, a, b) || part_along(world, &mut scratch, a, b));
    follow_tips(world, &mut scratch);
    if torn {
        split_separation::part(world, scratch.touched.iter().copied());
        settle(world);
        world.tether_around(&scratch.touched);
    }
    world.scratch.tear = scratch;
    torn
}

/// Finds out which of the vertices that were touched are tips now.
fn follow_tips(world: &mut World, scratch: &mut TearScratch) {
    world.crack_tips.resize(world.mesh.vertex_count(), false);
    for vertex in &scratch.touched {
        let is_tip = crack_tips::is_tip(&world.mesh, &world.rest, *vertex, &mut scratch.part);
        world.crack_tips[*vertex as usize] = is_tip;
    }
}

/// Whether the reserve holds one more tear, at a particle; tells the host once if it does not.
fn has_room(world: &mut World, particle: u32) -> bool {
    if !world.is_reserve_used_up() {
        return true;
    }
    if !world.reserve_told {
        world.reserve_told = true;
        let place = world.particles.x.at(particle as usize);
        world.events.push(Event::new(EventKind::ReserveUsedUp, world.tick, place));
    }
    false
}

/// The `max_tears_per_tick` links with the greatest excess, greatest first, ties by their order.
fn find_worst(world: &World, worst: &mut Vec<Candidate>) {
    worst.clear();
    let most = (world.settings.max_tears_per_tick as usize).min(worst.capacity().saturating_sub(1));
    let limit = world.material.tear_stretch;
    let variation = world.material.tear_variation;
    let at_tips = crack_tips::strain(&world.material, world.mean_edge, left_at_tips(world));
    let least = at_tips * (1.0 - 0.5 * variation);
    let p = &world.particles;
    let constraints = &world.constraints;
    let woven = constraints.batches.iter().filter(|batch| batch.kind != LinkKind::Bend);
    let woven = woven.map(|batch| (&constraints.links, batch.first..batch.first + batch.count));
    for (links, range) in woven.chain([(&constraints.extra, 0..constraints.extra.len())]) {
        for link in range {
            let (a, b, rest) = (links.a[link], links.b[link], links.rest[link]);
            let span = p.x.at(b as usize) - p.x.at(a as usize);
            // The weakest of an uneven weave tears at half the excess; most need not be looked up, nor
            // measured but by their squares. A hair less, since those round otherwise.
            let short = rest * (1.0 + least) * (1.0 - 1.0e-5);
            if span.length_squared() <= short * short
                || !links.active[link]
                || links.kind(link) == LinkKind::Bend
            {
                continue;
            }
            let stretch = span.length() / rest - 1.0;
            if stretch <= least {
                continue;
            }
            let is_at_tip = world.crack_tips[a as usize] || world.crack_tips[b as usize];
            let bearable = if is_at_tip { at_tips } else { limit - 1.0 };
            let ends = [a, b].map(|end| world.mesh.source[end as usize]);
            let strength = 1.0 + variation * (unit(WEAVE_SEED, &ends) - 0.5);
            let excess = stretch / (bearable * strength);
            if excess <= 1.0 {
                continue;
            }
            let at = worst.partition_point(|other| other.excess >= excess);
            if at < most {
                worst.insert(at, Candidate { excess, a, b });
                worst.truncate(most);
            }
        }
    }
}

/// The most strain that substeps leave at the tip of a slit of a cloth that hangs and swings: some times what
/// they leave on a line by itself (see `lines`), since a tip bears what hangs beside it as well.
fn left_at_tips(world: &World) -> f32 {
    let settings = &world.settings;
    let (h, sweeps) = (settings.scheme().h, settings.iterations as f32);
    let load = settings.gravity.length() * world.constraints.lines.longest as f32;
    CROWDED * load * h * h / (2.0 * sweeps * world.mean_edge)
}

fn tear_between(world: &mut World, scratch: &mut TearScratch, a: u32, b: u32) -> bool {
    let loads = [a, b].map(|end| load(world, end));
    let ends = if loads[1] > loads[0] { [(b, a), (a, b)] } else { [(a, b), (b, a)] };
    for (end, other) in ends {
        if try_split(world, scratch, end, other) {
            tell_torn(world, a, b);
            return true;
        }
    }
    false
}

/// Opens the edge itself where it starts at a border: for a tear by hand between two particles that
/// have nothing behind them.
fn part_along(world: &mut World, scratch: &mut TearScratch, a: u32, b: u32) -> bool {
    for (end, other) in [(a, b), (b, a)] {
        if world.particles.w[end as usize] <= 0.0 {
            continue;
        }
        world.mesh.fan(world.mesh.corner_of[end as usize], &mut scratch.fan);
        let fan = &scratch.fan;
        let spoke = fan.spokes.iter().position(|spoke| *spoke == other).unwrap_or(0);
        if !fan.is_closed && spoke > 0 && spoke < fan.corners.len() {
            let arc = Arc { first: spoke, count: fan.corners.len() - spoke };
            split_out(world, scratch, end, arc);
            tell_torn(world, a, b);
            return true;
        }
    }
    false
}

pub(crate) fn tell_torn(world: &mut World, a: u32, b: u32) {
    let middle = (world.particles.x.at(a as usize) + world.particles.x.at(b as usize)) * 0.5;
    let mut event = Event::new(EventKind::EdgeTorn, world.tick, middle);
    (event.particle_a, event.particle_b) = (a, b);
    world.events.push(event);
}

/// How hard the links at a particle pull: the sum of their stretches.
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
        let stretch = (p.x.at(b as usize) - p.x.at(a as usize)).length() / links.rest[link] - 1.0;
        if stretch > 0.0 { stretch } else { 0.0 }
    };
    let source = world.mesh.source[particle as usize];
    let links =
        world.constraints.of_vertex(source).chain(world.constraints.extra_of_vertex(source));
    links.map(|(links, link)| pull(links, link)).sum()
}

/// Splits `end` by the plane across the way to `other`; false if that leaves nothing on one side.
fn try_split(world: &mut World, scratch: &mut TearScratch, end: u32, other: u32) -> bool {
    let at = end as usize;
    if world.particles.w[at] <= 0.0 || scratch.touched.contains(&end) {
        return false;
    }
    let x = &world.particles.x;
    let way = x.at(other as usize) - x.at(at);
    world.mesh.fan(world.mesh.corner_of[at], &mut scratch.fan);
    scratch.moves.clear();
    for corner in &scratch.fan.corners {
        let [a, b, c] = world.mesh.triangles[triangle_of(*corner)].map(|v| x.at(v as usize));
        let center = (a + b + c) * (1.0 / 3.0);
        scratch.moves.push((center - x.at(at)).dot(way) > 0.0);
    }
    let both_sides = scratch.moves.contains(&true) && scratch.moves.contains(&false);
    let arc = if both_sides { best_arc(&scratch.fan, &scratch.moves) } else { None };
    let Some(arc) = arc else { return false };
    split_out(world, scratch, end, arc);
    true
}

/// Gives an arc of the fan in `scratch` a vertex of its own, and brings all else in line.
fn split_out(world: &mut World, scratch: &mut TearScratch, end: u32, arc: Arc) {
    // Opened edges may leave their far ends as mere points between fans: see them as they are now.
    let far_ends = far_ends(scratch, arc);
    for (vertex, fan) in far_ends.iter().zip(&mut scratch.far) {
        if let Some(vertex) = vertex {
            world.mesh.fan(world.mesh.corner_of[*vertex as usize], fan);
        }
    }
    let mut opened = core::mem::take(&mut world.scratch.opened);
    opened.clear();
    let new = world.mesh.split(&scratch.fan, arc, &mut opened);
    admit(world, new, end, &mut scratch.weigh);
    world.tethers.admit(end);
    scratch.touched.extend([end, new]);
    for (vertex, fan) in far_ends.into_iter().zip(&scratch.far) {
        let Some(vertex) = vertex else { continue };
        scratch.touched.push(vertex);
        if let Some(parted) = world.mesh.part_fans(vertex, fan, &mut scratch.part) {
            admit(world, parted, vertex, &mut scratch.weigh);
            world.tethers.admit(vertex);
            scratch.touched.push(parted);
        }
    }
    rejoin(world, &opened);
    world.scratch.opened = opened;
}

/// The far ends of the edges that cutting out `arc` opens: the spokes where it starts and ends.
fn far_ends(scratch: &TearScratch, arc: Arc) -> [Option<u32>; 2] {
    let fan = &scratch.fan;
    let n = fan.corners.len();
    let inner = |spoke: usize| {
        let inside = fan.is_closed || (spoke > 0 && spoke < n);
        inside.then(|| fan.spokes[spoke % fan.spokes.len()])
    };
    let first = inner(arc.first);
    let last = inner(arc.first + arc.count);
    if first == last { [first, None] } else { [first, last] }
}

/// Brings a new vertex to life as a copy of the one it came from.
pub(crate) fn admit(world: &mut World, new: u32, from: u32, fan: &mut Fan) {
    let at = world.particles.push_copy_of(from as usize);
    debug_assert_eq!(at, new as usize);
    world.scratch.grow();
    world.mass_scales.push(world.mass_scales.of(from as usize));
    for vertex in [from, new] {
        weigh_fan(world, vertex, fan);
    }
    // A pin holds all that it held before, and a soft one no harder.
    if let Some(pin) = world.pins.find(from).copied() {
        world.pins.insert_copy(new, pin);
        if pin.is_soft() {
            share_stiffness(world, [from, new], pin.stiffness);
        }
    }
    if let Some(leash) = world.anchors.find(from).copied() {
        world.anchors.insert(AnchorConstraint { particle: new, ..leash });
    }
    [from, new].into_iter().for_each(|vertex| world.refresh_weight(vertex));
    let mut event = Event::new(EventKind::VertexSplit, world.tick, world.particles.x.at(at));
    let events = &mut world.events;
    let mut tell = |vertex, source| {
        (event.vertex, event.source) = (vertex, source);
        events.push(event);
    };
    match &mut world.seams {
        // The last fan that was weighed is the new one.
        Some(seams) => seams.part(new, &fan.corners, tell),
        None => tell(new, from),
    }
}

/// Two vertices share the stiffness of a pin as they share the mass that it held.
fn share_stiffness(world: &mut World, vertices: [u32; 2], stiffness: f32) {
    let mass = vertices.map(|vertex| world.particles.mass[vertex as usize]);
    if mass[0] + mass[1] <= 0.0 {
        return;
    }
    for (vertex, own) in vertices.into_iter().zip(mass) {
        if let Some(pin) = world.pins.find_mut(vertex) {
            pin.stiffness = stiffness * (own / (mass[0] + mass[1]));
        }
    }
}

/// The mass of a vertex from the triangles it has left, added up in their order.
fn weigh_fan(world: &mut World, vertex: u32, fan: &mut Fan) {
    world.mesh.fan(world.mesh.corner_of[vertex as usize], fan);
    sort(&mut fan.corners);
    let density = world.material.density;
    let share =
        |corner: &u32| world.corner_area[triangle_of(*corner)][*corner as usize % 3] * density;
    let scale = world.mass_scales.of(vertex as usize);
    world.particles.mass[vertex as usize] = fan.corners.iter().map(share).sum::<f32>() * scale;
}

/// Links follow the mesh, and opened edges get links on both sides.
fn rejoin(world: &mut World, opened: &[Opening]) {
    for sides in opened {
        world.constraints.open(&world.mesh, *sides, &world.material);
    }
    for [edge, other] in opened {
        for corner in [*edge, crate::mesh::after(*edge), *other, crate::mesh::after(*other)] {
            let source = world.mesh.source[world.mesh.vertex(corner) as usize];
            world.follow(source);
        }
    }
}

/// After the last tear of a tick: pieces that came off are told, loose links are gathered.
pub(crate) fn settle(world: &mut World) {
    let mut pieces = core::mem::take(&mut world.scratch.pieces);
    core::mem::swap(&mut pieces.label, &mut pieces.old_label);
    let count = world.mesh.pieces(&mut pieces.label, &mut world.scratch.stack);
    if count > world.pieces {
        tell_pieces(world, &mut pieces, count);
    }
    world.pieces = count;
    world.scratch.pieces = pieces;
    world.gather();
}

/// One event for each piece that came off: of what was one, all but the largest part, in the order
/// of their first triangles.
fn tell_pieces(world: &mut World, pieces: &mut Pieces, count: u32) {
    pieces.size.clear();
    pieces.size.resize(count as usize, 0);
    pieces.stays.clear();
    pieces.stays.resize(world.pieces as usize, NONE);
    pieces.label.iter().for_each(|label| pieces.size[*label as usize] += 1);
    let size = |piece: u32| pieces.size[piece as usize];
    // A new piece is met first at its first triangle, so an equal size leaves the earlier one.
    let mut met = 0;
    for (label, old) in pieces.label.iter().zip(&pieces.old_label) {
        if *label == met {
            let stays = &mut pieces.stays[*old as usize];
            if *stays == NONE || size(met) > size(*stays) {
                *stays = met;
            }
            met += 1;
        }
    }
    let mut met = 0;
    for (at, (label, old)) in pieces.label.iter().zip(&pieces.old_label).enumerate() {
        if *label != met {
            continue;
        }
        met += 1;
        if pieces.stays[*old as usize] == *label {
            continue;
        }
        let place = world.particles.x.at(world.mesh.triangles[at][0] as usize);
        let mut event = Event::new(EventKind::PieceDetached, world.tick, place);
        (event.vertex, event.count) = (world.vertex(3 * at as u32), size(*label));
        world.events.push(event);
    }
}
