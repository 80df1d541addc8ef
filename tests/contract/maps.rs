//! Painted maps: refusals, and what saves, copies, tears, cuts, resets and the hash make of them.

use crate::common::irregular_mesh;
use muslin::glam::Vec3;
use muslin::{
    Cloth, ColliderDesc, Error, EventKind, GridDesc, Map, Material, Preset, SelfCollision, Wind,
};

/// A grid and an irregular mesh that bend, collide, tear and blow.
fn cloths(self_collision: SelfCollision) -> [Cloth; 2] {
    let mut grid = GridDesc { columns: 14, rows: 11, spacing: 0.1, ..GridDesc::default() };
    let mut mesh = irregular_mesh();
    for (settings, material) in
        [(&mut grid.settings, &mut grid.material), (&mut mesh.settings, &mut mesh.material)]
    {
        (settings.self_collision, settings.tearing) = (self_collision, true);
        let denim = Material::preset(Preset::Denim);
        *material = Material { tear_stretch: 1.3, bend_damping: 0.01, ..denim };
    }
    [Cloth::grid(&grid).unwrap(), Cloth::mesh(&mesh).unwrap()].map(|mut cloth| {
        let wind = Wind { velocity: Vec3::new(0.5, 0.0, 4.0), gust: 0.3, ..Wind::default() };
        cloth.set_wind(wind).unwrap();
        let position = Vec3::new(0.0, -1.2, 0.0);
        cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).unwrap();
        cloth
    })
}

/// Scales that differ from particle to particle.
fn uneven(count: u32) -> Vec<f32> {
    (0..count).map(|i| 0.25 + 0.125 * (i * 7 % 11) as f32).collect()
}

fn paint_all(cloth: &mut Cloth) {
    let scales = uneven(cloth.particle_count());
    Map::ALL.into_iter().for_each(|map| cloth.set_map(map, Some(&scales)).unwrap());
}

/// Tears an edge, cuts across the middle, and lets both halves move.
fn tear_and_cut(cloth: &mut Cloth) {
    assert!(try_tear_and_cut(cloth), "nothing tore or was cut");
}

/// As `tear_and_cut`; returns whether there were edges, and room, left to tear and to cut.
fn try_tear_and_cut(cloth: &mut Cloth) -> bool {
    let [a, b] = [cloth.indices()[30], cloth.indices()[31]];
    let has_torn = cloth.tear_edge(a, b).unwrap_or(false);
    cloth.step(5);
    let x = cloth.positions().iter().map(|x| x.x);
    let (low, high) = (x.clone().fold(9.0, f32::min), x.fold(-9.0, f32::max));
    let at = |share: f32| Vec3::new(low + (high - low) * share, 9.0, -9.0);
    let opened = cloth.cut(at(0.47), at(0.53) - Vec3::Y * 18.0, Vec3::Z * 18.0).unwrap_or(0);
    cloth.step(25);
    has_torn && opened > 0
}

#[test]
fn bad_scales_are_refused_and_name_the_index_and_the_rule() {
    for mut cloth in cloths(SelfCollision::None) {
        let count = cloth.particle_count();
        paint_all(&mut cloth);
        let hash = cloth.state_hash();
        for map in Map::ALL {
            for bad in [-0.001, 1000.1, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                let mut scales = uneven(count);
                (scales[5], scales[7]) = (bad, f32::NAN);
                let error = cloth.set_map(map, Some(&scales)).unwrap_err();
                let must = "be from 0 to 1000";
                assert_eq!(error, Error::BadEntry { field: "scales", index: 5, must });
                assert_eq!(error.to_string(), "`scales[5]` must be from 0 to 1000");
            }
            for wrong in [0, 1, count - 1, count + 1] {
                let error = cloth.set_map(map, Some(&vec![1.0; wrong as usize])).unwrap_err();
                let expected = Error::BadCount { field: "scales", count: wrong, needed: count };
                assert_eq!(error, expected);
                let message = format!(
                    "`scales` must have {count} entries, one per particle, but has {wrong}"
                );
                assert_eq!(error.to_string(), message);
            }
        }
        assert_eq!(cloth.state_hash(), hash);
        for limit in [0.0, -0.0, 1000.0] {
            cloth.set_map(Map::Bend, Some(&vec![limit; count as usize])).unwrap();
        }
    }
}

