//! Painted maps of stretch, bend, tear and drag, against closed forms and unpainted cloths.

use crate::common::bare_grid;
use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, GridDesc, Map, Material, MeshDesc, PinMode, Wind};

/// Scales of all particles of a cloth, by their rest position.
fn painted(cloth: &Cloth, scale: impl Fn(Vec3) -> f32) -> Vec<f32> {
    cloth.rest_positions().map(scale).collect()
}

/// The same sheet as a mesh whose diagonals all fall, which is bent by hinges.
fn as_mesh(desc: &GridDesc) -> MeshDesc {
    let cloth = Cloth::grid(desc).unwrap();
    let mut indices = Vec::new();
    for row in 0..desc.rows - 1 {
        for column in 0..desc.columns - 1 {
            let a = row * desc.columns + column;
            let (b, c) = (a + 1, a + desc.columns);
            indices.extend([a, c, c + 1, a, c + 1, b]);
        }
    }
    MeshDesc {
        positions: cloth.positions().to_vec(),
        indices,
        pinned: cloth.pinned().collect(),
        material: desc.material.clone(),
        settings: desc.settings.clone(),
        ..MeshDesc::default()
    }
}

/// The same sheet twice: bent by plate elements, and by hinges.
fn grid_and_mesh(desc: &GridDesc) -> [Cloth; 2] {
    let mesh = Cloth::mesh(&as_mesh(desc)).unwrap();
    assert!(!mesh.mesh_report().is_grid);
    [Cloth::grid(desc).unwrap(), mesh]
}

/// Columns of the cantilever, of which the first two are clamped.
const NODES: u32 = 26;

/// A horizontal cantilever along x.
fn cantilever(bend_stiffness: f32) -> GridDesc {
    let mut desc = bare_grid(NODES, 4, 0.01, PinMode::None);
    desc.down = Vec3::Z;
    desc.material = Material { bend_stiffness, ..desc.material };
    desc.settings.damping = 4.0;
    desc
}

/// Clamps a cantilever, lets it come to rest, and returns its middle line.
fn droop(mut cloth: Cloth) -> Vec<Vec3> {
    let clamped: Vec<u32> = (0..4).flat_map(|row| [row * NODES, row * NODES + 1]).collect();
    clamped.iter().for_each(|particle| cloth.pin(*particle, None).unwrap());
    cloth.step(1200);
    let mean = |column: u32| {
        (0..4).map(|row| cloth.positions()[(row * NODES + column) as usize]).sum::<Vec3>() * 0.25
    };
    (0..NODES).map(mean).collect()
}

#[test]
fn a_sheet_painted_stiffer_everywhere_bends_like_a_stiffer_material() {
    // Across the strip, so that elements leave the grid, and along it through triangles.
    let blades = [(0.122, 0.122, 0.012, 1.0), (0.08, 0.2, 0.013, 0.017)];
    for scale in [0.2, 5.0, 60.0] {
        for cuts in 0..3 {
            let cut = |cloth: &mut Cloth| {
                for (from, to, z, end) in &blades[..cuts] {
                    let (from, to) = (Vec3::new(*from, 1.0, *z), Vec3::new(*to, 1.0, *end));
                    assert!(cloth.cut(from, to, Vec3::NEG_Y * 2.0).unwrap() > 0);
                }
            };
            let stiffer = grid_and_mesh(&cantilever(2.5e-5 * scale));
            for (mut stiffer, mut cloth) in
                stiffer.into_iter().zip(grid_and_mesh(&cantilever(2.5e-5)))
            {
                cloth.set_map(Map::Bend, Some(&painted(&cloth, |_| scale))).unwrap();
                [&mut stiffer, &mut cloth].into_iter().for_each(cut);
                let [a, b] = [stiffer, cloth].map(|cloth| droop(cloth)[NODES as usize - 1]);
                let off = a.distance(b);
                println!("scale {scale}, {cuts} cuts: the tips are {off:.1e} m apart");
                assert!(off < 1.0e-3, "scale {scale}, {cuts} cuts: {off} m");
            }
        }
    }
}

#[test]
fn a_painted_stiff_half_bends_less_and_a_painted_limp_half_hangs_down() {
    // Slope at a column [rad].
    let slope = |line: &[Vec3], column: usize| {
        let d = line[column + 1] - line[column];
        (-d.y).atan2(d.x)
    };
    let outer = |x: Vec3| x.x > 0.125;
    for [plain, mut stiff, mut limp] in {
        let [a, b, c] = [(); 3].map(|()| grid_and_mesh(&cantilever(2.0e-3)));
        a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c])
    } {
        stiff
            .set_map(Map::Bend, Some(&painted(&stiff, |x| if outer(x) { 1.0 } else { 20.0 })))
            .unwrap();
        limp.set_map(Map::Bend, Some(&painted(&limp, |x| if outer(x) { 0.0 } else { 1.0 })))
            .unwrap();
        let [plain, stiff, limp] = [plain, stiff, limp].map(droop);
        let [at_plain, at_stiff] = [&plain, &stiff].map(|line| slope(line, 11));
        println!("slope in the middle: {at_plain:.3} rad plain, {at_stiff:.3} rad painted stiff");
        assert!(at_plain > 0.2 && at_stiff < 0.1 * at_plain, "{at_plain} {at_stiff}");
        let bend = |line: &[Vec3]| slope(line, 24) - slope(line, 13);
        assert!(bend(&stiff) > 0.5 * bend(&plain), "the outer half bends as before");
        assert!(slope(&plain, 23) < 1.2, "{}", slope(&plain, 23));
        assert!((16..25).all(|k| slope(&limp, k) > 1.5), "{limp:?}");
    }
}

