//! Skins on whole cloth: binding, motion, curvature, output and refusals.

use crate::common::bare_grid;
use crate::common::garments::shirt;
use crate::common::skins::{assert_skin_invariants, icosphere, sheet, skin_of, updated};
use core::cell::Cell;
use muslin::glam::{Affine3, Mat3, Quat, Vec2, Vec3};
use muslin::{
    Attribute, Cloth, Error, GridDesc, MeshDesc, PinMode, Skin, SkinDesc, Stream, VertexFormat,
    WriteDesc,
};

/// A coarse sheet of 1.1 m x 0.9 m that hangs by a corner after some ticks.
fn coarse_sheet() -> Cloth {
    Cloth::grid(&bare_grid(12, 10, 0.1, PinMode::TopCorners)).unwrap()
}

/// A fine skin of `coarse_sheet`.
fn fine_sheet() -> SkinDesc {
    sheet(67, 55, Vec3::ZERO, Vec2::new(1.1, -0.9))
}

fn assert_near(one: &[Vec3], other: &[Vec3], most: f32) {
    assert_eq!(one.len(), other.len());
    for (at, (a, b)) in one.iter().zip(other).enumerate() {
        assert!((*a - *b).length() <= most, "vertex {at}: {a} is not {b}");
    }
}

#[test]
fn a_new_skin_has_the_given_shape() {
    let mut cloth = coarse_sheet();
    let desc = fine_sheet();
    assert_near(updated(&cloth, &desc).positions(), &desc.positions, 1.0e-6);
    cloth.step(60);
    // Any shape near the present pose: here the sheet itself, moved by 3 cm along its normals.
    let mut given = SkinDesc {
        positions: cloth.positions().to_vec(),
        indices: cloth.indices().to_vec(),
        ..SkinDesc::default()
    };
    let normals = cloth.normals().to_vec();
    given.positions.iter_mut().zip(&normals).for_each(|(x, n)| *x += *n * 0.03);
    let skin = updated(&cloth, &given);
    assert_near(skin.positions(), &given.positions, 1.0e-6);
}

#[test]
fn vertices_at_particles_have_the_bits_of_the_particles() {
    for smoothness in [0.0, 0.5, 1.0] {
        for mesh in [None, Some(shirt())] {
            let mut cloth = mesh.map_or_else(coarse_sheet, |mesh| Cloth::mesh(&mesh).unwrap());
            let desc = SkinDesc {
                positions: cloth.positions().to_vec(),
                indices: cloth.indices().to_vec(),
                smoothness,
                ..SkinDesc::default()
            };
            let mut skin = updated(&cloth, &desc);
            cloth.step(60);
            skin.update(&cloth).unwrap();
            assert_eq!(skin.positions(), cloth.positions());
            assert_skin_invariants(&skin, &desc);
        }
    }
}

#[test]
fn flat_triangles_carry_their_points_by_barycentric_weights() {
    let mut cloth = coarse_sheet();
    // The middle of each triangle of the cloth.
    let middles = |cloth: &Cloth| -> Vec<Vec3> {
        let middle =
            |t: &[u32]| t.iter().map(|v| cloth.positions()[*v as usize]).sum::<Vec3>() / 3.0;
        cloth.indices().chunks_exact(3).map(middle).collect()
    };
    let desc = SkinDesc {
        positions: middles(&cloth),
        indices: vec![0, 1, 2],
        smoothness: 0.0,
        ..SkinDesc::default()
    };
    let mut skin = updated(&cloth, &desc);
    cloth.step(90);
    skin.update(&cloth).unwrap();
    assert_near(skin.positions(), &middles(&cloth), 1.0e-6);
}

#[test]
fn a_skin_turns_with_a_rigid_motion_of_its_cloth() {
    let mut mesh = icosphere(1);
    mesh.settings.gravity = Vec3::ZERO;
    let mut cloth = Cloth::mesh(&mesh).unwrap();
    // A bumpy surface around the cloth, so that offsets and normals have all directions.
    let mut desc = skin_of(&icosphere(3));
    let bump = |x: &Vec3| 1.0 + 0.05 * (x.x * 9.0).sin() + 0.05 * (x.y * 11.0).cos();
    desc.positions.iter_mut().for_each(|x| *x *= bump(x));
    let mut skin = updated(&cloth, &desc);
    let normals = skin.normals().to_vec();
    let (turn, shift) =
        (Quat::from_rotation_x(0.7) * Quat::from_rotation_y(2.0), Vec3::new(3.0, 1.0, -2.0));
    cloth.teleport(shift, turn).unwrap();
    skin.update(&cloth).unwrap();
    let expected: Vec<Vec3> = desc.positions.iter().map(|x| turn * *x + shift).collect();
    assert_near(skin.positions(), &expected, 5.0e-6);
    let expected: Vec<Vec3> = normals.iter().map(|n| turn * *n).collect();
    assert_near(skin.normals(), &expected, 5.0e-6);
}

