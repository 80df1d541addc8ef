//! Stage `SelfContacts`: the surface of a cloth keeps from itself, a material's thickness apart.
//!
//! Vertices meet triangles and edges meet edges. In each substep those that may meet are found (`sift`) by how
//! they move against each other (`motion`), and get a direction that tells their sides apart (`contacts`); they
//! push and rub (`push`); and after all else moved, none gets past the other (`fence`). All of it follows from
//! where particles are alone, in the order of the mesh.

mod closest_lanes;
mod cluster_bvh;
mod cluster_pairs;
mod contact;
mod contact_graph;
mod contact_solver;
mod detection;
mod free_motion;
mod narrow_phase;
mod non_crossing;
mod normal_cones;
mod pair_cache;
mod pair_store;
mod rest_gap;
mod separation_test;
mod speculative;
pub(crate) mod split_separation;
mod swept_aabb;
mod swept_particles;
mod tick_bounds;
mod untangle;
pub(crate) mod warm_start;

use crate::math::wide4::Float4;
use crate::math::{max, min};
use crate::solver::integrate::rigid_motion::{FreeParticles, RigidMotion};
use crate::solver::self_collide::particle_pairs;
use crate::solver::self_collide::surface::cluster_bvh::Patches;
use crate::solver::self_collide::surface::contact::Contact;
use crate::solver::self_collide::surface::contact_graph::Around;
use crate::solver::self_collide::surface::contact_solver::{Push, Weight};
use crate::solver::self_collide::surface::detection::{Found, Picked, Sift};
use crate::solver::self_collide::surface::narrow_phase::Near;
use crate::solver::self_collide::surface::rest_gap::RestGap;
use crate::solver::self_collide::surface::separation_test::Candidates;
use crate::solver::self_collide::surface::speculative::Distant;
use crate::solver::self_collide::surface::split_separation::Slits;
use crate::solver::self_collide::surface::swept_particles::Motion;
use crate::solver::self_collide::surface::tick_bounds::Reach;
use crate::solver::self_collide::surface::untangle::Tangles;
use crate::solver::self_collide::surface::warm_start::Finder;
use crate::solver::world::World;
use crate::state::settings::SelfCollision;

/// Gap of a cloth without thickness, in mean rest lengths; and the most that any has.
const THIN: f32 = 0.005;
pub(crate) const THICK: f32 = 0.5;

/// How far particles may stray until patches that may meet are listed anew [mean rest lengths].
const FAR: f32 = 0.2;

/// How often those are looked at again at most that strayed.
const LOOKS: u32 = 8;

/// The layers of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceCollision {
    patches: Patches,
    motion: Motion,
    weights: Vec<Weight>,
    /// How particles move, in some unit.
    ways: Vec<Float4>,
    far: Reach,
    /// Pairs of patches that may meet in this substep.
    pairs: Vec<u32>,
    /// Pairs that may meet in this substep, and those of them that strayed.
    picked: Picked,
    strays: Candidates,
    /// Pairs that are near enough to push, by their kind.
    near: [Near; 2],
    contacts: Vec<Contact>,
    /// Pairs that may meet but are too far from each other to push.
    distant: Vec<Distant>,
    /// A bit for each of those that is apart.
    apart: Vec<u8>,
    is_found: bool,
    /// What pushes in this substep.
    active: Vec<Push>,
    around: Around,
    /// What the fence has in hand.
    frozen: Vec<u32>,
    open: Vec<u32>,
    finder: Finder,
    /// The piece that each site was part of before anything tore.
    pieces: Vec<u32>,
    slits: Slits,
    tangles: Tangles,
    /// Whether no substep of the tick began yet.
    is_new_tick: bool,
    gap: f32,
}