/// Rows of the hanging strip.
const ROWS: u32 = 24;

/// A strip that hangs from its top edge, with this stretch stiffness [N/m].
fn hanging_strip(stiffness: f32) -> GridDesc {
    let mut desc = bare_grid(4, ROWS, 0.02, PinMode::TopEdge);
    desc.material = Material {
        stretch_stiffness_warp: stiffness,
        stretch_stiffness_weft: stiffness,
        // Diagonals would carry a part of the weight.
        shear_stiffness: if stiffness > 0.0 { 1.0e-3 } else { 0.0 },
        bend_stiffness: 0.0,
        ..desc.material
    };
    desc.settings.damping = 4.0;
    desc
}

/// Strain of each row of warp links of a strip at rest.
fn strains(cloth: &mut Cloth) -> Vec<f32> {
    cloth.step(1200);
    let y = |row: u32| cloth.positions()[(4 * row + 1) as usize].y;
    (0..ROWS - 1).map(|row| (y(row) - y(row + 1)) / 0.02 - 1.0).collect()
}

#[test]
fn painted_links_stretch_by_weight_over_their_scaled_stiffness() {
    // The weight below the middle of link k, per width, is σ g (rows below) · spacing.
    let stiffness = 40.0;
    let mut cloth = Cloth::grid(&hanging_strip(stiffness)).unwrap();
    let scale = |row: f32| if row < 10.0 { 0.5 } else { 2.0 };
    let scales = painted(&cloth, |x| scale(x.y / -0.02 + 0.5));
    cloth.set_map(Map::Stretch, Some(&scales)).unwrap();
    let strains = strains(&mut cloth);
    for (row, strain) in strains.into_iter().enumerate() {
        let ends = [row, row + 1].map(|row| scales[4 * row]);
        let below = (ROWS as usize - 1 - row) as f32 - 0.5;
        let load = cloth.material().density * 9.81 * (below + 0.5) * 0.02;
        let exact = load / (stiffness * 0.5 * (ends[0] + ends[1]));
        println!("link {row}: strain {strain:.5}, reference {exact:.5}");
        assert!((strain - exact).abs() < 0.06 * exact + 2.0e-4, "link {row}: {strain} {exact}");
    }
}

#[test]
fn links_painted_zero_do_not_resist_and_rigid_links_stay_rigid() {
    let painted_strip = |stiffness: f32| {
        let mut cloth = Cloth::grid(&hanging_strip(stiffness)).unwrap();
        let scales = painted(&cloth, |x| if (-0.21..-0.15).contains(&x.y) { 0.0 } else { 1.0 });
        cloth.set_map(Map::Stretch, Some(&scales)).unwrap();
        cloth.step(12);
        cloth
    };
    let soft = painted_strip(2000.0);
    let fallen = -soft.positions()[4 * ROWS as usize - 2].y - 0.02 * (ROWS - 1) as f32;
    println!("the lower end fell by {fallen} m");
    assert!(fallen > 0.05 && fallen < 0.5 * 9.81 * 0.04, "{fallen} m");
    let (rigid, mut plain) = (painted_strip(0.0), Cloth::grid(&hanging_strip(0.0)).unwrap());
    plain.step(12);
    assert_eq!(rigid.positions(), plain.positions());
}

/// Pulls a sheet apart until something tears; returns the rest heights of the particles of all torn
/// edges [m].
fn torn_heights(mut cloth: Cloth) -> Vec<f32> {
    let bottom: Vec<u32> = (19 * 12..20 * 12).collect();
    bottom.iter().for_each(|particle| cloth.pin(*particle, None).unwrap());
    let start = cloth.positions().to_vec();
    let rest: Vec<f32> = cloth.rest_positions().map(|x| x.y).collect();
    let mut heights = Vec::new();
    for tick in 1..400 {
        let by = Vec3::NEG_Y * (0.001 * tick as f32);
        for particle in &bottom {
            cloth.pin(*particle, Some(start[*particle as usize] + by)).unwrap();
        }
        cloth.step(1);
        while let Some(event) = cloth.next_event() {
            if event.kind == EventKind::EdgeTorn {
                let sources = cloth.source_vertices();
                let ends = [event.particle_a, event.particle_b];
                heights.extend(ends.map(|end| rest[sources[end as usize] as usize]));
            }
        }
        if cloth.stats().pieces > 1 {
            return heights;
        }
    }
    heights
}

