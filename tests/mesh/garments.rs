//! Garment meshes as cloth: repair reports, hanging until rest, and tears and cuts at seams.

use crate::common::crossings::crossing_count;
use crate::common::garments::{
    assert_mesh_invariants, defective_mesh, disc, moebius_strip, shirt, sleeve,
};
use muslin::glam::Vec3;
use muslin::{Cloth, Error, EventKind, Material, MeshDesc, Preset, SelfCollision, Settings};
use std::fmt::Write;

/// The garments, of cotton, without wind.
fn garments() -> Vec<(&'static str, MeshDesc)> {
    let garments = [
        ("shirt", shirt()),
        ("disc", disc()),
        ("sleeve", sleeve()),
        ("moebius strip", moebius_strip()),
        ("wreck", defective_mesh()),
    ];
    let with_settings = |(name, desc): (&'static str, MeshDesc)| {
        let settings = Settings { damping: 2.0, ..Settings::default() };
        let material = Material::preset(Preset::Cotton);
        (name, MeshDesc { settings, material, ..desc })
    };
    garments.into_iter().map(with_settings).collect()
}

/// RMS speed of the particles that have mass [m/s].
fn rms_speed(cloth: &Cloth) -> f32 {
    let moving = (0..cloth.particle_count()).filter(|p| cloth.mass(*p).unwrap() > 0.0);
    let speeds: Vec<f32> = moving.map(|p| cloth.velocity(p).unwrap().length_squared()).collect();
    (speeds.iter().sum::<f32>() / speeds.len() as f32).sqrt()
}

#[test]
fn mesh_reports_list_every_repair() {
    let mut text = String::new();
    for (name, desc) in garments() {
        let cloth = Cloth::mesh(&desc).unwrap();
        writeln!(text, "{name}: {:#?}", cloth.mesh_report()).unwrap();
    }
    insta::assert_snapshot!(text);
}

#[test]
fn hanging_garments_come_to_rest_within_ten_seconds() {
    for (name, desc) in garments() {
        let mut cloth = Cloth::mesh(&desc).unwrap();
        assert_mesh_invariants(&mut cloth, &desc);
        let start = cloth.positions().to_vec();
        cloth.step(600);
        assert_mesh_invariants(&mut cloth, &desc);
        let (speed, stats) = (rms_speed(&cloth), cloth.stats());
        println!("{name}: {speed:.6} m/s, stretched by {:.4} at most", stats.max_stretch);
        assert!(speed < 1.0e-3, "{name} moves at {speed} m/s after ten seconds");
        assert!(stats.max_stretch < 0.1, "{name} is stretched by {}", stats.max_stretch);
        let lowest = |list: &[Vec3]| list.iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
        let fallen = lowest(&start) - lowest(cloth.positions());
        assert!(fallen.abs() < 1.5, "{name} fell by {fallen} m");
        for vertex in &desc.pinned {
            let off = cloth.positions()[*vertex as usize].distance(start[*vertex as usize]);
            assert!(off < 1.0e-6, "{name}: pinned vertex {vertex} is {off} m off");
        }
    }
}

#[test]
fn hanging_garments_do_not_pass_through_themselves() {
    for (name, mut desc) in garments() {
        desc.settings.self_collision = SelfCollision::Surface;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let mut most = 0;
        let mut speeds = [0.0; 2];
        for speed in &mut speeds {
            for _ in 0..20 {
                cloth.step(30);
                most = most.max(crossing_count(&cloth));
            }
            *speed = rms_speed(&cloth);
        }
        println!("{name}: {most} crossings, {speeds:.6?} m/s");
        assert_eq!(most, 0, "{name} goes through itself");
        // Swinging parts lose half of their speed in two seconds with the default damping.
        assert!(speeds[0] < 5.0e-3, "{name} moves at {} m/s after ten seconds", speeds[0]);
        assert!(speeds[1] < 1.0e-3, "{name} moves at {} m/s after twenty seconds", speeds[1]);
    }
}

#[test]
fn vertices_without_triangles_do_not_move() {
    let desc = defective_mesh();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let unused: Vec<usize> =
        (0..desc.positions.len()).filter(|v| !desc.indices.contains(&(*v as u32))).collect();
    assert_eq!(unused.len(), 2);
    cloth.step(60);
    for vertex in unused {
        assert_eq!(cloth.positions()[vertex], desc.positions[vertex]);
        assert_eq!(cloth.normals()[vertex], Vec3::ZERO);
        assert_eq!(cloth.mass(cloth.vertex_particles()[vertex]), Some(0.0));
    }
}