impl SurfaceCollision {
    fn new(world: &World) -> Self {
        let (capacity, count) = (world.capacity(), world.particles.len());
        let pieces = particle_pairs::pieces(&world.mesh, world.rest.len());
        Self {
            patches: Patches::new(&world.mesh, &world.rest, &pieces, capacity),
            motion: Motion::new(capacity),
            weights: Vec::with_capacity(capacity),
            ways: Vec::with_capacity(capacity),
            far: Reach::new(capacity),
            pairs: Vec::with_capacity(8 * count),
            picked: Picked::new(count),
            strays: detection::room_for_strays(),
            near: [(); 2].map(|()| Near::new(8 * count)),
            contacts: Vec::with_capacity(24 * count),
            distant: Vec::with_capacity(16 * count),
            apart: Vec::with_capacity(2 * count),
            is_found: false,
            active: Vec::with_capacity(24 * count),
            around: Around::new(capacity, 24 * count),
            frozen: Vec::with_capacity(capacity),
            open: Vec::with_capacity(24 * count),
            finder: Finder::new(count),
            pieces,
            slits: Slits::new(capacity),
            tangles: Tangles::default(),
            is_new_tick: false,
            gap: 0.0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let words = self.open.capacity()
            + self.pieces.capacity()
            + self.frozen.capacity()
            + self.pairs.capacity();
        self.patches.bytes()
            + self.motion.bytes()
            + self.far.bytes()
            + self.slits.bytes()
            + self.tangles.bytes()
            + self.around.bytes()
            + self.strays.bytes()
            + self.picked.bytes()
            + self.near.iter().map(Near::bytes).sum::<usize>()
            + size_of::<Weight>() * self.weights.capacity()
            + size_of::<Float4>() * self.ways.capacity()
            + size_of::<Contact>() * self.contacts.capacity()
            + size_of::<Push>() * self.active.capacity()
            + size_of::<Distant>() * self.distant.capacity()
            + self.apart.capacity()
            + self.finder.bytes()
            + size_of::<u32>() * words
    }

    /// Finds what may meet in this substep, as particles are now, with so many substeps of the tick to go.
    fn find(&mut self, world: &World, substeps: u32) {
        let Self {
            motion, far, patches, pieces, pairs, picked, near, contacts, distant, gap, ..
        } = self;
        motion.look_ahead(world.mean_edge, *gap);
        let is_known = far.is_known;
        if is_known {
            far.follow(motion);
        }
        if !is_known || !far.holds(motion) {
            far.look_ahead(motion, substeps, world.mean_edge * FAR);
            patches.list(far, *gap);
        }
        if !is_known {
            patches.forget_runs();
        }
        let rest_gap = RestGap { world, pieces, gap: *gap };
        let mut found = Found { contacts, distant };
        Sift { rest_gap, patches, motion }.find(pairs, picked, near, &mut found);
        self.is_found = true;
        self.find_tangles(world);
    }

    /// Finds where the surface goes through itself, and lets be what would keep it so.
    fn find_tangles(&mut self, world: &World) {
        let Self { motion, patches, pairs, contacts, distant, tangles, gap, .. } = self;
        let (mesh, start) = (&world.mesh, &motion.start);
        tangles.clear();
        let looks = core::mem::take(&mut self.is_new_tick);
        if world.is_tangled || looks && tangles.look_round(mesh, patches, pairs, start, world.tick)
        {
            let sizes = [*gap, world.mean_edge, world.settings.scheme().h];
            tangles.find(mesh, (patches, pairs), start, sizes);
            tangles.let_be(contacts, distant);
        }
    }

    /// Adds to the distant what those may meet that are not where they were thought to be; says whether all are by now.
    fn find_strays(&mut self, world: &World, may_go_back: bool) -> bool {
        let Self { motion, far, patches, pieces, pairs, strays, distant, gap, .. } = self;
        let [any, are_within] = motion.look_again(world.mean_edge, *gap, may_go_back);
        if !any {
            return are_within;
        }
        let all = 0..motion.now.len() as u32;
        let strayed = all.filter(|at| motion.strays(*at));
        if !far.holds(motion) {
            strayed.for_each(|at| far.widen(motion, at));
            patches.list(far, *gap);
        }
        let rest_gap = RestGap { world, pieces, gap: *gap };
        Sift { rest_gap, patches, motion }.find_strays(pairs, strays, distant);
        are_within
    }

    /// Nothing crosses any more; says whether anything moved. Of a cloth that nothing holds or touches, the momentum
    /// stays.
    fn hold(&mut self, world: &World) -> bool {
        let went_back = self.fence(world);
        let now = &mut self.motion.now;
        if went_back
            && world.scratch.contacts.collider_contacts.is_empty()
            && !crate::solver::particle_stage::interleaved::is_any_held(now)
        {
            let w = now.iter().map(|spot| spot[3]);
            let before =
                crate::solver::particle_stage::interleaved::middle(world.particles.x.iter().zip(w));
            let after = crate::solver::particle_stage::interleaved::middle(
                now.iter().map(|spot| (crate::math::wide4::xyz(spot), spot[3])),
            );
            now.iter_mut().for_each(|spot| {
                crate::solver::particle_stage::interleaved::shift(spot, before - after)
            });
        }
        self.around.was_stirred
    }

    /// Says whether anything went back to where it was.
    fn fence(&mut self, world: &World) -> bool {
        if !self.is_found {
            self.find(world, 1);
        }
        let (mut may_go_back, mut went_back) = (false, false);
        self.around.begin(self.motion.now.len());
        let mut known = 0;
        for look in 0..=LOOKS {
            let is_last = look == LOOKS;
            let were_within = self.find_strays(world, may_go_back || is_last);
            let Self {
                contacts, distant, apart, motion, frozen, open, around, tangles, gap, ..
            } = self;
            tangles.let_be(&mut [], distant);
            let all = may_go_back || is_last;
            speculative::call(world.level, distant, apart, all, motion, *gap, contacts);
            around.call_from(known, contacts);
            around.rest();
            if !is_last {
                non_crossing::let_go(world.level, contacts, known, &motion.now, around);
            }
            known = contacts.len();
            let is_done = !is_last && non_crossing::draw_apart(contacts, motion, around, open);
            if !is_done && (may_go_back || is_last) {
                non_crossing::go_back(contacts, motion, around, frozen);
                went_back = true;
            }
            let are_as_thought = || {
                if were_within {
                    motion.are_as_thought(around.stirred().iter().copied())
                } else {
                    motion.are_as_thought(0..motion.now.len() as u32)
                }
            };
            let are_apart = || speculative::are_apart(world.level, distant, &motion.now, around);
            if (is_done || may_go_back) && are_as_thought() && are_apart() {
                break;
            }
            // Whoever goes back must not get in the way of somebody else.
            may_go_back |= !is_done;
        }
        went_back
    }
}

impl World {
    /// Makes what the surface needs that keeps from itself, or drops it, as settings say.
    pub fn see_to_layers(&mut self) {
        let is_wanted = self.settings.self_collision == SelfCollision::Surface;
        self.surface_collision = is_wanted.then(|| Box::new(SurfaceCollision::new(self)));
        if is_wanted {
            self.warm_start.reserve(self.particles.len());
        } else {
            self.warm_start.clear();
        }
    }