#[test]
fn a_fine_sphere_on_a_coarse_one_is_round_where_it_is_bound() {
    let cloth = Cloth::mesh(&icosphere(1)).unwrap();
    for smoothness in [0.0, 1.0] {
        let skin = updated(&cloth, &SkinDesc { smoothness, ..skin_of(&icosphere(3)) });
        for (x, n) in skin.positions().iter().zip(skin.normals()) {
            assert!((x.length() - 1.0).abs() < 1.0e-5 && n.dot(*x) > 0.999, "{n} at {x}");
        }
    }
}

#[test]
fn a_sheet_bent_to_an_arc_is_round_between_the_particles() {
    // A strip of nine columns is bent to half a circle.
    let mut desc = bare_grid(9, 3, 0.1, PinMode::None);
    desc.settings.gravity = Vec3::ZERO;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let given = sheet(161, 3, Vec3::ZERO, Vec2::new(0.8, -0.2));
    let mut skins =
        [0.0, 1.0].map(|smoothness| updated(&cloth, &SkinDesc { smoothness, ..given.clone() }));
    let radius = 0.8 / std::f32::consts::PI;
    for particle in 0..27_u32 {
        let (sin, cos) = ((particle % 9) as f32 * std::f32::consts::PI / 8.0).sin_cos();
        let y = -0.1 * (particle / 9) as f32;
        cloth.set_position(particle, Vec3::new(radius * cos, y, radius * sin)).unwrap();
    }
    // The largest distance from the circle, in the columns that are not at the ends.
    let error = |skin: &mut Skin| {
        skin.update(&cloth).unwrap();
        let inner = (0..161 * 3).filter(|v| (20..141).contains(&(v % 161)));
        let off = |v: usize| (skin.positions()[v].with_y(0.0).length() - radius).abs();
        inner.map(off).fold(0.0, f32::max)
    };
    let [flat, curved] = [error(&mut skins[0]), error(&mut skins[1])];
    println!("off the circle by {flat} m flat, {curved} m curved");
    // The chord of an eighth of half a circle is 1.9 % of the radius below it.
    assert!((flat / radius - 0.019).abs() < 0.002, "{flat}");
    assert!(curved < 0.05 * flat, "{curved}");
}

#[test]
fn a_closed_cloth_has_a_closed_skin() {
    let mut mesh = icosphere(2);
    mesh.settings.gravity = Vec3::new(0.0, -9.8, 0.0);
    let mut cloth = Cloth::mesh(&mesh).unwrap();
    let desc = skin_of(&icosphere(4));
    let mut skin = updated(&cloth, &desc);
    cloth.step(20);
    skin.update(&cloth).unwrap();
    assert_skin_invariants(&skin, &desc);
    assert_eq!(skin.indices(), desc.indices, "a skin of whole cloth has the given triangles");
    assert_eq!(skin.topology_revision(), 1);
}

#[test]
fn duplicated_vertices_of_a_texture_seam_stay_together() {
    let mut cloth = coarse_sheet();
    // Every triangle has vertices of its own.
    let shared = fine_sheet();
    let of = |v: &u32| shared.positions[*v as usize];
    let desc = SkinDesc {
        positions: shared.indices.iter().map(of).collect(),
        indices: (0..shared.indices.len() as u32).collect(),
        ..SkinDesc::default()
    };
    let mut skin = updated(&cloth, &desc);
    cloth.step(60);
    skin.update(&cloth).unwrap();
    let mut first = vec![None; shared.positions.len()];
    for (at, v) in shared.indices.iter().enumerate() {
        let found = (skin.positions()[at], skin.normals()[at]);
        assert_eq!(*first[*v as usize].get_or_insert(found), found, "vertex {at}");
    }
}

