//! A cloth as bytes, and back: it goes on in the same bits.
//!
//! Layout: "MUSLINSV", format version (u32, little-endian), checksum of the rest (u64), then what
//! `Saved` holds in the postcard format.

use crate::cloth::Cloth;
use crate::cloth::build::Origin;
use crate::cloth::changes::History;
use crate::cloth::postcard;
use crate::cloth::view::Outputs;
use crate::error::{Error, Result};
use crate::math::columns::Columns;
use crate::math::float_env::with_float_env;
use crate::math::hasher::StateHasher;
use crate::mesh::seams::Seams;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{NONE, validate};
use crate::model::dynamic_links::LinkChanges;
use crate::model::material::Material;
use crate::model::plate_elements::PerKind;
use crate::model::tethers::TetherSet;
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::self_collide::surface::warm_start::WarmStart;
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::{AttachmentPose, Attachments, MAX_ATTACHMENTS};
use crate::state::colliders::{Colliders, MAX_COLLIDERS};
use crate::state::events::{Events, MAX_EVENTS};
use crate::state::grabs::{Grabs, MAX_GRABS};
use crate::state::mass_scales::MassScales;
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::{Pose, check_pose};
use crate::state::settings::Settings;
use crate::state::wind::Wind;
use glam::Vec3;
use serde::{Deserialize, Serialize};

const MAGIC: &[u8; 8] = b"MUSLINSV";
const FORMAT: u32 = 9;
const HEADER: usize = 20;

/// All that cannot be derived.
#[derive(Serialize, Deserialize)]
struct Saved<'a> {
    origin: Owned<'a, Origin>,
    settings: Owned<'a, Settings>,
    material: Owned<'a, Material>,
    wind: Owned<'a, Wind>,
    triangles: Owned<'a, Vec<[u32; 3]>>,
    sources: Owned<'a, Vec<u32>>,
    crossings: Owned<'a, Vec<CutSite>>,
    hems: Owned<'a, Vec<u8>>,
    seams: Owned<'a, Option<Seams>>,
    links: LinkChanges,
    /// What tears made of tethers; none where measuring gives the same.
    tethers: Vec<TetherSet>,
    folds: PerKind<Vec<f32>>,
    /// What folds gave way by; none if nothing did.
    wear: Vec<f32>,
    particles: Owned<'a, Particles>,
    mass_scales: Owned<'a, MassScales>,
    pins: Owned<'a, Pins>,
    attachments: Owned<'a, Attachments>,
    grabs: Owned<'a, Grabs>,
    anchors: Owned<'a, AnchorConstraints>,
    warm_start: Owned<'a, WarmStart>,
    is_tangled: bool,
    reference_pose: Pose,
    colliders: Owned<'a, Colliders>,
    events: Owned<'a, Events>,
    time: f64,
    tick: u32,
    reserve_reported: bool,
    tether_slack: f32,
    over_stretched: u32,
    over_stretch_reported: bool,
    sleep: SleepTimer,
    owed: f64,
    topology_revision: u32,
    state_revision: u32,
}

/// Borrowed to save, owned when restored.
type Owned<'a, T> = std::borrow::Cow<'a, T>;

impl Cloth {
    /// The cloth as bytes: everything, so that [`Cloth::restore`] gives one that goes on in the same
    /// bits. Handles of grabs, attachments and colliders hold for it too.
    pub fn save(&self) -> Vec<u8> {
        let world = &self.world;
        let is_torn = world.mesh.vertex_count() > world.mesh.original_count as usize;
        let saved = Saved {
            origin: Owned::Borrowed(&self.origin),
            settings: Owned::Borrowed(&world.settings),
            material: Owned::Borrowed(&world.material),
            wind: Owned::Borrowed(&world.wind),
            triangles: Owned::Borrowed(&world.mesh.triangles),
            sources: Owned::Borrowed(&world.mesh.source),
            crossings: Owned::Borrowed(&world.crossings),
            hems: Owned::Borrowed(&world.mesh.rest_borders),
            seams: Owned::Borrowed(&world.seams),
            links: world.constraints.link_changes(),
            tethers: if is_torn && !self.pins_changed { world.tethers.save() } else { Vec::new() },
            folds: world.folds.saved_angles(),
            wear: world.folds.hardening.saved().to_vec(),
            particles: Owned::Borrowed(&world.particles),
            mass_scales: Owned::Borrowed(&world.mass_scales),
            pins: Owned::Borrowed(&world.pins),
            attachments: Owned::Borrowed(&world.attachments),
            grabs: Owned::Borrowed(&world.grabs),
            anchors: Owned::Borrowed(&world.anchors),
            warm_start: Owned::Borrowed(&world.warm_start),
            is_tangled: world.is_tangled,
            reference_pose: world.reference_pose,
            colliders: Owned::Borrowed(&world.colliders),
            events: Owned::Borrowed(&world.events),
            time: world.time,
            tick: world.tick,
            reserve_reported: world.reserve_reported,
            tether_slack: world.tether_slack,
            over_stretched: world.over_stretched,
            over_stretch_reported: world.over_stretch_reported,
            sleep: world.sleep,
            owed: self.owed,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
        };
        let mut bytes = Vec::new();
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.extend_from_slice(&[0; 8]);
        // Writing to memory fails for no value that a cloth can hold.
        bytes = postcard::write(&saved, bytes).unwrap_or_default();
        let sum = checksum(&bytes[HEADER..]).to_le_bytes();
        bytes[HEADER - 8..HEADER].copy_from_slice(&sum);
        bytes
    }