#[test]
fn a_map_of_ones_changes_no_position() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles, SelfCollision::Surface] {
        for plain in cloths(self_collision) {
            for map in Map::ALL {
                let (mut plain, mut painted) = (plain.clone(), plain.clone());
                let ones = vec![1.0; plain.particle_count() as usize];
                painted.set_map(map, Some(&ones)).unwrap();
                for cloth in [&mut plain, &mut painted] {
                    cloth.step(20);
                    tear_and_cut(cloth);
                }
                // Weights of three corners do not always sum to exactly 1.
                if map == Map::Friction {
                    let pairs = plain.positions().iter().zip(painted.positions());
                    let off = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                    assert!(off < 1.0e-2, "{map:?}: {off} m");
                } else {
                    assert!(painted.positions() == plain.positions(), "{map:?}");
                }
            }
        }
    }
}

#[test]
fn each_map_changes_the_motion_and_taking_it_away_restores_the_bits() {
    for plain in cloths(SelfCollision::Surface) {
        for map in Map::ALL {
            let [mut painted, mut cleared, mut plain] = [(); 3].map(|()| {
                let mut cloth = plain.clone();
                let weak = Material { tear_stretch: 1.02, ..cloth.material().clone() };
                cloth.set_material(weak).unwrap();
                cloth
            });
            let scales = uneven(plain.particle_count());
            let hash = plain.state_hash();
            painted.set_map(map, Some(&scales)).unwrap();
            assert_ne!(painted.state_hash(), hash, "{map:?} is part of the hash");
            cleared.set_map(map, Some(&scales)).unwrap();
            cleared.set_map(map, None).unwrap();
            assert_eq!(cleared.state_hash(), hash);
            for (number, cloth) in [&mut painted, &mut cleared, &mut plain].into_iter().enumerate()
            {
                cloth.step(20);
                // Where the map weakens the cloth, the wind may have torn all there is to tear.
                let is_painted = number == 0;
                assert!(try_tear_and_cut(cloth) || is_painted, "nothing tore or was cut");
                cloth.unpin_all();
                cloth.step(90);
            }
            assert_eq!(cleared.state_hash(), plain.state_hash(), "{map:?}");
            let is_grid = plain.mesh_report().is_grid;
            let has_effect = painted.positions() != plain.positions();
            assert!(has_effect, "{map:?} has no effect, grid: {is_grid}");
        }
    }
}

#[test]
fn restored_and_cloned_cloths_continue_with_the_same_bits_after_tears_and_cuts() {
    for self_collision in [SelfCollision::Particles, SelfCollision::Surface] {
        for mut cloth in cloths(self_collision) {
            paint_all(&mut cloth);
            cloth.step(20);
            let mut before = Cloth::restore(&cloth.save()).unwrap();
            tear_and_cut(&mut cloth);
            tear_and_cut(&mut before);
            let mut copies =
                [before, Cloth::restore(&cloth.save()).unwrap(), cloth.clone(), cloth.clone()];
            // New scales for the particles that tears and cuts made, and a new material.
            let scales = uneven(cloth.particle_count());
            let change = |cloth: &mut Cloth| {
                cloth.set_map(Map::Stretch, Some(&scales)).unwrap();
                cloth.set_map(Map::Bend, Some(&scales)).unwrap();
                let silk = Material { tear_stretch: 1.3, ..Material::preset(Preset::Silk) };
                cloth.set_material(silk).unwrap();
            };
            change(&mut cloth);
            cloth.step(10);
            for copy in &mut copies {
                change(copy);
                copy.step(5);
                *copy = Cloth::restore(&copy.save()).unwrap();
                copy.step(5);
                assert_eq!(copy.state_hash(), cloth.state_hash());
                assert!(copy.positions() == cloth.positions());
            }
        }
    }
}

#[test]
fn maps_can_be_read_with_the_scales_of_particles_that_tears_and_cuts_added() {
    for mut cloth in cloths(SelfCollision::None) {
        assert!(Map::ALL.iter().all(|map| cloth.map(*map).is_none()));
        let count = cloth.particle_count();
        let scales = uneven(count);
        cloth.set_map(Map::Drag, Some(&scales)).unwrap();
        assert_eq!(cloth.map(Map::Drag), Some(&scales[..]));
        assert_eq!(cloth.map(Map::Bend), None);
        tear_and_cut(&mut cloth);
        let read = cloth.map(Map::Drag).unwrap();
        assert!(read.len() == cloth.particle_count() as usize && read.len() > scales.len());
        assert_eq!(read[..scales.len()], scales);
        cloth.set_map(Map::Drag, None).unwrap();
        assert_eq!(cloth.map(Map::Drag), None);
    }
}

