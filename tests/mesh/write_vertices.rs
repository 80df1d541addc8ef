//! Vertices written into the caller's buffers: every attribute, format and layout, compared with
//! values that the tests compute from the view.

use crate::common::{bare_grid, irregular_mesh, triangles};
use core::cell::Cell;
use muslin::glam::{Affine3, Mat3, Quat, Vec2, Vec3};
use muslin::{
    Attribute, Cloth, Error, MeshDesc, PinMode, Stream, VertexFormat as Format, WriteDesc,
};

/// A moving sheet with a tear and a cut.
fn torn_sheet() -> Cloth {
    let mut desc = bare_grid(20, 13, 0.1, PinMode::TopCorners);
    desc.settings.gravity = Vec3::new(1.0, -9.0, 4.0);
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(20);
    assert!(cloth.tear_edge(70, 90).unwrap());
    cloth.cut(Vec3::new(0.3, 0.1, -9.0), Vec3::new(0.7, -3.0, -9.0), Vec3::Z * 18.0).unwrap();
    cloth.step(3);
    cloth
}

/// The bytes of a buffer as cells.
fn byte_cells(buffer: &mut [u8]) -> &[Cell<u8>] {
    Cell::from_mut(buffer).as_slice_of_cells()
}

/// Writes one attribute without gaps and returns the decoded numbers.
fn written_values(
    cloth: &mut Cloth,
    attribute: Attribute,
    format: Format,
    desc: &WriteDesc,
) -> Vec<f32> {
    let width = format.width(attribute).unwrap();
    // A buffer of u32, so that its alignment suits every format.
    let mut buffer = vec![0_u32; width / 4 * cloth.positions().len()];
    let count = match desc.vertex_count {
        u32::MAX => cloth.positions().len() - desc.first_vertex as usize,
        count => count as usize,
    };
    let bytes = bytes_of(&mut buffer);
    let bytes = byte_cells(&mut bytes[..width * count]);
    cloth.write_vertices(&[Stream { attribute, format, stride: 0, bytes }], desc).unwrap();
    decoded(format, bytes)
}

/// The bytes of a buffer of words.
fn bytes_of(words: &mut [u32]) -> &mut [u8] {
    // SAFETY: every bit pattern is a valid `u8` and a valid `u32`.
    unsafe { words.align_to_mut().1 }
}

/// The numbers in `bytes`.
fn decoded(format: Format, bytes: &[Cell<u8>]) -> Vec<f32> {
    let number = |b: &[Cell<u8>]| match format {
        Format::F32 => f32::from_ne_bytes([b[0].get(), b[1].get(), b[2].get(), b[3].get()]),
        Format::F16 => f32_from_f16(u16::from_ne_bytes([b[0].get(), b[1].get()])),
        _ => f32::from(i16::from_ne_bytes([b[0].get(), b[1].get()])) / 32767.0,
    };
    bytes.chunks_exact(format.size()).map(number).collect()
}