    /// How far layers keep apart [m].
    fn layer_gap(&self) -> f32 {
        let own = self.settings.self_distance;
        let gap = if own > 0.0 { own } else { self.material.thickness };
        // Not `clamp`: what that would say of limits that cannot be takes 18 kB of a page.
        min(max(gap, THIN * self.mean_edge), THICK * self.mean_edge)
    }
}

/// A tick begins, or its last part after tears, with particles where they are.
pub(crate) fn begin(world: &mut World) {
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    let gap = world.layer_gap();
    layers.far.is_known &= gap == layers.gap;
    layers.gap = gap;
    let p = &world.particles;
    let motion = &mut layers.motion;
    let is_same = motion.start.len() == p.len();
    if !is_same {
        layers.patches.follow(&world.mesh);
    }
    crate::solver::particle_stage::interleaved::gather(&mut motion.start, &p.x, &p.w);
    layers.is_found = false;
    layers.is_new_tick = true;
    layers.far.is_known &= is_same;
    world.surface_collision = Some(layers);
}

/// Finds what may meet in a substep.
pub(crate) fn pair(world: &mut World) {
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    crate::solver::particle_stage::interleaved::gather(
        &mut layers.motion.now,
        &world.particles.x,
        &world.particles.w,
    );
    layers.weights.clear();
    layers.weights.extend(world.particles.w.iter().map(|w| Weight { w: *w, yields: 1.0 }));
    for touch in &world.scratch.contacts.collider_contacts {
        let at = touch.particle as usize;
        layers.motion.now[at][3] = world.particles.w[at] * contact_solver::BORNE;
        layers.weights[at].yields = contact_solver::BORNE;
    }
    layers.find(world, world.settings.substeps);
    world.is_tangled = !layers.tangles.is_empty();
    world.surface_collision = Some(layers);
}

/// SurfaceCollision push and rub, once and in a fixed order.
pub(crate) fn solve(world: &mut World) {
    let (scheme, friction) = (world.settings.scheme(), world.material.friction);
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    let SurfaceCollision { contacts, active, finder, motion, weights, ways, tangles, .. } =
        &mut *layers;
    let Motion { start, now, .. } = &mut *motion;
    contact_solver::list(contacts, active, weights, start, now);
    let floor = if active.is_empty() { None } else { free_motion::floor(world) };
    if floor.is_some() {
        ways.clone_from(now);
    }
    let (loads, force) =
        (&mut world.warm_start, 1.0 / (scheme.velocity_step * scheme.velocity_step));
    contact_solver::solve(
        world.level,
        contacts,
        active,
        (loads, finder),
        start,
        now,
        friction,
        force,
    );
    if let Some(floor) = floor {
        free_motion::keep(world, floor, ways, now);
    }
    contact_solver::spread(contacts, active, now, &mut world.scratch.predicted, scheme.h);
    tangles.draw_out(motion, &mut world.scratch.predicted);
    crate::solver::particle_stage::interleaved::scatter(&motion.now, &mut world.particles.x);
    world.surface_collision = Some(layers);
}

/// Finds where others moved particles to since a tick or a part of it began.
fn follow(world: &mut World) {
    if let Some(layers) = &mut world.surface_collision {
        crate::solver::particle_stage::interleaved::gather(
            &mut layers.motion.now,
            &world.particles.x,
            &world.particles.w,
        );
    }
}

/// After all else moved, nothing crosses.
pub(crate) fn hold(world: &mut World) {
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    if layers.hold(world) {
        crate::solver::particle_stage::interleaved::scatter(
            &layers.motion.now,
            &mut world.particles.x,
        );
    }
    // The next substep starts from here; where it leads to, it finds anew.
    let Motion { start, now, .. } = &mut layers.motion;
    core::mem::swap(start, now);
    world.surface_collision = Some(layers);
}

/// Once more at the end of a tick, after other stages moved particles; what leashes pulled stays where that is.
pub(crate) fn hold_at_last(world: &mut World) {
    follow(world);
    let pulled = &world.scratch.anchor_moved;
    if let Some(layers) = &mut world.surface_collision {
        pulled.iter().for_each(|i| layers.motion.now[*i as usize][3] = 0.0);
    }
    hold(world);
}

/// After velocities were derived, those of layers that hit each other agree, and those of what pushes each other
/// come nearer.
pub(crate) fn calm(world: &mut World) {
    let h = world.settings.scheme().h;
    let speed = world.settings.gravity.length() * h;
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    let SurfaceCollision { contacts, active, open, weights, motion, ways, tangles, .. } =
        &mut *layers;
    let is_free = world.scratch.contacts.collider_contacts.is_empty()
        && !crate::solver::particle_stage::interleaved::is_any_held(&motion.start);
    let p = &mut world.particles;
    contact_solver::find_hits(contacts, active, &p.v, speed, open);
    for columns in [&mut p.v, &mut p.v_extrapolated, &mut p.displacement] {
        contact_solver::calm(contacts, active, open, columns);
        tangles.calm(weights, columns);
        if !active.is_empty() {
            let particles =
                FreeParticles { x: p.x.all(), displacement: columns.all(), mass: &p.mass, w: &p.w };
            let whole = RigidMotion::of_free(world.level, particles);
            crate::solver::particle_stage::interleaved::gather_against(&whole, &p.x, columns, ways);
            contact_solver::soothe(contacts, active, weights, ways, h, !is_free);
            crate::solver::particle_stage::interleaved::scatter_along(&whole, &p.x, ways, columns);
        }
    }
    world.surface_collision = Some(layers);
}
