//! Solids of the scenes: supports and obstacles of the cloth, as they are drawn.
//!
//! Method: capsules, spheres and cylinders at the places of the colliders and of the held points.
//!
//! Reads [`Settings`] and the scene; returns [`Solid`]s.
//!
//! Invariant: a solid that cloth rests on is slightly smaller than its collider, so that the flat
//! triangles of the cloth do not cut into it.

use glam::Vec3;
use muslin_scenes::{
    Curtain, Doorway, Drapes, Flag, GlassBalls, HangingSheet, SceneInstance, SheetOnBall, Walker,
};

use super::start::pleats;
use crate::render::light::FLOOR;
use crate::render::solid::Solid;
use crate::scene_kind::SceneKind;
use crate::settings::{Pinning, Settings};

/// Difference between the collision radius and the drawn radius of the ball: the triangles of the
/// cloth cut the corners of the round shape [m].
const BALL_INSET: f32 = 0.009;
/// Least distance between the rings of the sheet [m].
const RING_GAP: f32 = 0.09;
/// Colour of knobs and rings.
const BRASS: u32 = 0xd9a04a;
/// Radius of the flag pole [m].
const POLE_RADIUS: f32 = 0.016;

/// Returns the solids to draw: supports and obstacles of the cloth.
pub fn solids(settings: &Settings, instance: &SceneInstance) -> Vec<Solid> {
    match settings.scene {
        SceneKind::Sheet => hanger(settings),
        SceneKind::Figure => Vec::new(),
        SceneKind::Ball => {
            let centre = SheetOnBall::CENTRE;
            let radius = SheetOnBall::RADIUS - BALL_INSET;
            let foot = centre.with_y(FLOOR);
            vec![
                Solid::sphere(centre, radius, 0x6f7f9c),
                Solid::capsule(foot, centre, 0.09, 0x4a5264),
            ]
        }
        SceneKind::Flag | SceneKind::Storm => {
            let foot = Vec3::new(Flag::HOIST.x - POLE_RADIUS, FLOOR, 0.0);
            let top = foot.with_y(Flag::HOIST.y + 0.09);
            let pole = Solid::capsule(foot, top, POLE_RADIUS, 0x8d93a3);
            vec![pole, Solid::sphere(top + Vec3::Y * 0.02, 0.034, BRASS)]
        }
        SceneKind::Discs => Drapes::CENTRES.iter().flat_map(|place| pedestal(*place)).collect(),
        SceneKind::Curtain => {
            let ball = instance
                .ball()
                .map(|(centre, radius)| Solid::sphere(centre, radius - BALL_INSET, 0xc9563f));
            ball.into_iter().chain(rod()).collect()
        }
        SceneKind::Glass => GlassBalls::BALLS
            .into_iter()
            .map(|(centre, radius)| Solid::glass_ball(centre, radius - BALL_INSET))
            .collect(),
        SceneKind::Doorway => doorway(settings, instance),
    }
}

/// A pedestal, drawn slightly smaller than its collision shape.
fn pedestal(place: Vec3) -> [Solid; 2] {
    let top = place / Drapes::UNIT - Vec3::Y * 0.004;
    let radius = Drapes::PEDESTAL / Drapes::UNIT - 0.006;
    let foot = top.with_y(FLOOR);
    [
        Solid::cylinder(foot, top, radius, 0.012, 0x8b8f9c),
        Solid::cylinder(foot, foot + Vec3::Y * 0.05, radius + 0.04, 0.012, 0x5c6270),
    ]
}

/// The rod that the sheet hangs from on two wires, with a ring and a clip wherever the sheet passes
/// below it; none for a sheet that all corners hold.
fn hanger(settings: &Settings) -> Vec<Solid> {
    let pleats = pleats(settings);
    let last = pleats.len() - 1;
    let is_below = |i: &usize| match settings.pinning {
        Pinning::TopEdge => *i == 0 || *i == last || pleats[*i].y * pleats[*i + 1].y <= 0.0,
        _ => *i == 0 || *i == last,
    };
    if settings.pinning == Pinning::Corners {
        return Vec::new();
    }
    let top = Vec3::Y * (0.5 * HangingSheet::SIZE);
    let half = Vec3::X * (pleats[last].x + 0.10);
    let rod = top + Vec3::Y * 0.05;
    let mut solids = vec![Solid::capsule(rod - half, rod + half, 0.010, BRASS)];
    for end in [rod - half, rod + half] {
        solids.push(Solid::sphere(end, 0.021, BRASS));
        let wire = end * 0.94;
        solids.push(Solid::capsule(wire.with_y(rod.y), wire.with_y(4.5), 0.0025, 0x8d93a3));
    }
    let mut rings: Vec<_> = (0..=last).filter(is_below).map(|i| pleats[i]).collect();
    rings.dedup_by(|next, ring| next.x - ring.x < RING_GAP);
    for place in rings {
        let (on_rod, across) = (rod.with_x(place.x), Vec3::X * 0.005);
        solids.push(Solid::cylinder(on_rod - across, on_rod + across, 0.019, 0.004, BRASS));
        let clip = top + Vec3::new(place.x, -0.012, place.y);
        solids.push(Solid::capsule(on_rod, clip, 0.0045, BRASS));
    }
    solids
}

/// The curtain rod on two stands, with a ring and a clip for each held point.
fn rod() -> Vec<Solid> {
    let mut solids = stands(Curtain::ROD, 0.5 * Curtain::WIDTH + 0.13);
    solids.extend(Curtain::ring_positions().flat_map(|place| ring(place, Curtain::ROD.y)));
    solids
}

/// The rod of the doorway with its rings, and the walker as a peg doll.
fn doorway(settings: &Settings, instance: &SceneInstance) -> Vec<Solid> {
    let mut solids = stands(Doorway::ROD, Doorway::WIDTH + 0.13);
    let rings = Doorway::ring_positions(settings.resolution);
    solids.extend(rings.into_iter().flat_map(|place| ring(place, Doorway::ROD.y)));
    if let Some(walker) = instance.walker() {
        let ([body, head], [shoulders, centre]) = (Walker::RADII, Walker::HEIGHTS);
        let (body, foot) = (body - BALL_INSET, walker.position());
        let up = |height: f32| foot + Vec3::Y * height;
        solids.push(Solid::capsule(up(body), up(shoulders - body), body, 0xb5713c));
        solids.push(Solid::sphere(up(centre), head - BALL_INSET, 0xe3bd92));
    }
    solids
}

/// A rod of twice `half` [m] around `middle`, on two stands.
fn stands(middle: Vec3, half: f32) -> Vec<Solid> {
    let half = Vec3::X * half;
    let (from, to) = (middle - half, middle + half);
    let mut solids = vec![Solid::capsule(from, to, 0.017, 0x8d93a3)];
    for end in [from, to] {
        let foot = end.with_y(FLOOR);
        solids.push(Solid::sphere(end, 0.036, BRASS));
        solids.push(Solid::capsule(foot, end, 0.018, 0x8d93a3));
        solids.push(Solid::cylinder(foot, foot + Vec3::Y * 0.03, 0.16, 0.01, 0x4a5264));
    }
    solids
}

/// A ring on a rod at the height `rod`, with a clip down to the fabric at `place` [m].
fn ring(place: Vec3, rod: f32) -> [Solid; 2] {
    let across = Vec3::X * 0.007;
    let on_rod = place.with_y(rod).with_z(0.0);
    [
        Solid::cylinder(on_rod - across, on_rod + across, 0.028, 0.006, BRASS),
        Solid::capsule(on_rod - Vec3::Y * 0.026, place, 0.006, BRASS),
    ]
}
