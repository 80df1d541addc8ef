//! Save and restore: a cloth as bytes, from which it continues with the same bits.
//!
//! ```text
//! offset  size
//! 0       8     signature "MUSLINSV"
//! 8       4     format version, u32 little-endian
//! 12      8     checksum of the body, u64 little-endian
//! 20      …     body: `SaveData` in the postcard format
//! ```
//!
//! Only state that cannot be derived is saved. Restoring builds the rest state from the descriptor,
//! applies tears and cuts, and computes everything else from them.
//!
//! Reads or writes all of `Cloth`.
//! Invariant: bytes may come from anywhere, so every value is checked before it is used; bytes that
//! fail a check give [`Error::BadSave`] and never a panic.

use crate::cloth::Cloth;
use crate::cloth::build::ClothDesc;
use crate::cloth::change_history::ChangeHistory;
use crate::cloth::outputs::Outputs;
use crate::cloth::postcard;
use crate::cloth::ray_tree::RayTree;
use crate::cloth::tracked_world::TrackedWorld;
use crate::error::{Error, Result};
use crate::math::columns::Columns;
use crate::math::float_env::with_float_env;
use crate::math::hasher::StateHasher;
use crate::math::shared::Shared;
use crate::mesh::seams::Seams;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{NONE, validate};
use crate::model::dynamic_links::LinkChanges;
use crate::model::material::Material;
use crate::model::plate_elements::PerKind;
use crate::model::tethers::TetherSet;
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::self_collide::contact_forces::WarmStart;
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::{AttachmentPose, Attachments, MAX_ATTACHMENTS};
use crate::state::colliders::{Colliders, MAX_COLLIDERS};
use crate::state::events::{Events, MAX_EVENTS};
use crate::state::grabs::{Grabs, MAX_GRABS};
use crate::state::mass_scales::MassScales;
use crate::state::origin::is_valid_origin;
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::{Pose, check_pose};
use crate::state::settings::Settings;
use crate::state::sewing::Sewing;
use crate::state::violations::Violations;
use crate::state::wind::Wind;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Signature at the start of a save.
const MAGIC: &[u8; 8] = b"MUSLINSV";
/// Version of the format; a change of `SaveData` raises it.
const FORMAT: u32 = 16;
/// Bytes before the body.
const HEADER: usize = 20;

/// All state that cannot be derived from other state: borrowed when saving, owned when restoring.
#[derive(Serialize, Deserialize)]
struct SaveData<'a> {
    desc: Cow<'a, ClothDesc>,
    settings: Cow<'a, Settings>,
    material: Cow<'a, Material>,
    /// The maps that are set, and their scales.
    maps: (u32, Vec<f32>),
    wind: Cow<'a, Wind>,
    triangles: Cow<'a, [[u32; 3]]>,
    sources: Cow<'a, [u32]>,
    crossings: Cow<'a, [CutSite]>,
    rest_borders: Cow<'a, [u8]>,
    seams: Cow<'a, Option<Seams>>,
    links: LinkChanges,
    /// Tethers as tears left them; empty if measuring gives the same.
    tethers: Vec<TetherSet>,
    folds: PerKind<Vec<f32>>,
    /// Accumulated yield of the folds; empty if nothing has yielded.
    hardening: Vec<f32>,
    particles: Cow<'a, Particles>,
    mass_scales: Cow<'a, MassScales>,
    pins: Cow<'a, Pins>,
    attachments: Cow<'a, Attachments>,
    grabs: Cow<'a, Grabs>,
    anchors: Cow<'a, AnchorConstraints>,
    sewing: Cow<'a, Sewing>,
    warm_start: Cow<'a, WarmStart>,
    is_tangled: bool,
    reference_pose: Pose,
    origin: Vec3,
    colliders: Cow<'a, Colliders>,
    events: Cow<'a, Events>,
    time: f64,
    tick: u32,
    reserve_reported: bool,
    tether_slack: f32,
    violations: Violations,
    sleep: SleepTimer,
    substeps: u32,
    stiffness_step: f32,
    has_no_history: bool,
    backlog: f64,
    topology_revision: u32,
    state_revision: u32,
}