/// The value of an IEEE 754 half-precision number.
fn f32_from_f16(bits: u16) -> f32 {
    let (exponent, part) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    let size = match exponent {
        0 => part * 2.0_f32.powi(-24),
        _ => (1024.0 + part) * 2.0_f32.powi(exponent - 25),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// The first three of each `each` numbers, as vectors.
fn vectors(numbers: &[f32], each: usize) -> Vec<Vec3> {
    numbers.chunks_exact(each).map(Vec3::from_slice).collect()
}

/// A moving shirt with a cut across a seam.
fn cut_shirt() -> Cloth {
    let mut cloth = Cloth::mesh(&crate::common::garments::shirt()).unwrap();
    cloth.step(20);
    cloth.cut(Vec3::new(0.1, -0.4, -9.0), Vec3::new(0.5, -0.5, -9.0), Vec3::Z * 18.0).unwrap();
    cloth.step(3);
    let report = cloth.mesh_report();
    assert!(report.welded_vertices > 0 && cloth.positions().len() > report.vertices as usize);
    cloth
}

/// Normals, tangents and handedness of a surface by their definitions. Vertices that share a
/// particle share their normal.
fn tangent_frames(cloth: &Cloth, at: &[Vec3]) -> (Vec<Vec3>, Vec<Vec3>, Vec<f32>) {
    let particle = |v: usize| cloth.vertex_particles()[v] as usize;
    let (mut normals, mut along, mut areas) =
        (vec![Vec3::ZERO; at.len()], vec![Vec3::ZERO; at.len()], vec![0.0_f32; at.len()]);
    for corners in triangles(cloth).iter().map(|t| t.map(|v| v as usize)) {
        let [a, b, c] = corners.map(|v| at[v]);
        let [ua, ub, uc] = corners.map(|v| cloth.uvs()[v]);
        let (p, q, up, uq) = (b - a, c - a, ub - ua, uc - ua);
        let area = up.perp_dot(uq);
        for v in corners {
            normals[particle(v)] += p.cross(q);
            along[v] += (p * uq.y - q * up.y) * area.signum();
            areas[v] += area;
        }
    }
    let normals: Vec<Vec3> =
        (0..at.len()).map(|v| normals[particle(v)].normalize_or_zero()).collect();
    let orthogonal = |(t, n): (&Vec3, &Vec3)| (*t - *n * n.dot(*t)).normalize_or_zero();
    let along = along.iter().zip(&normals).map(orthogonal).collect();
    (normals, along, areas.into_iter().map(f32::signum).collect())
}

fn assert_near(one: &[Vec3], other: &[Vec3], most: f32) {
    assert_eq!(one.len(), other.len());
    for (at, (a, b)) in one.iter().zip(other).enumerate() {
        assert!((*a - *b).length() <= most, "vertex {at}: {a} is not {b}");
    }
}

#[test]
fn f32_streams_equal_the_view_exactly() {
    for mut cloth in [torn_sheet(), cut_shirt()] {
        let (desc, view) = (WriteDesc::default(), cloth.view());
        let (positions, normals) = (view.positions.to_vec(), view.normals.to_vec());
        let (uvs, frayed) = (view.uvs.to_vec(), view.frayed.to_vec());
        let numbers = written_values(&mut cloth, Attribute::Position, Format::F32, &desc);
        assert_eq!(vectors(&numbers, 3), positions);
        let numbers = written_values(&mut cloth, Attribute::Normal, Format::F32, &desc);
        assert_eq!(vectors(&numbers, 3), normals);
        let numbers = written_values(&mut cloth, Attribute::Uv, Format::F32, &desc);
        assert!(numbers.chunks_exact(2).map(Vec2::from_slice).eq(uvs));
        let numbers = written_values(&mut cloth, Attribute::Frayed, Format::F32, &desc);
        assert!(numbers.iter().map(|number| *number == 1.0).eq(frayed.iter().copied()));
        assert!(numbers.contains(&0.0) && numbers.contains(&1.0));
    }
}

#[test]
fn every_format_equals_f32_within_its_rounding() {
    let mut cloth = torn_sheet();
    let desc = WriteDesc { blend: 0.75, ..WriteDesc::default() };
    for attribute in Attribute::ALL {
        let floats = written_values(&mut cloth, attribute, Format::F32, &desc);
        let each = Format::F32.width(attribute).unwrap() / 4;
        for format in [Format::F16, Format::Snorm16] {
            let Some(width) = format.width(attribute) else { continue };
            let numbers = written_values(&mut cloth, attribute, format, &desc);
            for (packed, exact) in numbers.chunks_exact(width / 2).zip(floats.chunks_exact(each)) {
                let close = |(p, e): (&f32, &f32)| (p - e).abs() <= 5e-4 * e.abs().max(0.06);
                assert!(packed.iter().zip(exact).all(close), "{packed:?} is not {exact:?}");
                let last = if attribute == Attribute::Position { 1.0 } else { 0.0 };
                assert!(packed[each..].iter().all(|number| *number == last), "{packed:?}");
            }
        }
        let Some(width) = Format::Octahedral16.width(attribute) else { continue };
        let numbers = written_values(&mut cloth, attribute, Format::Octahedral16, &desc);
        for (packed, exact) in numbers.chunks_exact(width / 2).zip(floats.chunks_exact(each)) {
            let z = 1.0 - packed[0].abs() - packed[1].abs();
            let fold = |x: f32| x - (-z).max(0.0).copysign(x);
            let v = Vec3::new(fold(packed[0]), fold(packed[1]), z).normalize();
            assert!((v - Vec3::from_slice(exact)).length() < 1e-4, "{v} is not {exact:?}");
            assert!(each == 3 || packed[2..] == [exact[3], 0.0]);
        }
    }
}

#[test]
fn separate_interleaved_and_block_layouts_hold_equal_data_and_keep_gaps() {
    let mut cloth = torn_sheet();
    let (count, desc) = (cloth.positions().len(), WriteDesc::default());
    let wanted = [
        (Attribute::Position, Format::F32),
        (Attribute::Normal, Format::Octahedral16),
        (Attribute::Tangent, Format::Snorm16),
        (Attribute::Uv, Format::F16),
    ];
    let separate =
        wanted.map(|(attribute, format)| written_values(&mut cloth, attribute, format, &desc));
    let widths = wanted.map(|(attribute, format)| format.width(attribute).unwrap());
    // Four foreign bytes follow each vertex, and some follow each block.
    let stride = widths.iter().sum::<usize>() + 4;
    for is_interleaved in [true, false] {
        let mut buffer = vec![0xeeee_eeee_u32; stride * count / 4 + 8];
        let all = byte_cells(bytes_of(&mut buffer));
        let mut begin = 4;
        let streams = [0, 1, 2, 3].map(|at| {
            let (attribute, format) = wanted[at];
            let bytes = &all[begin..];
            begin += if is_interleaved { widths[at] } else { widths[at] * count + 4 };
            let stride = if is_interleaved { stride as u32 } else { 0 };
            Stream { attribute, format, stride, bytes }
        });
        cloth.write_vertices(&streams, &desc).unwrap();
        let mut touched = 0;
        for (at, stream) in streams.iter().enumerate() {
            let step = if is_interleaved { stride } else { widths[at] };
            let mut packed = Vec::new();
            for vertex in stream.bytes.chunks(step).take(count) {
                packed.extend_from_slice(&vertex[..widths[at]]);
            }
            assert_eq!(decoded(stream.format, &packed), separate[at], "stream {at}");
            for vertex in stream.bytes.chunks(step).take(count) {
                vertex[..widths[at]].iter().for_each(|cell| cell.set(0xee));
            }
            touched += packed.len();
        }
        assert_eq!(touched, widths.iter().sum::<usize>() * count);
        assert!(all.iter().all(|cell| cell.get() == 0xee), "a gap was written to");
    }
}

#[test]
fn blending_interpolates_between_the_last_two_ticks() {
    for mut cloth in [torn_sheet(), cut_shirt()] {
        let before = cloth.positions().to_vec();
        cloth.step(1);
        let now = cloth.positions().to_vec();
        for blend in [0.0, 0.25, 0.5, 1.0] {
            let desc = WriteDesc { blend, ..WriteDesc::default() };
            let at =
                vectors(&written_values(&mut cloth, Attribute::Position, Format::F32, &desc), 3);
            let mix: Vec<Vec3> = before.iter().zip(&now).map(|(a, b)| a.lerp(*b, blend)).collect();
            assert_near(&at, &mix, 1e-6);
            assert!(blend > 0.0 || at == before);
            let (normals, tangents, handedness) = tangent_frames(&cloth, &at);
            let values = written_values(&mut cloth, Attribute::Normal, Format::F32, &desc);
            assert_near(&vectors(&values, 3), &normals, 1e-4);
            let values = written_values(&mut cloth, Attribute::Tangent, Format::F32, &desc);
            assert_near(&vectors(&values, 4), &tangents, 1e-3);
            assert!(values.chunks_exact(4).map(|t| t[3]).eq(handedness));
            // The view still has the state of this tick after blended writes.
            assert_eq!(cloth.positions(), now);
            let normals = tangent_frames(&cloth, &now).0;
            assert_near(cloth.normals(), &normals, 1e-4);
        }
    }
}

#[test]
fn a_transform_applies_to_positions_normals_and_tangents() {
    let mut cloth = torn_sheet();
    let plain = cloth.positions().to_vec();
    let turn = Mat3::from_quat(Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 1.2));
    let shear = Mat3::from_cols(Vec3::new(2.0, 0.3, 0.0), Vec3::Y, Vec3::new(0.0, -0.5, 0.25));
    let mirror = Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0));
    for matrix3 in [turn, shear, mirror * turn, turn * 1e-9, turn * 1e12] {
        let transform = Affine3 { matrix3, translation: Vec3::new(3.0, -2.0, 0.5) };
        let desc = WriteDesc { transform, ..WriteDesc::default() };
        let at = vectors(&written_values(&mut cloth, Attribute::Position, Format::F32, &desc), 3);
        let moved: Vec<Vec3> = plain.iter().map(|p| transform.transform_point3(*p)).collect();
        assert_near(&at, &moved, 1e-5 * matrix3.x_axis.length().max(1.0));
        // A mirror reverses the winding of triangles, but normals stay on their side.
        let side = matrix3.determinant().signum();
        let flat: Vec<Vec3> =
            plain.iter().map(|p| (matrix3 * *p) / matrix3.x_axis.length()).collect();
        let (normals, tangents, _) = tangent_frames(&cloth, &flat);
        let normals: Vec<Vec3> = normals.iter().map(|n| *n * side).collect();
        let values = written_values(&mut cloth, Attribute::Normal, Format::F32, &desc);
        assert_near(&vectors(&values, 3), &normals, 0.02);
        let values = written_values(&mut cloth, Attribute::Tangent, Format::F32, &desc);
        assert_near(&vectors(&values, 4), &tangents, 0.05);
        let plain =
            written_values(&mut cloth, Attribute::Tangent, Format::F32, &WriteDesc::default());
        for (at, n) in values.chunks_exact(4).zip(&normals) {
            assert!(at[3] * side == plain[3] && Vec3::from_slice(at).dot(*n).abs() < 0.02);
        }
    }
}