#[test]
fn an_open_seam_of_the_cloth_is_open_in_the_skin() {
    // Two sheets side by side, not welded.
    let half = |x: f32| sheet(5, 9, Vec3::new(x, 0.0, 0.0), Vec2::new(0.4, -0.8));
    let (left, right) = (half(0.0), half(0.4));
    let mut mesh =
        MeshDesc { positions: left.positions, indices: left.indices, ..MeshDesc::default() };
    mesh.indices.extend(right.indices.iter().map(|v| v + 45));
    mesh.positions.extend(&right.positions);
    mesh.pinned = vec![0, 36];
    let mut cloth = Cloth::mesh(&mesh).unwrap();
    // One skin across both; its vertices on the seam are shared.
    let whole = sheet(65, 65, Vec3::ZERO, Vec2::new(0.8, -0.8));
    let mut skin = updated(&cloth, &whole);
    assert!(skin.frayed().iter().all(|frayed| !frayed), "an open seam is no tear");
    // And one whose sides have vertices of their own, which need no copies.
    let half = |x: f32| sheet(33, 65, Vec3::new(x, 0.0, 0.0), Vec2::new(0.4, -0.8));
    let (mut sides, right) = (half(0.0), half(0.4));
    sides.indices.extend(right.indices.iter().map(|v| v + 33 * 65));
    sides.positions.extend(&right.positions);
    sides.uvs.extend(&right.uvs);
    let mut sided = updated(&cloth, &sides);
    assert_eq!(sided.positions().len(), sides.positions.len());
    cloth.step(40);
    assert!((cloth.positions()[49] - cloth.positions()[4]).length() > 0.05, "the halves part");
    for (skin, desc) in [(&mut skin, &whole), (&mut sided, &sides)] {
        skin.update(&cloth).unwrap();
        assert_skin_invariants(skin, desc);
        let ratio = crate::common::skins::longest_edge_ratio(skin, desc);
        assert!(ratio < 1.5, "an edge is {ratio} times as long");
    }
}

/// Writes one attribute as f32 and returns the numbers.
fn written(skin: &mut Skin, cloth: &Cloth, attribute: Attribute, desc: &WriteDesc) -> Vec<f32> {
    let width = VertexFormat::F32.width(attribute).unwrap() / 4;
    let count = skin.positions().len() - desc.first_vertex as usize;
    let mut words = vec![0.0_f32; width * count];
    // SAFETY: every bit pattern is a valid `u8` and a valid `f32`.
    let bytes = unsafe { words.align_to_mut::<u8>().1 };
    let bytes = Cell::from_mut(bytes).as_slice_of_cells();
    let stream = Stream { attribute, format: VertexFormat::F32, stride: 0, bytes };
    skin.write_vertices(cloth, &[stream], desc).unwrap();
    words
}

fn vectors(numbers: &[f32], each: usize) -> Vec<Vec3> {
    numbers.chunks_exact(each).map(Vec3::from_slice).collect()
}

#[test]
fn streams_equal_the_lists() {
    let mut cloth = coarse_sheet();
    let desc = fine_sheet();
    let mut skin = updated(&cloth, &desc);
    cloth.step(50);
    skin.update(&cloth).unwrap();
    for first_vertex in [0, 70] {
        let write = WriteDesc { first_vertex, ..WriteDesc::default() };
        let from = first_vertex as usize;
        let numbers = written(&mut skin, &cloth, Attribute::Position, &write);
        assert_eq!(vectors(&numbers, 3), skin.positions()[from..]);
        let numbers = written(&mut skin, &cloth, Attribute::Normal, &write);
        assert_eq!(vectors(&numbers, 3), skin.normals()[from..]);
        let numbers = written(&mut skin, &cloth, Attribute::Uv, &write);
        assert_eq!(
            numbers,
            skin.uvs()[from..].iter().flat_map(|uv| uv.to_array()).collect::<Vec<_>>()
        );
        let numbers = written(&mut skin, &cloth, Attribute::Frayed, &write);
        assert!(numbers.iter().all(|frayed| *frayed == 0.0));
    }
}

#[test]
fn tangents_are_unit_vectors_along_the_texture() {
    let mut cloth = coarse_sheet();
    let mut skin = updated(&cloth, &fine_sheet());
    cloth.step(20);
    skin.update(&cloth).unwrap();
    let numbers = written(&mut skin, &cloth, Attribute::Tangent, &WriteDesc::default());
    let tangents = vectors(&numbers, 4);
    for (v, (t, n)) in tangents.iter().zip(skin.normals()).enumerate() {
        assert!((t.length() - 1.0).abs() < 1.0e-5 && t.dot(*n).abs() < 1.0e-5);
        // v grows downwards in the given plane, to the right of u.
        assert_eq!(numbers[4 * v + 3], -1.0);
        if v % 67 < 66 {
            let along = (skin.positions()[v + 1] - skin.positions()[v]).normalize();
            assert!(t.dot(along) > 0.9, "vertex {v}: {t} along {along}");
        }
    }
}