impl Cloth {
    /// Returns the complete state of the cloth as bytes, from which [`Cloth::restore`] makes a
    /// cloth that continues with the same bits.
    ///
    /// The bytes are the same on every platform. Handles of grabs, attachments and colliders are
    /// valid for the restored cloth too. The number of threads, the clock and the topology history
    /// are not saved.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// cloth.step(30);
    /// let mut copy = Cloth::restore(&cloth.save())?;
    /// cloth.step(30);
    /// copy.step(30);
    /// assert_eq!(copy.state_hash(), cloth.state_hash());
    /// # Ok::<(), muslin::Error>(())
    /// ```
    pub fn save(&self) -> Vec<u8> {
        let world = &self.world;
        let is_torn = world.mesh.vertex_count() > world.mesh.original_count as usize;
        let saved = SaveData {
            desc: Cow::Borrowed(&self.desc),
            settings: Cow::Borrowed(&world.settings),
            material: Cow::Borrowed(&world.material),
            maps: world.maps.saved(),
            wind: Cow::Borrowed(&world.wind),
            triangles: Cow::Borrowed(&world.mesh.triangles),
            sources: Cow::Borrowed(&world.mesh.source),
            crossings: Cow::Borrowed(&world.cut_sites),
            rest_borders: Cow::Borrowed(&world.mesh.rest_borders),
            seams: Cow::Borrowed(&world.seams),
            links: world.constraints.link_changes(),
            tethers: if is_torn && !self.pins_changed { world.tethers.save() } else { Vec::new() },
            folds: world.folds.saved_angles(),
            hardening: world.folds.hardening.saved().to_vec(),
            particles: Cow::Borrowed(&world.particles),
            mass_scales: Cow::Borrowed(&world.mass_scales),
            pins: Cow::Borrowed(&world.pins),
            attachments: Cow::Borrowed(&world.attachments),
            grabs: Cow::Borrowed(&world.grabs),
            anchors: Cow::Borrowed(&world.anchors),
            sewing: Cow::Borrowed(&world.sewing),
            warm_start: Cow::Borrowed(&world.warm_start),
            is_tangled: world.is_tangled,
            reference_pose: world.reference_pose,
            origin: world.origin,
            colliders: Cow::Borrowed(&world.colliders),
            events: Cow::Borrowed(&world.events),
            time: world.clock.time,
            tick: world.clock.tick,
            reserve_reported: world.reserve_reported,
            tether_slack: world.tether_slack,
            violations: world.violations,
            sleep: world.sleep,
            substeps: world.substeps,
            stiffness_step: world.stiffness_step,
            has_no_history: world.has_no_history,
            backlog: world.clock.backlog,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
        };
        let mut bytes = Vec::new();
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.extend_from_slice(&[0; 8]);
        bytes = postcard::write(&saved, bytes);
        let sum = checksum(&bytes[HEADER..]).to_le_bytes();
        bytes[HEADER - 8..HEADER].copy_from_slice(&sum);
        bytes
    }

    /// Makes a cloth from bytes of [`Cloth::save`], which may have been written on another
    /// platform.
    ///
    /// Untrusted bytes are safe: they give a valid cloth or an error.
    ///
    /// # Errors
    /// [`Error::BadSave`] if the bytes are not a save, come from another format version, or are
    /// damaged; an error of the descriptor, settings, material or wind if a saved value breaks its
    /// rule.
    pub fn restore(bytes: &[u8]) -> Result<Self> {
        let bad = |why| Error::BadSave { why };
        let header = bytes.get(..HEADER).ok_or(bad("the data is too short"))?;
        if header[..8] != MAGIC[..] {
            return Err(bad("the data does not start with the Muslin signature"));
        }
        if header[8..12] != FORMAT.to_le_bytes() {
            return Err(bad("the data was written in another format version"));
        }
        let body = &bytes[HEADER..];
        if header[12..] != checksum(body).to_le_bytes() {
            return Err(bad("the data is damaged (its checksum does not match)"));
        }
        let saved: SaveData<'_> = postcard::read(body).ok_or(bad("the data cannot be decoded"))?;
        with_float_env(|| restore_from(saved))
    }
}

/// Returns the checksum of the body.
fn checksum(bytes: &[u8]) -> u64 {
    let mut hasher = StateHasher::new(bytes.len() as u64);
    for chunk in bytes.chunks(4) {
        let mut word = [0; 4];
        word[..chunk.len()].copy_from_slice(chunk);
        hasher.write_u32(u32::from_le_bytes(word));
    }
    hasher.finish()
}