#[test]
fn two_writes_with_offset_make_a_thick_cloth() {
    let mut cloth = Cloth::grid(&bare_grid(9, 7, 0.1, PinMode::None)).unwrap();
    cloth.step(10);
    let (plain, normals) = (cloth.positions().to_vec(), cloth.normals().to_vec());
    let mut gap = vec![Vec3::ZERO; plain.len()];
    for flip_normals in [false, true] {
        let desc = WriteDesc { offset: 0.02, flip_normals, ..WriteDesc::default() };
        let at = vectors(&written_values(&mut cloth, Attribute::Position, Format::F32, &desc), 3);
        let values = written_values(&mut cloth, Attribute::Normal, Format::F32, &desc);
        let side = if flip_normals { -1.0 } else { 1.0 };
        let turned: Vec<Vec3> = normals.iter().map(|n| *n * side).collect();
        assert_near(&vectors(&values, 3), &turned, 0.0);
        for (v, gap) in gap.iter_mut().enumerate() {
            *gap += (at[v] - plain[v]) * side;
        }
        let values = written_values(&mut cloth, Attribute::Tangent, Format::F32, &desc);
        for t in values.chunks_exact(4) {
            // v grows upward on both sides.
            let up = turned[0].cross(Vec3::from_slice(t)) * t[3];
            assert!((Vec3::from_slice(t) - Vec3::X).length() < 1e-5, "{t:?}");
            assert!((up - Vec3::Y).length() < 1e-5, "{t:?}");
        }
    }
    let thick: Vec<Vec3> = normals.iter().map(|n| *n * 0.04).collect();
    assert_near(&gap, &thick, 1e-6);
}