#[test]
fn blends_transforms_and_offsets_apply_to_the_skin() {
    let mut cloth = coarse_sheet();
    let mut skin = updated(&cloth, &fine_sheet());
    cloth.step(30);
    skin.update(&cloth).unwrap();
    let before = skin.positions().to_vec();
    cloth.step(1);
    let last = written(
        &mut skin,
        &cloth,
        Attribute::Position,
        &WriteDesc { blend: 0.0, ..WriteDesc::default() },
    );
    assert_near(&vectors(&last, 3), &before, 1.0e-6);
    skin.update(&cloth).unwrap();
    let transform = Affine3 {
        matrix3: Mat3::from_quat(Quat::from_rotation_z(0.5)) * 2.0,
        translation: Vec3::new(1.0, 2.0, 3.0),
    };
    let write = WriteDesc { transform, offset: 0.01, flip_normals: true, ..WriteDesc::default() };
    let numbers = written(&mut skin, &cloth, Attribute::Position, &write);
    let lists = skin.positions().iter().zip(skin.normals());
    let expected: Vec<Vec3> =
        lists.map(|(x, n)| transform.transform_point3(*x - *n * 0.01)).collect();
    assert_near(&vectors(&numbers, 3), &expected, 1.0e-5);
    let numbers = written(&mut skin, &cloth, Attribute::Normal, &write);
    let expected: Vec<Vec3> =
        skin.normals().iter().map(|n| (transform.matrix3 * -*n).normalize()).collect();
    assert_near(&vectors(&numbers, 3), &expected, 1.0e-5);
}

#[test]
fn a_skin_far_from_zero_is_as_exact_as_near_it() {
    let far = Vec3::new(4000.0, 1000.0, -2000.0);
    let mut desc = bare_grid(12, 10, 0.1, PinMode::TopCorners);
    desc.origin = far;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let mut skin = updated(&cloth, &sheet(67, 55, far, Vec2::new(1.1, -0.9)));
    let mut near_cloth = coarse_sheet();
    let mut near = updated(&near_cloth, &fine_sheet());
    cloth.step(30);
    near_cloth.step(30);
    near.update(&near_cloth).unwrap();
    let write = WriteDesc { relative: true, ..WriteDesc::default() };
    let numbers = written(&mut skin, &cloth, Attribute::Position, &write);
    let origin = cloth.origin() - far;
    let relative: Vec<Vec3> = vectors(&numbers, 3).iter().map(|x| *x + origin).collect();
    // The given positions are rounded to 0.25 mm there.
    assert_near(&relative, near.positions(), 5.0e-4);
}

#[test]
fn a_skin_fits_clones_and_restored_copies_and_no_other_cloth() {
    let mut cloth = coarse_sheet();
    let mut skin = updated(&cloth, &fine_sheet());
    cloth.step(10);
    let (clone, restored) = (cloth.clone(), Cloth::restore(&cloth.save()).unwrap());
    skin.update(&cloth).unwrap();
    let (positions, mut copy) = (skin.positions().to_vec(), skin.clone());
    for cloth in [&clone, &restored] {
        skin.update(cloth).unwrap();
        copy.update(cloth).unwrap();
        assert_eq!(skin.positions(), positions);
        assert_eq!(copy.positions(), positions);
    }
    let other = Cloth::grid(&GridDesc::default()).unwrap();
    assert_eq!(skin.update(&other), Err(Error::BadHandle { what: "skin" }));
    assert_eq!(skin.positions(), positions);
}

#[test]
fn wrong_descriptors_are_refused_with_field_and_rule() {
    let cloth = coarse_sheet();
    let refusal = |change: &dyn Fn(&mut SkinDesc)| {
        let mut desc = fine_sheet();
        change(&mut desc);
        Skin::new(&cloth, &desc).unwrap_err().to_string()
    };
    let is = |change: &dyn Fn(&mut SkinDesc), message: &str| assert_eq!(refusal(change), message);
    is(&|desc| *desc = SkinDesc::default(), "`positions` must hold at least 3 vertices");
    is(&|desc| desc.positions[7].y = f32::NAN, "`positions` must be finite");
    let triples = "`indices` must hold three entries for each of one or more triangles";
    is(&|desc| desc.indices.clear(), triples);
    is(&|desc| desc.indices.truncate(5), triples);
    is(&|desc| desc.indices[4] = 3685, "`indices` must be below 3685, but is 3685");
    is(&|desc| desc.uvs.truncate(9), "`uvs` must have as many entries as `positions`, or none");
    is(&|desc| desc.uvs[3].x = f32::INFINITY, "`uvs` must be finite");
    is(&|desc| desc.smoothness = 1.5, "`smoothness` must be from 0 to 1");
    is(&|desc| desc.smoothness = f32::NAN, "`smoothness` must be from 0 to 1");
    // Half the diagonal of 1.1 m x 0.9 m is 0.71 m.
    is(
        &|desc| desc.positions[0].z = 0.72,
        "`positions` must be within half the diagonal of the cloth's bounding box of the cloth",
    );
    let mut near = fine_sheet();
    near.positions[0].z = 0.7;
    assert!(Skin::new(&cloth, &near).is_ok());
}
