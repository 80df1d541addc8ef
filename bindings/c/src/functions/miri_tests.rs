//! Calls of every function that dereferences pointers, with unaligned lists and with buffers that
//! end exactly where they must, for Miri (`cargo xtask miri`).

use super::anchors::*;
use super::attachments::*;
use super::colliders::*;
use super::create::*;
use super::init::*;
use super::library::*;
use super::parameters::*;
use super::particles::*;
use super::picking::*;
use super::pins::*;
use super::queries::*;
use super::save::*;
use super::time::*;
use super::topology::*;
use super::vertex_buffers::*;
use super::views::*;
use crate::status::MuslinStatus;
use crate::types::changes::MuslinChanges;
use crate::types::collider::MuslinColliderDesc;
use crate::types::event::MuslinEvent;
use crate::types::grid::MuslinGridDesc;
use crate::types::hit::MuslinHit;
use crate::types::material::MuslinMaterial;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::settings::MuslinSettings;
use crate::types::stats::MuslinStats;
use crate::types::stream::*;
use crate::types::value::*;
use crate::types::view::MuslinView;
use crate::types::wind::MuslinWind;
use core::ffi::{CStr, c_void};
use core::mem::MaybeUninit;
use core::ptr::{null, null_mut};
use core::slice;

const IDENTITY: MuslinQuat = MuslinQuat { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };

fn at(x: f32, y: f32, z: f32) -> MuslinVec3 {
    MuslinVec3 { x, y, z }
}

/// Returns what an `init` function writes into uninitialised memory.
fn initialized<T>(init: impl FnOnce(*mut T) -> MuslinStatus) -> T {
    let mut value = MaybeUninit::uninit();
    assert_eq!(init(value.as_mut_ptr()), MuslinStatus::Ok);
    // SAFETY: a call that succeeds has written the whole value.
    unsafe { value.assume_init() }
}

/// Returns what a call writes into uninitialised memory.
fn written<T>(call: impl FnOnce(*mut T) -> MuslinStatus) -> T {
    initialized(call)
}

fn size<T>() -> u32 {
    size_of::<T>() as u32
}

fn small_grid() -> MuslinGridDesc {
    // SAFETY: the memory has the stated sizes.
    let mut desc: MuslinGridDesc = initialized(|desc| unsafe {
        muslin_grid_desc_init_sized(
            desc,
            size::<MuslinGridDesc>(),
            size::<MuslinMaterial>(),
            size::<MuslinSettings>(),
        )
    });
    (desc.columns, desc.rows, desc.spacing) = (4, 4, 0.1);
    desc.settings.substeps = 1;
    desc
}

/// Floats as bytes at an odd address.
fn unaligned_bytes(numbers: &[f32]) -> Vec<u8> {
    let bytes = numbers.iter().flat_map(|number| number.to_ne_bytes());
    core::iter::once(0).chain(bytes).collect()
}

fn grid() -> MuslinCloth {
    let desc = small_grid();
    // SAFETY: both pointers are valid for the call.
    written(|cloth| unsafe { muslin_cloth_create_grid(&desc, cloth) })
}

#[track_caller]
fn assert_ok(status: MuslinStatus) {
    // SAFETY: the message ends in a zero byte and lives until this thread's next error.
    let why = || unsafe { CStr::from_ptr(muslin_last_error()) }.to_string_lossy();
    assert_eq!(status, MuslinStatus::Ok, "{}", why());
}