#[test]
fn tangents_follow_any_uvs_and_have_a_fallback_without_uvs() {
    let mesh = irregular_mesh();
    let mirrored = MeshDesc {
        uvs: mesh.positions.iter().map(|p| Vec2::new(-p.x, -p.y)).collect(),
        ..mesh.clone()
    };
    let turned = MeshDesc {
        uvs: mesh.positions.iter().map(|p| Vec2::new(p.y, p.x)).collect(),
        ..mesh.clone()
    };
    let none = MeshDesc { uvs: vec![Vec2::ZERO; mesh.positions.len()], ..mesh.clone() };
    for (desc, wanted) in [(mirrored, Some(Vec3::NEG_X)), (turned, Some(Vec3::Y)), (none, None)] {
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let normals = cloth.normals().to_vec();
        let values =
            written_values(&mut cloth, Attribute::Tangent, Format::F32, &WriteDesc::default());
        for (t, n) in values.chunks_exact(4).zip(&normals) {
            let (t, handedness) = (Vec3::from_slice(t), t[3]);
            assert!((t.length() - 1.0).abs() < 1e-5 && t.dot(*n).abs() < 1e-5, "{t} on {n}");
            match wanted {
                Some(wanted) if wanted.dot(*n).abs() < 1e-6 => {
                    assert!((t - wanted).length() < 1e-4, "{t} is not {wanted}");
                    let up = if wanted == Vec3::Y { Vec3::X } else { Vec3::NEG_Y };
                    assert!((n.cross(t) * handedness - up).length() < 0.2, "{n} {t} {handedness}");
                }
                Some(_) => {}
                None => assert_eq!(handedness, 1.0),
            }
        }
    }
}

