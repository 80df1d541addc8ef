//! Fast bodies against sheets, free and hung, with and without bound and surface collision.

use crate::checks::surface::Surface;
use crate::play::{Play, Scene, Setup};
use crate::shapes::{
    capsule, cuboid, round_mesh, sphere, upright_sheet, with_bound, with_surface, without_losses,
};
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, GridDesc, PinMode, Result};

/// Distance between the start and the end of a body's way against a hung sheet [m].
const WAY: f32 = 1.1;

/// The name of a body, and what makes it at the origin.
type NamedBody = (&'static str, fn() -> ColliderDesc);

/// What a body flies against.
#[derive(Clone, Copy, Debug)]
struct Sheet {
    is_hung: bool,
    is_bounded: bool,
    is_surface: bool,
}

impl Sheet {
    fn name(self) -> String {
        let hung = if self.is_hung { "hung" } else { "free" };
        let bound = if self.is_bounded { "-bound" } else { "" };
        let surface = if self.is_surface { "-surface" } else { "" };
        format!("{hung}{bound}{surface}")
    }

    /// 40 × 40 particles, 2 m wide, around the origin.
    fn desc(self) -> GridDesc {
        let mut desc = without_losses(upright_sheet(40, 2.0));
        if self.is_hung {
            desc.pin_mode = PinMode::TopEdge;
        } else {
            desc.settings.gravity = Vec3::ZERO;
        }
        if self.is_bounded {
            desc = with_bound(desc, 0.05);
        }
        if self.is_surface { with_surface(desc) } else { desc }
    }
}

const SHEETS: [Sheet; 8] = {
    let mut all = [Sheet { is_hung: false, is_bounded: false, is_surface: false }; 8];
    let mut i = 0;
    while i < 8 {
        all[i] = Sheet { is_hung: i >= 4, is_bounded: i % 4 >= 2, is_surface: i % 2 == 1 };
        i += 1;
    }
    all
};

pub fn scenes() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for speed in [3, 5, 15, 50] {
        for sheet in SHEETS {
            let ball = || sphere(0.3, Vec3::ZERO);
            let scene = scene("sphere", speed, sheet, ball);
            let is_short = speed == 5 && sheet.is_hung && sheet.is_bounded;
            scenes.push(if is_short { scene.short(40) } else { scene });
        }
    }
    let bodies: [NamedBody; 3] = [
        ("box", || cuboid(Vec3::new(0.3, 0.2, 0.25), Vec3::ZERO)),
        ("capsule", || capsule(0.2, 0.3, Vec3::ZERO)),
        ("mesh", || round_mesh(16, 32, |_, _| Vec3::splat(0.3))),
    ];
    for (name, body) in bodies {
        for speed in [5, 15, 50] {
            for sheet in [SHEETS[0], SHEETS[3], SHEETS[4], SHEETS[7]] {
                scenes.push(scene(name, speed, sheet, body));
            }
        }
    }
    scenes
}

fn scene(name: &str, speed: u32, sheet: Sheet, body: impl Fn() -> ColliderDesc + 'static) -> Scene {
    let ticks = if sheet.is_hung { 60 } else { 18 };
    Scene::new(format!("{name}-{speed}-{}", sheet.name()), ticks, move || {
        impact(body(), speed as f32, sheet)
    })
}

/// A body that starts 0.5 m before the sheet and flies along z.
fn impact(mut body: ColliderDesc, speed: f32, sheet: Sheet) -> Result<Setup> {
    let mut play = Play::grid(&sheet.desc())?;
    let mut z = -0.5;
    body.position = Vec3::Z * z;
    play.add(body)?;
    let setup = Setup::from(play)
        .drive(move |play, _| {
            z += speed / 60.0;
            if sheet.is_hung {
                z = z.min(WAY - 0.5);
            }
            play.move_body(0, Vec3::Z * z, Quat::IDENTITY)
        })
        .watch(move |play, tick| {
            // When the body has stopped, a hung sheet may swing on beside it.
            let has_stopped = sheet.is_hung && tick as f32 * speed / 60.0 > WAY;
            if has_stopped { Ok(()) } else { is_ahead(play, Vec3::Z) }
        });
    Ok(if sheet.is_hung { setup } else { setup.free() })
}

/// Checks that cloth is in front of the first body.
pub fn is_ahead(play: &Play, direction: Vec3) -> std::result::Result<(), String> {
    let surface = Surface::of(&play.cloth);
    let from = play.bodies[0].desc.position.as_dvec3();
    // Slightly oblique, so that the ray does not run along an edge of the grid.
    let direction = direction.as_dvec3() + muslin::glam::DVec3::new(0.0123, 0.0071, 0.0031);
    if surface.tree.count_ray_hits(from, direction) > 0 {
        Ok(())
    } else {
        Err("the body has passed the sheet".into())
    }
}