#[test]
fn a_grid_is_created_stepped_torn_read_saved_and_destroyed() {
    let cloth = grid();
    // SAFETY: every pointer in this test is valid for its call, with the size that is passed along.
    unsafe {
        let mut ticks = 7;
        assert_ok(muslin_cloth_advance(cloth, 0.04, &mut ticks));
        assert_eq!(ticks, 2);
        assert_ok(muslin_cloth_advance(cloth, 0.0, null_mut()));

        let view: MuslinView = written(|view: *mut MuslinView| {
            (*view).struct_size = size::<MuslinView>();
            muslin_cloth_view(cloth, view)
        });
        let positions = slice::from_raw_parts(view.positions, 3 * view.vertex_count as usize);
        assert!(positions.iter().all(|x| x.is_finite()));
        let indices = slice::from_raw_parts(view.indices, view.index_count as usize);
        assert!(indices.iter().all(|index| *index < view.vertex_count));

        assert_ok(muslin_cloth_tear_edge(cloth, 8, 9));
        let mut edges = 0;
        assert_ok(muslin_cloth_cut(
            cloth,
            at(0.15, 0.1, -1.0),
            at(0.15, -0.17, -1.0),
            at(0.0, 0.0, 2.0),
            &mut edges,
        ));
        assert!(edges > 0);
        let mut some = 1;
        let mut events = 0;
        while some == 1 {
            let mut event = MaybeUninit::<MuslinEvent>::uninit();
            (*event.as_mut_ptr()).struct_size = size::<MuslinEvent>();
            assert_ok(muslin_cloth_next_event(cloth, event.as_mut_ptr(), &mut some));
            events += some;
        }
        assert!(events > 0);
        let changes: MuslinChanges = written(|changes: *mut MuslinChanges| {
            (*changes).struct_size = size::<MuslinChanges>();
            muslin_cloth_changes(cloth, view.topology_revision, changes)
        });
        assert!(changes.index_count > 0);

        let mut needed = 0;
        assert_eq!(muslin_cloth_save(cloth, null_mut(), 0, &mut needed), MuslinStatus::Ok);
        let mut bytes = vec![0_u8; needed];
        assert_ok(muslin_cloth_save(cloth, bytes.as_mut_ptr().cast(), bytes.len(), null_mut()));
        let mut restored = MuslinCloth { id: 0 };
        let saved = bytes.as_ptr().cast();
        assert_ok(muslin_cloth_restore(saved, bytes.len(), &mut restored));
        assert_ne!(muslin_cloth_restore(saved, bytes.len() - 1, &mut restored), MuslinStatus::Ok);
        let [mut hash, mut same] = [0; 2];
        assert_ok(muslin_cloth_state_hash(cloth, &mut hash));
        assert_ok(muslin_cloth_state_hash(restored, &mut same));
        assert_eq!(hash, same);
        let mut copy = MuslinCloth { id: 0 };
        assert_ok(muslin_cloth_duplicate(restored, &mut copy));
        // Unaligned lists that end where they must.
        let mut bytes = [0_u8; 1 + 2 * size_of::<MuslinCloth>()];
        let list = bytes.as_mut_ptr().add(1).cast::<MuslinCloth>();
        list.write_unaligned(restored);
        list.add(1).write_unaligned(copy);
        let mut ticks = [0_u8; 1 + 2 * size_of::<u32>()];
        let out_ticks = ticks.as_mut_ptr().add(1).cast::<u32>();
        assert_ok(muslin_cloths_advance(list, 2, 0.0, out_ticks));
        assert_ok(muslin_cloths_advance(list, 2, 0.0, null_mut()));
        assert_ne!(muslin_cloths_advance(null(), 1, 0.0, null_mut()), MuslinStatus::Ok);
        let mut text =
            vec![0; written(|out| { muslin_cloth_get_mesh_warnings(cloth, null_mut(), 0, out) })];
        let end = text.len();
        let text = text.as_mut_ptr();
        assert_ok(muslin_cloth_get_mesh_warnings(cloth, text, end, null_mut()));
        assert_ok(muslin_cloth_destroy(copy));
        assert_ok(muslin_cloth_destroy(restored));
        assert_ne!(muslin_cloth_step(restored, 1), MuslinStatus::Ok, "the handle is stale");
    }
    assert_ok(muslin_cloth_reset(cloth));
    assert_ok(muslin_cloth_destroy(cloth));
}

#[test]
fn poses_and_queries_read_and_write_unaligned_lists_up_to_their_last_byte() {
    let cloth = grid();
    // SAFETY: every pointer in this test is valid for its call, with the size that is passed along.
    unsafe {
        let positions = unaligned_bytes(&[0.1, -0.1, 0.0, 9.0, 0.2, -0.1, 0.01]);
        let unaligned: *const f32 = positions.as_ptr().add(1).cast();
        assert_ok(muslin_cloth_set_positions(cloth, 5, 2, unaligned, 16));
        assert_ok(muslin_cloth_set_velocities(cloth, 5, 2, unaligned, 16));
        let mut room = unaligned_bytes(&[9.0; 7]);
        let out: *mut f32 = room.as_mut_ptr().add(1).cast();
        assert_ok(muslin_cloth_get_velocities(cloth, 5, 2, out, 16));
        assert_eq!(room, positions);
        assert_ok(muslin_cloth_get_rest_positions(cloth, 5, 2, out, 16));
        let count: u32 = written(|out| muslin_cloth_get_pins(cloth, null_mut(), 0, out));
        let mut pins = vec![0; count as usize];
        let same: u32 = written(|out| muslin_cloth_get_pins(cloth, pins.as_mut_ptr(), count, out));
        assert!(count == same && count >= 2);
        assert_ok(muslin_cloth_get_pin_targets(cloth, pins.as_ptr(), out, 16, 2));
        let asleep: u32 = written(|out| muslin_cloth_is_asleep(cloth, out));
        let blend: f32 = written(|out| muslin_cloth_get_blend(cloth, out));
        assert_eq!((asleep, blend), (0, 0.0));
        let mut wind: MuslinWind =
            initialized(|wind| muslin_wind_init_sized(wind, size::<MuslinWind>()));
        assert_ok(muslin_cloth_get_wind(cloth, &raw mut wind));
        let ticks: u64 = written(|out| muslin_cloth_get_time(cloth, null_mut(), out));
        let total: f32 = written(|out| muslin_cloth_get_mass(cloth, out, null_mut(), null_mut()));
        assert!(ticks == 0 && total > 0.0);
    }
    assert_ok(muslin_cloth_destroy(cloth));
}