#[test]
fn a_painted_weak_line_tears_first_and_only_there() {
    let mut desc = bare_grid(12, 20, 0.02, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material = Material {
        tear_stretch: 2.0,
        stretch_stiffness_warp: 500.0,
        stretch_stiffness_weft: 500.0,
        ..desc.material
    };
    // Rows 12 and 13.
    let is_weak = |y: f32| (-0.27..-0.23).contains(&y);
    for cloth in grid_and_mesh(&desc) {
        let (plain, mut weak) = (cloth.clone(), cloth);
        let scales = painted(&weak, |x| if is_weak(x.y) { 0.1 } else { 1.0 });
        weak.set_map(Map::Tear, Some(&scales)).unwrap();
        let [plain, weak] = [plain, weak].map(torn_heights);
        assert!(weak.len() >= 22, "{} ends", weak.len());
        assert!(weak.iter().all(|y| (-0.29..-0.21).contains(y)), "{weak:?}");
        assert!(plain.iter().any(|y| !(-0.29..-0.21).contains(y)), "unpainted: {plain:?}");
    }
}

#[test]
fn a_sheet_painted_strong_does_not_tear() {
    let mut desc = bare_grid(12, 20, 0.02, PinMode::TopEdge);
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.2;
    let mut cloth = Cloth::grid(&desc).unwrap();
    assert!(!torn_heights(cloth.clone()).is_empty());
    cloth.set_map(Map::Tear, Some(&[1000.0; 240])).unwrap();
    assert_eq!(torn_heights(cloth), []);
}

/// A free sheet across the wind, without gravity.
fn kite() -> GridDesc {
    let mut desc = bare_grid(16, 12, 0.05, PinMode::None);
    desc.settings.gravity = Vec3::ZERO;
    desc.material = Material { drag: 1.2, lift: 0.0, ..desc.material };
    desc
}

#[test]
fn drag_is_multiplied_by_the_mean_scale_of_the_corners() {
    for cloth in grid_and_mesh(&kite()) {
        // Momentum along the wind after one tick. The wind is so weak that the cloth takes up little
        // of its speed in that time: the force is proportional to the drag.
        let momentum = |scale: &dyn Fn(Vec3) -> f32| {
            let mut cloth = cloth.clone();
            let wind = Wind { velocity: Vec3::Z * 0.3, gust: 0.0, ..Wind::default() };
            cloth.set_wind(wind).unwrap();
            cloth.set_map(Map::Drag, Some(&painted(&cloth, scale))).unwrap();
            cloth.step(1);
            cloth.mass_properties().momentum.z
        };
        let one = momentum(&|_| 1.0);
        let mut plain = cloth.clone();
        plain.set_wind(Wind { velocity: Vec3::Z * 0.3, gust: 0.0, ..Wind::default() }).unwrap();
        plain.step(1);
        assert_eq!(plain.mass_properties().momentum.z, one);
        for scale in [0.0_f32, 0.25, 2.0] {
            let ratio = momentum(&|_| scale) / one;
            assert!((ratio - scale).abs() < 0.01, "scale {scale}: {ratio}");
        }
        let ramp = momentum(&|x| x.x / 0.75) / one;
        assert!((ramp - 0.5).abs() < 0.01, "a ramp from 0 to 1: {ramp}");
    }
}

#[test]
fn wind_blows_the_half_with_more_drag_farther() {
    let mut desc = kite();
    desc.pin_mode = PinMode::TopEdge;
    desc.settings = muslin::Settings::default();
    for mut cloth in grid_and_mesh(&desc) {
        cloth.set_wind(Wind { velocity: Vec3::Z * 3.0, gust: 0.0, ..Wind::default() }).unwrap();
        let scales = painted(&cloth, |x| if x.x > 0.375 { 1.0 } else { 0.05 });
        cloth.set_map(Map::Drag, Some(&scales)).unwrap();
        let mut reach = [0.0_f32; 2];
        for _ in 0..600 {
            cloth.step(1);
            for (reach, corner) in reach.iter_mut().zip([11 * 16, 11 * 16 + 15]) {
                *reach += cloth.positions()[corner].z / 600.0;
            }
        }
        println!("the corners blow out by {} m and {} m on average", reach[0], reach[1]);
        assert!(reach[1] > 0.15 && reach[0] < 0.6 * reach[1], "{reach:?}");
    }
}

#[test]
fn a_sheet_painted_with_a_thousand_times_the_drag_moves_with_the_wind_and_no_faster() {
    let mut cloth = Cloth::grid(&kite()).unwrap();
    cloth.set_wind(Wind { velocity: Vec3::Z * 8.0, gust: 0.0, ..Wind::default() }).unwrap();
    cloth.set_map(Map::Drag, Some(&[1000.0; 192])).unwrap();
    for _ in 0..300 {
        cloth.step(1);
        assert!(cloth.velocities().all(|v| v.length() < 10.0));
    }
    let momentum = cloth.mass_properties().momentum / cloth.mass_properties().total;
    assert!((momentum.z - 8.0).abs() < 0.4, "{momentum} m/s");
}