#[test]
fn a_vertex_range_is_written_to_the_start_of_the_buffer() {
    let mut cloth = torn_sheet();
    let all = written_values(&mut cloth, Attribute::Position, Format::F32, &WriteDesc::default());
    let count = cloth.positions().len() as u32;
    for (first_vertex, vertex_count) in [(0, 1), (5, 64), (7, 130), (count, 0), (count - 1, 1)] {
        let desc = WriteDesc { first_vertex, vertex_count, ..WriteDesc::default() };
        let some = written_values(&mut cloth, Attribute::Position, Format::F32, &desc);
        let first = 3 * first_vertex as usize;
        assert_eq!(some, all[first..first + 3 * vertex_count as usize]);
    }
    let desc = WriteDesc { first_vertex: 9, ..WriteDesc::default() };
    assert_eq!(written_values(&mut cloth, Attribute::Position, Format::F32, &desc), all[27..]);
}

/// Three streams that do not overlap: 12 + 8 + 4 bytes of a vertex of 32 bytes.
fn valid_streams<'a>(bytes: &'a [Cell<u8>]) -> [Stream<'a>; 3] {
    [
        (Attribute::Position, Format::F32, 0),
        (Attribute::Normal, Format::Snorm16, 16),
        (Attribute::Uv, Format::F16, 24),
    ]
    .map(|(attribute, format, at)| Stream {
        attribute,
        format,
        stride: 32,
        bytes: &bytes[at..],
    })
}