#[test]
fn pins_attachments_and_grabs_read_unaligned_lists() {
    let cloth = grid();
    // SAFETY: every pointer in this test is valid for its call, with the size that is passed along.
    unsafe {
        let particles = [5, 6];
        let positions = unaligned_bytes(&[0.1, -0.1, 0.0, 9.0, 0.2, -0.1, 0.01, 9.0]);
        let unaligned: *const c_void = positions.as_ptr().add(1).cast();
        assert_ok(muslin_cloth_set_pin_targets(cloth, particles.as_ptr(), unaligned, 16, 2));
        assert_ok(muslin_cloth_set_pin_stiffness(cloth, particles.as_ptr(), 2, 0.5));
        assert_ok(muslin_cloth_set_mass_scales(cloth, particles.as_ptr(), [2.0, 3.0].as_ptr(), 2));
        assert_ok(muslin_cloth_set_max_distances(
            cloth,
            particles.as_ptr(),
            [0.1, 0.2].as_ptr(),
            2,
        ));
        let [distances, radii] = [[0.1, 0.1], [1.0, 1.0]];
        assert_ok(muslin_cloth_set_backstops(
            cloth,
            particles.as_ptr(),
            distances.as_ptr(),
            radii.as_ptr(),
            2,
        ));
        let normals = unaligned_bytes(&[0.0, 0.0, 1.0, 9.0, 0.0, 0.0, 1.0, 9.0]);
        let normal = normals.as_ptr().add(1).cast();
        assert_ok(muslin_cloth_set_anchors(cloth, particles.as_ptr(), unaligned, normal, 16, 2));
        assert_ok(muslin_cloth_pin(cloth, 9, null()));
        assert_ok(muslin_cloth_pin(cloth, 10, &at(0.2, -0.2, 0.0)));
        let attachment: MuslinAttachment = written(|out| {
            muslin_cloth_attach(cloth, [12, 13].as_ptr(), 2, at(0.0, 0.0, 0.0), IDENTITY, out)
        });
        assert_ok(muslin_cloth_move_attachment(cloth, attachment, at(0.0, 0.01, 0.0), IDENTITY));

        let mut desc: MuslinColliderDesc =
            initialized(|desc| muslin_collider_desc_init_sized(desc, size::<MuslinColliderDesc>()));
        desc.position = at(0.15, -0.5, 0.0);
        let collider: MuslinCollider = written(|out| muslin_cloth_add_collider(cloth, &desc, out));
        let position: MuslinVec3 =
            written(|out| muslin_cloth_get_collider_pose(cloth, collider, out, null_mut()));
        assert_eq!(position, desc.position);
        let wind: MuslinWind =
            initialized(|wind| muslin_wind_init_sized(wind, size::<MuslinWind>()));
        assert_ok(muslin_cloth_set_wind(cloth, &wind));

        let hit: MuslinHit = written(|hit: *mut MuslinHit| {
            (*hit).struct_size = size::<MuslinHit>();
            muslin_cloth_raycast(cloth, at(0.17, -0.26, 1.0), at(0.0, 0.0, -1.0), 9.0, hit)
        });
        assert!(hit.particle < 16);
        let grab: MuslinGrab = written(|out| {
            let (origin, direction) = (at(0.1, -0.26, 1.0), at(0.0, 0.0, -1.0));
            muslin_cloth_grab_ray(cloth, origin, direction, 0.1, out, null_mut())
        });
        assert_ok(muslin_cloth_move_grab(cloth, grab, at(0.1, -0.3, 0.1)));
        assert_ok(muslin_cloth_step(cloth, 2));
        let impulse: MuslinVec3 =
            written(|out| muslin_cloth_get_collider_impulse(cloth, collider, out, null_mut()));
        assert!(impulse.x.is_finite());
        let stats: MuslinStats = written(|stats: *mut MuslinStats| {
            (*stats).struct_size = size::<MuslinStats>();
            muslin_cloth_get_stats(cloth, stats)
        });
        assert_eq!(stats.particles, 16);
        assert_ok(muslin_cloth_release(cloth, grab));
        assert_ok(muslin_cloth_detach(cloth, attachment));
        assert_ok(muslin_cloth_remove_collider(cloth, collider));
        assert_ok(muslin_cloth_clear_leashes(cloth));
        assert_ok(muslin_cloth_unpin_all(cloth));

        assert_ne!(muslin_cloth_set_wind(cloth, null()), MuslinStatus::Ok);
        assert_ne!(muslin_cloth_set_pin_targets(cloth, null(), unaligned, 16, 2), MuslinStatus::Ok);
    }
    assert_ok(muslin_cloth_destroy(cloth));
}