#[test]
fn clone_restore_and_reset_of_a_torn_garment_give_the_same_bits() {
    for (name, desc) in garments() {
        let mut desc = desc;
        desc.settings.tearing = true;
        desc.material.tear_stretch = 1.2;
        let run_script = |cloth: &mut Cloth, ticks: u32| {
            let grab = cloth.grab_particle(cloth.particle_count() / 2).unwrap();
            let from = cloth.position(cloth.particle_count() / 2).unwrap();
            for tick in 1..=ticks {
                let target = from + Vec3::new(0.02, -0.01, 0.03) * tick as f32;
                cloth.move_grab(grab, target).unwrap();
                cloth.step(1);
            }
            cloth.release(grab).unwrap();
            let sweep = [Vec3::new(0.1, -0.31, -3.0), Vec3::new(0.3, -0.36, -3.0), Vec3::Z * 6.0];
            cloth.cut(sweep[0], sweep[1], sweep[2]).unwrap();
            cloth.step(10);
        };
        let mut straight = Cloth::mesh(&desc).unwrap();
        run_script(&mut straight, 30);
        assert_mesh_invariants(&mut straight, &desc);
        assert!(straight.positions().len() > desc.positions.len(), "{name} was not torn");
        let mut others = [straight.clone(), Cloth::restore(&straight.save()).unwrap()];
        run_script(&mut straight, 10);
        for other in &mut others {
            let capacity = other.view().vertex_capacity;
            assert_eq!(capacity, straight.view().vertex_capacity, "{name}");
            run_script(other, 10);
            assert_eq!(other.state_hash(), straight.state_hash(), "{name}");
            assert_eq!(other.indices(), straight.indices(), "{name}");
            assert_eq!(other.vertex_particles(), straight.vertex_particles(), "{name}");
            assert_eq!(other.source_vertices(), straight.source_vertices(), "{name}");
            assert_eq!(other.uvs(), straight.uvs(), "{name}");
            assert_eq!(other.mesh_report(), straight.mesh_report(), "{name}");
        }
        straight.reset();
        let fresh = Cloth::mesh(&desc).unwrap();
        assert_eq!(straight.state_hash(), fresh.state_hash(), "{name}");
        assert_eq!(straight.indices(), fresh.indices(), "{name}");
        assert_eq!(straight.vertex_particles(), fresh.vertex_particles(), "{name}");
    }
}

/// Two patches side by side, welded along the line x = 0.4, each with its own part of the texture.
fn seamed_sheet() -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 0.0, ..MeshDesc::default() };
    for (first, u) in [(0, 0.0), (4, 1.0)] {
        crate::common::garments::push_grid_patch(&mut desc, [5, 9], u, |x, y| {
            Vec3::new((first + x) as f32, -(y as f32), 0.0) * 0.1
        });
    }
    desc.pinned = (0..5).chain(45..50).collect();
    desc
}

/// The particle on the seam of the seamed sheet in a row, and its two vertices.
fn seam_particle(cloth: &Cloth, row: u32) -> (u32, [u32; 2]) {
    let vertices = [5 * row + 4, 45 + 5 * row];
    let [particle, same] = vertices.map(|v| cloth.vertex_particles()[v as usize]);
    assert_eq!(particle, same);
    (particle, vertices)
}

#[test]
fn a_cut_along_a_seam_adds_no_vertices() {
    let desc = seamed_sheet();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    assert_eq!((cloth.particle_count(), cloth.mesh_report().welded_vertices), (81, 9));
    let before = (cloth.indices().to_vec(), cloth.uvs().to_vec());
    let seam = [Vec3::new(0.4, -0.35, -1.0), Vec3::new(0.4, -2.0, -1.0), Vec3::Z * 2.0];
    assert_eq!(cloth.cut(seam[0], seam[1], seam[2]).unwrap(), 4);
    assert_eq!(
        (cloth.indices(), cloth.uvs()),
        (&*before.0, &*before.1),
        "each side keeps its own vertices"
    );
    assert_eq!(cloth.particle_count(), 85);
    let changes = cloth.changes(1);
    let changed = changes.first_vertex..changes.first_vertex + changes.vertex_count;
    assert!(changed.contains(&29) && changed.contains(&85), "{changes:?}");
    assert_eq!(changes.index_count, 0);
    assert_mesh_invariants(&mut cloth, &desc);
    let mut split = Vec::new();
    while let Some(event) = cloth.next_event() {
        if event.kind == EventKind::VertexSplit {
            assert_eq!(event.vertex, event.source, "no vertex had to be split");
            split.push(event.vertex);
        }
    }
    let expected: Vec<u32> = (5..9).map(|row| 45 + 5 * row).collect();
    assert_eq!(split, expected);
    for vertex in split {
        let opposite = 5 * ((vertex - 45) / 5) + 4;
        let [a, b] = [vertex, opposite].map(|v| cloth.vertex_particles()[v as usize]);
        assert_ne!(a, b);
        assert!(cloth.frayed()[vertex as usize] && cloth.frayed()[opposite as usize]);
    }
}