    /// The cloth that [`Cloth::save`] turned into bytes, on this machine or any other.
    ///
    /// # Errors
    /// [`Error::BadSave`] if the bytes are not that, or not whole.
    pub fn restore(bytes: &[u8]) -> Result<Self> {
        let bad = |why| Error::BadSave { why };
        let header = bytes.get(..HEADER).ok_or(bad("it is too short"))?;
        if header[..8] != MAGIC[..] {
            return Err(bad("it does not begin with the mark of one"));
        }
        if header[8..12] != FORMAT.to_le_bytes() {
            return Err(bad("it was written by another version"));
        }
        let body = &bytes[HEADER..];
        if header[12..] != checksum(body).to_le_bytes() {
            return Err(bad("it was damaged"));
        }
        let saved: Saved<'_> = postcard::read(body).map_err(|_| bad("it cannot be read"))?;
        with_float_env(|| rebuild(saved))
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    let mut hasher = StateHasher::new(bytes.len() as u64);
    for chunk in bytes.chunks(4) {
        let mut word = [0; 4];
        word[..chunk.len()].copy_from_slice(chunk);
        hasher.write_u32(u32::from_le_bytes(word));
    }
    hasher.finish()
}

/// Makes the cloth anew from its descriptor, then tears it and moves it as it was. The bytes may
/// come from anywhere, so nothing in them is believed.
fn rebuild(saved: Saved<'_>) -> Result<Cloth> {
    let bad = || Error::BadSave { why: "its parts do not fit together" };
    let must = |fits: bool| if fits { Ok(()) } else { Err(bad()) };
    saved.origin.check()?;
    saved.settings.check()?;
    saved.material.check()?;
    saved.wind.check()?;
    let origin = saved.origin.into_owned();
    let (mut world, report) = origin.world()?;
    let capacity = world.capacity();
    let sources = saved.sources.into_owned();
    let triangles = saved.triangles.into_owned();
    let count = sources.len();
    must(count >= world.mesh.vertex_count() && count <= capacity)?;
    let woven = world.mesh.triangles.len();
    must(triangles.len() >= woven && triangles.len() <= world.triangle_capacity)?;
    for crossing in saved.crossings.iter() {
        let is_known = crossing.ends.iter().all(|end| (*end as usize) < world.rest.len());
        must(is_known && crossing.fraction > 0.0 && crossing.fraction < 1.0)?;
        world.rest.push(crossing.interpolate(|end| world.rest[end as usize]));
    }
    world.crossings = saved.crossings.into_owned();
    must(sources.iter().all(|site| (*site as usize) < world.rest.len()))?;
    must(sources[..world.mesh.vertex_count()].iter().copied().eq(0..world.mesh.original_count))?;
    let particles = saved.particles.into_owned();
    must(particles.is_consistent(count) && is_finite(&particles))?;
    must(
        (saved.time.is_finite() && saved.time >= 0.0)
            && (saved.owed.is_finite() && saved.owed >= 0.0),
    )?;

    let rest: Vec<Vec3> = sources.iter().map(|site| world.rest[*site as usize]).collect();
    let original_count = world.mesh.original_count;
    let mesh = validate::validated_mesh(triangles, &rest, capacity).map_err(|_| bad())?;
    must(mesh.corner_of.iter().skip(original_count as usize).all(|corner| *corner != NONE))?;
    let fresh = core::mem::replace(&mut world.mesh, mesh);
    world.mesh.original_count = original_count;
    world.mesh.source.copy_from_slice(&sources);
    must(saved.hems.len() == world.mesh.triangles.len())?;
    world.mesh.rest_borders = saved.hems.into_owned();
    must(match (saved.seams.into_owned(), &mut world.seams) {
        (Some(mut seams), Some(fresh)) => {
            let fits = seams.restore_checked(fresh, &world.mesh);
            *fresh = seams;
            fits
        }
        (None, None) => true,
        _ => false,
    })?;
    world.refresh_corner_areas(&fresh);
    world.particles = particles;
    must(saved.mass_scales.are_valid(count))?;
    world.mass_scales = saved.mass_scales.into_owned();
    (world.settings, world.material) = (saved.settings.into_owned(), saved.material.into_owned());
    world.wind = saved.wind.into_owned();
    world.check_self_distance(&world.settings)?;
    world.reserve(capacity);
    must(world.constraints.apply_changes(&world.mesh, &saved.links, &world.material))?;
    world.constraints.update_compliances(&world.material);
    (0..world.rest.len() as u32).for_each(|site| world.refresh_constraints_at(site));
    must(world.restore_folds(saved.folds) && world.restore_hardening(saved.wear))?;
    world.reserve_for_tears();
    world.rebuild_irregular_lists();
    must(saved.anchors.are_valid(count))?;
    world.anchors = saved.anchors.into_owned();
    world.reserve_anchor_scratch();
    must(saved.warm_start.are_sound(count))?;
    world.warm_start = saved.warm_start.into_owned();
    world.warm_start.reserve(count);
    world.is_tangled = saved.is_tangled;
    must(is_pose(&saved.reference_pose))?;
    world.reference_pose = saved.reference_pose;
    must(restore_attachments(&mut world, saved.attachments.into_owned()))?;
    restore_holds(&mut world, saved.pins.into_owned(), saved.grabs.into_owned(), bad)?;
    let mut colliders = saved.colliders.into_owned();
    must(colliders.capacity() == usize::from(MAX_COLLIDERS))?;
    for body in colliders.iter_mut() {
        body.restore()?;
    }
    world.colliders = colliders;
    world.reserve_contacts();
    let events = saved.events.into_owned();
    must(events.len() <= MAX_EVENTS)?;
    world.events = events;
    world.events.reserve();
    (world.time, world.tick, world.reserve_reported) =
        (saved.time, saved.tick, saved.reserve_reported);
    world.over_stretched = saved.over_stretched;
    world.over_stretch_reported = saved.over_stretch_reported;
    must(saved.tether_slack >= 0.0)?;
    world.pieces =
        world.mesh.label_pieces(&mut world.scratch.pieces.label, &mut world.scratch.piece_stack);
    world.rebuild_crack_tips();
    world.compute_masses();
    world.rebuild_tethers();
    let (particles, triangles) = (world.particles.len(), world.mesh.triangles.len());
    let is_measured = saved.tethers.is_empty();
    must(is_measured || world.tethers.restore(&saved.tethers, particles, triangles))?;
    world.rebuild_pin_order();
    world.tether_slack = saved.tether_slack;
    world.sleep = saved.sleep;
    let mut outputs = Outputs::new(&world);
    outputs.set_uvs(&origin);
    outputs.follow_topology(&world);
    outputs.follow(&world);
    Ok(Cloth {
        origin,
        world,
        outputs,
        report,
        owed: saved.owed,
        pins_changed: false,
        topology_revision: saved.topology_revision,
        state_revision: saved.state_revision,
        history: History::new(),
    })
}

fn is_pose(pose: &Pose) -> bool {
    check_pose(pose.position, pose.rotation, ["position", "rotation"]).is_ok()
}

/// Whether they are such as a cloth can have.
fn restore_attachments(world: &mut World, attachments: Attachments) -> bool {
    let is_sound = |carrier: &AttachmentPose| is_pose(&carrier.last) && is_pose(&carrier.next);
    let are_sound = attachments.iter().all(is_sound);
    let fits = are_sound && attachments.capacity() == usize::from(MAX_ATTACHMENTS);
    world.attachments = attachments;
    fits
}

fn restore_holds(
    world: &mut World,
    pins: Pins,
    grabs: Grabs,
    bad: impl Fn() -> Error,
) -> Result<()> {
    let count = world.particles.len();
    let is_carried_well =
        |carrier| carrier == 0 || world.attachments.get(carrier, "attachment").is_ok();
    let pins_fit = pins.iter().all(|pin| {
        (pin.particle as usize) < count && pin.is_valid() && is_carried_well(pin.attachment)
    });
    let grabs_fit =
        grabs.iter().all(|held| (held.particle as usize) < count && held.target.is_finite());
    if !(pins_fit && pins.is_sorted() && grabs_fit && grabs.capacity() == usize::from(MAX_GRABS)) {
        return Err(bad());
    }
    (world.pins, world.grabs) = (pins, grabs);
    world.pins.reserve(world.capacity());
    world.reserve_effective_mass();
    Ok(())
}

fn is_finite(particles: &Particles) -> bool {
    let finite = |columns: &Columns| columns.iter().all(|v| v.is_finite());
    [
        &particles.x,
        &particles.displacement,
        &particles.v,
        &particles.v_extrapolated,
        &particles.x_prev_tick,
    ]
    .into_iter()
    .all(finite)
}