#[test]
fn invalid_streams_are_refused_by_field_and_write_nothing() {
    let mut cloth = torn_sheet();
    let count = cloth.positions().len();
    let hash = cloth.state_hash();
    let mut buffer = vec![0xeeee_eeee_u32; 8 * (count + 1)];
    let bytes = byte_cells(bytes_of(&mut buffer));
    let desc = WriteDesc::default();
    let mut assert_refused = |streams: &[Stream<'_>], words: &str| {
        let error = cloth.write_vertices(streams, &desc).unwrap_err();
        assert!(error.to_string().contains(words), "{error} is not about {words}");
        assert!(bytes.iter().all(|cell| cell.get() == 0xee));
    };
    assert_refused(&[], "`streams`");
    assert_refused(&[valid_streams(bytes)[0]; 17], "`streams`");
    for (attribute, format) in [
        (Attribute::Position, Format::Snorm16),
        (Attribute::Position, Format::Octahedral16),
        (Attribute::Uv, Format::Snorm16),
        (Attribute::Uv, Format::Octahedral16),
        (Attribute::Frayed, Format::Octahedral16),
    ] {
        let [a, b, mut c] = valid_streams(bytes);
        (c.attribute, c.format) = (attribute, format);
        assert_refused(&[a, b, c], "`streams[2].format`");
    }
    for stride in [1, 4, 8, 13, 14, 30, 31] {
        let [mut a, b, c] = valid_streams(bytes);
        a.stride = stride;
        assert_refused(&[a, b, c], "`streams[0].stride` must be 0 or a multiple");
    }
    for off in [1, 2, 3] {
        let [mut a, b, c] = valid_streams(bytes);
        a.bytes = &bytes[off..];
        assert_refused(&[a, b, c], "`streams[0].buffer` must be aligned");
    }
    let [a, mut b, c] = valid_streams(bytes);
    b.bytes = &bytes[17..];
    assert_refused(&[a, b, c], "`streams[1].buffer` must be aligned");
    // Bytes written by two streams: in one vertex, in the next, in blocks, with unequal strides.
    for at in [0, 4, 8, 20] {
        let [a, b, mut c] = valid_streams(bytes);
        c.bytes = &bytes[at..];
        assert_refused(&[a, b, c], "`streams[2].buffer` must be apart");
    }
    let [mut a, b, c] = valid_streams(&bytes[4..]);
    a.bytes = &bytes[28..];
    assert_refused(&[b, c, a], "`streams[2].buffer` must be apart");
    let [a, b, mut c] = valid_streams(bytes);
    c.stride = 24;
    assert_refused(&[a, b, c], "`streams[2].buffer` must be apart");
    let block = |at: usize, attribute| Stream {
        attribute,
        format: Format::F32,
        stride: 0,
        bytes: &bytes[at..],
    };
    let halves = [block(0, Attribute::Position), block(12 * count - 4, Attribute::Normal)];
    assert_refused(&halves, "`streams[1].buffer` must be apart");
    // The buffer lacks one byte of the last vertex.
    let needed = 32 * (count - 1) + 12;
    let [mut a, b, c] = valid_streams(bytes);
    a.bytes = &bytes[..needed - 1];
    let words = format!("`streams[0].size` must be at least {needed}, but is {}", needed - 1);
    assert_refused(&[a, b, c], &words);
    let [a, mut b, c] = valid_streams(bytes);
    b.stride = u32::MAX - 1;
    assert_refused(&[a, b, c], "`streams[1].size`");
    assert_eq!(cloth.state_hash(), hash);

    let [mut a, b, c] = valid_streams(bytes);
    a.bytes = &bytes[..needed];
    cloth.write_vertices(&[a, b, c], &desc).unwrap();
    cloth
        .write_vertices(
            &[block(0, Attribute::Position), block(12 * count, Attribute::Normal)],
            &desc,
        )
        .unwrap();
    assert_eq!(cloth.state_hash(), hash);
}

#[test]
fn invalid_write_descriptors_are_refused_by_field() {
    let mut cloth = torn_sheet();
    let count = cloth.positions().len() as u32;
    let mut buffer = vec![0xeeee_eeee_u32; 8 * count as usize];
    let bytes = byte_cells(bytes_of(&mut buffer));
    let valid_desc = WriteDesc::default();
    let flat = Affine3::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let mut with_nan = Affine3::IDENTITY;
    with_nan.matrix3.y_axis.x = f32::NAN;
    let mut infinite = Affine3::IDENTITY;
    infinite.translation.z = f32::INFINITY;
    for (desc, words) in [
        (WriteDesc { first_vertex: count + 1, ..valid_desc.clone() }, "first_vertex"),
        (WriteDesc { vertex_count: count + 1, ..valid_desc.clone() }, "vertex_count"),
        (
            WriteDesc { first_vertex: 2, vertex_count: count - 1, ..valid_desc.clone() },
            "vertex_count",
        ),
        (WriteDesc { blend: -0.01, ..valid_desc.clone() }, "blend"),
        (WriteDesc { blend: 1.01, ..valid_desc.clone() }, "blend"),
        (WriteDesc { blend: f32::NAN, ..valid_desc.clone() }, "blend"),
        (WriteDesc { offset: f32::INFINITY, ..valid_desc.clone() }, "offset"),
        (WriteDesc { transform: with_nan, ..valid_desc.clone() }, "transform"),
        (WriteDesc { transform: infinite, ..valid_desc.clone() }, "transform"),
        (WriteDesc { transform: flat, ..valid_desc.clone() }, "transform"),
    ] {
        let error = cloth.write_vertices(&valid_streams(bytes), &desc).unwrap_err();
        assert!(matches!(error, Error::BadValue { field, .. } if field == words), "{error}");
        assert!(bytes.iter().all(|cell| cell.get() == 0xee), "{words}");
    }
    // A flat transform, such as a shadow on the floor, is valid for positions without normals.
    let desc = WriteDesc { transform: flat, ..valid_desc };
    let shadow = vectors(&written_values(&mut cloth, Attribute::Position, Format::F32, &desc), 3);
    assert!(shadow.iter().all(|p| p.y == 0.0));
}