#[test]
fn a_mesh_is_read_and_written_with_strides() {
    let corners: [f32; 20] = [
        0.0, 0.0, 0.0, 7.0, 7.0, 1.0, 0.0, 0.0, 7.0, 7.0, 1.0, -1.0, 0.0, 7.0, 7.0, 0.0, -1.0, 0.0,
        7.0, 7.0,
    ];
    // The last row ends after its position: bytes behind it must not be read.
    let corners = corners[..18].to_vec().into_boxed_slice();
    // SAFETY: every pointer in this test is valid for its call, with the size that is passed along.
    unsafe {
        let mut desc: MuslinMeshDesc = initialized(|desc| {
            muslin_mesh_desc_init_sized(
                desc,
                size::<MuslinMeshDesc>(),
                size::<MuslinMaterial>(),
                size::<MuslinSettings>(),
            )
        });
        let indices = [0, 3, 1, 1, 3, 2];
        let uvs = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0_f32];
        (desc.positions, desc.position_stride, desc.vertex_count) = (corners.as_ptr(), 20, 4);
        (desc.indices, desc.index_count) = (indices.as_ptr(), 6);
        desc.uvs = uvs.as_ptr();
        let pinned = [0, 1];
        (desc.pinned, desc.pinned_count) = (pinned.as_ptr(), 2);
        let cloth: MuslinCloth = written(|cloth| muslin_cloth_create_mesh(&desc, cloth));
        let report: MuslinMeshReport = written(|report: *mut MuslinMeshReport| {
            (*report).struct_size = size::<MuslinMeshReport>();
            muslin_cloth_get_mesh_report(cloth, report)
        });
        assert_eq!(report.kept_triangles, 2);
        assert_ok(muslin_cloth_step(cloth, 1));

        let streams = [
            (MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, 12),
            (MUSLIN_ATTRIBUTE_NORMAL, MUSLIN_FORMAT_OCTAHEDRAL16, 4),
            (MUSLIN_ATTRIBUTE_UV, MUSLIN_FORMAT_F16, 4),
        ];
        let mut buffers = streams.map(|(.., stride)| vec![0_u32; stride as usize]);
        let mut streams = streams.map(|(attribute, format, stride)| {
            let mut stream: MuslinStream =
                initialized(|stream| muslin_stream_init_sized(stream, size::<MuslinStream>()));
            (stream.attribute, stream.format, stream.stride) = (attribute, format, stride);
            stream
        });
        for (stream, buffer) in streams.iter_mut().zip(&mut buffers) {
            (stream.buffer, stream.size) = (buffer.as_mut_ptr().cast(), 4 * buffer.len());
        }
        assert_ok(muslin_cloth_write_vertices(cloth, streams.as_ptr(), 3, null()));
        // Octahedral normals may be all zero (normals along z); positions and uvs are not.
        assert!(
            [&buffers[0], &buffers[2]].iter().all(|buffer| buffer.iter().any(|word| *word != 0))
        );
        streams[0].size -= 1;
        let status = muslin_cloth_write_vertices(cloth, streams.as_ptr(), 3, null());
        assert_ne!(status, MuslinStatus::Ok, "a buffer is one byte too small");
        let mut short = [0_u16; 6];
        let size = size_of_val(&short);
        assert_ok(muslin_cloth_write_indices(cloth, short.as_mut_ptr().cast(), size, 16, 0, 0));
        assert_ok(muslin_cloth_destroy(cloth));
    }
}