/// Builds the rest state from the descriptor, then applies the saved topology and state. The bytes
/// may come from anywhere, so every value is checked.
fn restore_from(saved: SaveData<'_>) -> Result<Cloth> {
    let bad = || Error::BadSave { why: "the decoded parts are inconsistent" };
    let require = |holds: bool| if holds { Ok(()) } else { Err(bad()) };
    saved.desc.check()?;
    saved.settings.check()?;
    saved.material.check()?;
    saved.wind.check()?;
    let desc = saved.desc.into_owned();
    let (mut world, report) = desc.build_world()?;
    let capacity = world.capacity();
    let sources = saved.sources.into_owned();
    let triangles = saved.triangles.into_owned();
    let count = sources.len();
    require(count >= world.mesh.vertex_count() && count <= capacity)?;
    let rest_triangles = world.mesh.triangles.len();
    require(triangles.len() >= rest_triangles && triangles.len() <= world.triangle_capacity)?;
    for crossing in saved.crossings.iter() {
        let are_known = crossing.ends.iter().all(|end| (*end as usize) < world.rest.len());
        require(are_known && crossing.fraction > 0.0 && crossing.fraction < 1.0)?;
        let at_crossing = crossing.interpolate(|end| world.rest[end as usize]);
        world.rest.push(at_crossing);
    }
    world.cut_sites = saved.crossings.into_owned();
    require(sources.iter().all(|rest| (*rest as usize) < world.rest.len()))?;
    require(sources[..world.mesh.vertex_count()].iter().copied().eq(0..world.mesh.original_count))?;
    let particles = saved.particles.into_owned();
    require(particles.is_consistent(count) && is_finite(&particles))?;
    require(
        (saved.time.is_finite() && saved.time >= 0.0)
            && (saved.backlog.is_finite() && saved.backlog >= 0.0),
    )?;

    let rest: Vec<Vec3> = sources.iter().map(|rest| world.rest[*rest as usize]).collect();
    let original_count = world.mesh.original_count;
    let mesh = validate::validated_mesh(triangles, &rest, capacity).map_err(|_| bad())?;
    require(mesh.corner_of.iter().skip(original_count as usize).all(|corner| *corner != NONE))?;
    let is_torn = count > original_count as usize || mesh.triangles.len() > rest_triangles;
    let has_tear_reserve = saved.settings.tearing || is_torn;
    if has_tear_reserve {
        world.constraints.index_links_by_site(&world.mesh);
    }
    let rest_mesh = core::mem::replace(&mut world.mesh, Shared::new(mesh));
    world.mesh.original_count = original_count;
    world.mesh.source.copy_from_slice(&sources);
    require(saved.rest_borders.len() == world.mesh.triangles.len())?;
    world.mesh.rest_borders = saved.rest_borders.into_owned();
    require(match (saved.seams.into_owned(), &mut world.seams) {
        (Some(mut seams), Some(fresh)) => {
            let fits = seams.restore_checked(fresh, &world.mesh);
            *fresh = seams;
            fits
        }
        (None, None) => true,
        _ => false,
    })?;
    world.refresh_corner_areas(&rest_mesh);
    world.particles = particles;
    require(saved.mass_scales.are_valid(count))?;
    world.mass_scales = saved.mass_scales.into_owned();
    (world.settings, world.material) = (saved.settings.into_owned(), saved.material.into_owned());
    require(world.maps.restore(saved.maps, count))?;
    world.wind = saved.wind.into_owned();
    require((1..=Settings::MAX_SUBSTEPS).contains(&saved.substeps))?;
    world.substeps = saved.substeps;
    world.check_self_distance(&world.settings)?;
    world.has_tear_reserve = has_tear_reserve;
    world.reserve();
    let material = (&world.material, &world.maps);
    require(world.constraints.apply_changes(&world.mesh, &saved.links, material))?;
    (0..world.rest.len() as u32).for_each(|rest| world.refresh_constraints_at(rest));
    world.constraints.update_compliances(&world.material, &world.maps);
    require(world.restore_folds(saved.folds) && world.restore_hardening(saved.hardening))?;
    world.reserve_after_cut();
    world.rebuild_irregular_lists();
    require(saved.anchors.are_valid(count))?;
    world.anchors = saved.anchors.into_owned();
    world.reserve_anchor_scratch();
    saved.sewing.check_feature()?;
    require(saved.sewing.is_valid(count))?;
    world.sewing = saved.sewing.into_owned();
    world.sewing.rebuild();
    require(saved.warm_start.is_valid(count))?;
    world.warm_start = saved.warm_start.into_owned();
    world.warm_start.reserve(count);
    world.is_tangled = saved.is_tangled;
    require(is_valid_pose(&saved.reference_pose))?;
    world.reference_pose = saved.reference_pose;
    require(is_valid_origin(saved.origin))?;
    world.origin = saved.origin;
    require(restore_attachments(&mut world, saved.attachments.into_owned()))?;
    restore_pins_and_grabs(&mut world, saved.pins.into_owned(), saved.grabs.into_owned(), bad)?;
    let mut colliders = saved.colliders.into_owned();
    require(colliders.is_within(MAX_COLLIDERS))?;
    for body in colliders.iter_mut() {
        body.restore()?;
    }
    world.colliders = colliders;
    world.reserve_contacts();
    let events = saved.events.into_owned();
    require(events.len() <= MAX_EVENTS)?;
    world.events = events;
    world.reserve_pins_and_events();
    (world.clock.time, world.clock.tick, world.clock.backlog) =
        (saved.time, saved.tick, saved.backlog);
    world.reserve_reported = saved.reserve_reported;
    world.violations = saved.violations;
    require(saved.tether_slack >= 0.0)?;
    world.label_pieces();
    world.rebuild_crack_tips();
    world.compute_masses();
    world.rebuild_tethers();
    let (particles, triangles) = (world.particles.len(), world.mesh.triangles.len());
    let are_rebuilt = saved.tethers.is_empty();
    require(are_rebuilt || world.tethers.restore(&saved.tethers, particles, triangles))?;
    world.rebuild_pin_order();
    world.tether_slack = saved.tether_slack;
    world.sleep = saved.sleep;
    require(saved.stiffness_step >= 0.0 && saved.stiffness_step <= 1.0)?;
    world.stiffness_step = saved.stiffness_step;
    world.has_no_history = saved.has_no_history;
    let outputs = Outputs::new(&world, &desc);
    let history = ChangeHistory::new(world.has_tear_reserve);
    Ok(Cloth {
        desc: Shared::new(desc),
        world: TrackedWorld::new(world),
        outputs,
        report,
        pins_changed: false,
        topology_revision: saved.topology_revision,
        state_revision: saved.state_revision,
        history,
        ray_tree: RayTree::default(),
    })
}