#[test]
fn particles_that_tears_split_off_take_the_scale_of_their_source() {
    for cloth in cloths(SelfCollision::None) {
        let [mut painted, mut plain] = [cloth.clone(), cloth];
        let scales = uneven(plain.particle_count());
        painted.set_map(Map::Friction, Some(&scales)).unwrap();
        let rest: Vec<Vec3> = plain.rest_positions().collect();
        for cloth in [&mut painted, &mut plain] {
            for k in [10, 17, 23] {
                let [a, b] = [cloth.indices()[3 * k], cloth.indices()[3 * k + 1]];
                cloth.tear_edge(a, b).unwrap();
            }
        }
        assert!(plain.particle_count() as usize > rest.len());
        let source = |x: Vec3| rest.iter().position(|rest| *rest == x).unwrap();
        let expected: Vec<f32> = plain.rest_positions().map(|x| scales[source(x)]).collect();
        plain.set_map(Map::Friction, Some(&expected)).unwrap();
        assert_eq!(painted.state_hash(), plain.state_hash());
    }
}

#[test]
fn particles_that_cuts_add_take_the_scale_between_those_of_the_ends() {
    for cloth in cloths(SelfCollision::None) {
        let ramp = |cloth: &Cloth| -> Vec<f32> {
            cloth.rest_positions().map(|x| 0.5 * (x.x + 1.5)).collect()
        };
        let [mut painted, mut plain] = [cloth.clone(), cloth];
        painted.set_map(Map::Drag, Some(&ramp(&painted))).unwrap();
        for cloth in [&mut painted, &mut plain] {
            let from = Vec3::new(0.63, 3.0, -3.0);
            assert!(cloth.cut(from, from - Vec3::Y * 9.0, Vec3::Z * 6.0).unwrap() > 1);
        }
        plain.set_map(Map::Drag, Some(&ramp(&plain))).unwrap();
        for cloth in [&mut painted, &mut plain] {
            cloth.step(1);
        }
        let [found, exact] = [&painted, &plain].map(|cloth| cloth.mass_properties().momentum);
        assert!((found - exact).length() < 1.0e-4 * exact.length(), "{found} {exact}");
    }
}

#[test]
fn maps_stay_when_a_torn_and_cut_cloth_is_reset() {
    for fresh in cloths(SelfCollision::Surface) {
        let [mut cloth, mut fresh] = [fresh.clone(), fresh];
        [&mut cloth, &mut fresh].into_iter().for_each(paint_all);
        cloth.step(20);
        tear_and_cut(&mut cloth);
        cloth.reset();
        for cloth in [&mut cloth, &mut fresh] {
            cloth.step(40);
        }
        assert!(cloth.positions() == fresh.positions());
        assert_eq!(cloth.state_hash(), fresh.state_hash());
    }
}

#[test]
fn maps_take_memory_only_while_they_are_set_and_wake_the_cloth() {
    let mut desc = GridDesc { columns: 10, rows: 10, ..GridDesc::default() };
    (desc.settings.sleep_speed, desc.settings.damping) = (0.02, 6.0);
    let mut cloth = Cloth::grid(&desc).unwrap();
    let plain = cloth.stats().bytes;
    cloth.set_map(Map::Drag, Some(&[0.5; 100])).unwrap();
    assert!(cloth.stats().bytes >= plain + 400);
    cloth.set_map(Map::Drag, None).unwrap();
    assert_eq!(cloth.stats().bytes, plain);
    assert!((0..3600).any(|_| {
        cloth.step(1);
        cloth.is_asleep()
    }));
    cloth.set_map(Map::Bend, Some(&[0.5; 100])).unwrap();
    assert!(!cloth.is_asleep());
}

#[test]
fn extreme_scales_keep_positions_finite() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles, SelfCollision::Surface] {
        for cloth in cloths(self_collision) {
            for (map, odd, even) in Map::ALL
                .into_iter()
                .flat_map(|map| [(map, 0.0, 1000.0), (map, 1.0e-38, 1.0), (map, 1000.0, 1000.0)])
            {
                let mut cloth = cloth.clone();
                let scales: Vec<f32> = (0..cloth.particle_count())
                    .map(|i| if i % 2 == 0 { even } else { odd })
                    .collect();
                cloth.set_map(map, Some(&scales)).unwrap();
                cloth.step(20);
                try_tear_and_cut(&mut cloth);
                let far = cloth.positions().iter().map(|x| x.length()).fold(0.0, f32::max);
                assert!(far < 100.0, "{map:?} {odd} {even}: {far} m");
                let mut events = std::iter::from_fn(|| cloth.next_event());
                let has_recovered = events.any(|event| event.kind == EventKind::Recovered);
                assert!(!has_recovered, "{map:?} {odd} {even}");
            }
        }
    }
}