#[test]
fn a_cut_across_a_seam_adds_one_vertex_on_each_side() {
    let desc = seamed_sheet();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let count = cloth.positions().len() as u32;
    let blade = [Vec3::new(0.27, -0.44, -1.0), Vec3::new(0.53, -0.46, -1.0), Vec3::Z * 2.0];
    assert!(cloth.cut(blade[0], blade[1], blade[2]).unwrap() > 0);
    assert_mesh_invariants(&mut cloth, &desc);
    let (top, _) = seam_particle(&cloth, 4);
    let (bottom, _) = seam_particle(&cloth, 5);
    let mut seam_vertex = None;
    while let Some(event) = cloth.next_event() {
        let ends = [event.particle_a, event.particle_b];
        if event.kind == EventKind::EdgeDivided && ends.contains(&top) && ends.contains(&bottom) {
            seam_vertex = Some(event.vertex);
        }
    }
    let vertex = seam_vertex.expect("the cut crosses the seam");
    assert!(vertex >= count);
    let [one, other] = [vertex, vertex + 1].map(|v| v as usize);
    let (uvs, particles) = (cloth.uvs(), cloth.vertex_particles());
    assert_eq!(particles[one], particles[other]);
    assert!((uvs[one].y - uvs[other].y).abs() < 1.0e-6);
    assert!((uvs[one].x - 0.0625).abs() < 1.0e-6 || (uvs[one].x - 1.0).abs() < 1.0e-6);
    assert!((uvs[one].x - uvs[other].x).abs() > 0.9, "each side has its own part of the texture");
}

#[test]
fn a_tear_across_a_seam_keeps_the_uvs_of_both_sides() {
    let mut desc = seamed_sheet();
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.3;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let whole = (cloth.indices().to_vec(), cloth.uvs().to_vec());
    let (particle, _) = seam_particle(&cloth, 6);
    let grab = cloth.grab_particle(particle).unwrap();
    for tick in 1..=60 {
        let target = Vec3::new(0.4 + 0.004 * tick as f32, -0.6 - 0.02 * tick as f32, 0.1);
        cloth.move_grab(grab, target).unwrap();
        cloth.step(1);
        assert_mesh_invariants(&mut cloth, &desc);
    }
    let (sources, uvs) = (cloth.source_vertices(), cloth.uvs());
    assert!(cloth.positions().len() > desc.positions.len() + 4, "the cloth tore");
    for (now, then) in cloth.indices().iter().zip(&whole.0) {
        assert_eq!(sources[*now as usize], *then, "each corner keeps its source vertex");
        assert_eq!(uvs[*now as usize], whole.1[*then as usize], "each corner keeps its uv");
    }
    // Single steps and one long step give the same vertices with the same indices.
    let torn = |in_single_steps: bool| {
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let grab = cloth.grab_particle(particle).unwrap();
        cloth.move_grab(grab, Vec3::new(0.6, -1.6, 0.1)).unwrap();
        let ticks = if in_single_steps { vec![1; 80] } else { vec![80] };
        ticks.into_iter().for_each(|ticks| cloth.step(ticks));
        (cloth.indices().to_vec(), cloth.vertex_particles().to_vec())
    };
    assert_eq!(torn(true), torn(false));
}

#[test]
fn view_pointers_stay_valid_through_tears_and_cuts_of_seams() {
    let mut desc = seamed_sheet();
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.1;
    desc.extra_particles = 100;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let addresses = |cloth: &mut Cloth| {
        let view = cloth.view();
        (
            [view.positions.as_ptr(), view.normals.as_ptr()],
            [view.indices.as_ptr(), view.source_vertices.as_ptr(), view.particles.as_ptr()],
            (view.uvs.as_ptr(), view.frayed.as_ptr(), view.vertex_capacity),
        )
    };
    let first = addresses(&mut cloth);
    // Particles on the seam have two vertices, so the capacity is two for each extra particle.
    assert_eq!(first.2.2, 90 + 2 * 100);
    let grab = cloth.grab_particle(60).unwrap();
    for tick in 1..=30 {
        cloth.move_grab(grab, Vec3::new(0.5, -0.6, 0.05 * tick as f32)).unwrap();
        cloth.step(1);
    }
    assert!(cloth.particle_count() > 81, "the cloth tore");
    assert_eq!(addresses(&mut cloth), first);
    let heights = (0..8).map(|row| -0.05 - 0.1 * row as f32);
    let cut = |y: f32| cloth.cut(Vec3::new(-1.0, y, -9.0), Vec3::new(2.0, y, -9.0), Vec3::Z * 18.0);
    let cuts: Vec<Result<u32, Error>> = heights.map(cut).collect();
    assert!(cuts.iter().flatten().any(|opened| *opened > 4), "{cuts:?}");
    assert!(cuts.contains(&Err(Error::Full { what: "the whole cut" })), "{cuts:?}");
    assert_mesh_invariants(&mut cloth, &desc);
    assert_eq!(addresses(&mut cloth), first);
}