/// Returns whether a pose is finite with a unit quaternion.
fn is_valid_pose(pose: &Pose) -> bool {
    check_pose(pose.position, pose.rotation, ["position", "rotation"]).is_ok()
}

/// Sets the attachments, and returns whether they are valid.
fn restore_attachments(world: &mut World, attachments: Attachments) -> bool {
    let is_sound = |motion: &AttachmentPose| {
        [&motion.last, &motion.next].into_iter().all(is_valid_pose)
            && is_valid_origin(motion.center)
    };
    let are_sound = attachments.iter().all(is_sound);
    let fits = are_sound && attachments.is_within(MAX_ATTACHMENTS);
    world.attachments = attachments;
    fits
}

/// Sets pins and grabs if they are valid; calls `bad` for the error otherwise.
fn restore_pins_and_grabs(
    world: &mut World,
    pins: Pins,
    grabs: Grabs,
    bad: impl Fn() -> Error,
) -> Result<()> {
    let count = world.particles.len();
    let has_live_attachment =
        |attachment| attachment == 0 || world.attachments.get(attachment, "attachment").is_ok();
    let pins_fit = pins.iter().all(|pin| {
        (pin.particle as usize) < count && pin.is_valid() && has_live_attachment(pin.attachment)
    });
    let grabs_fit =
        grabs.iter().all(|grab| (grab.particle as usize) < count && grab.target.is_finite());
    if !(pins_fit && pins.is_sorted() && grabs_fit && grabs.is_within(MAX_GRABS)) {
        return Err(bad());
    }
    (world.pins, world.grabs) = (pins, grabs);
    world.grabs.reserve();
    world.reserve_effective_mass();
    Ok(())
}

/// Returns whether all positions and velocities are finite.
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
