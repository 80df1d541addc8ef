//! Example of Muslin in Bevy: a tablecloth falls onto a ball. Drag it with the left mouse button;
//! pulled hard, it tears. Run it with `cargo run --release`. With `--shot FILE.png` a script drags
//! the cloth, and the window's picture is saved after 200 frames.

use bevy::asset::RenderAssetUsages;
use bevy::camera::visibility::NoFrustumCulling;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::diagnostic::FrameCount;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured, save_to_disk};
use muslin::{Cloth, ColliderDesc, Grab, GridDesc, PinMode, Preset, SelfCollision, Shape};

/// Centre and radius of the ball [m].
const BALL: Vec3 = Vec3::new(0.0, 0.62, 0.0);
const RADIUS: f32 = 0.45;

/// A cloth; the mesh of the same entity draws it.
#[derive(Component)]
struct Sheet {
    cloth: Cloth,
    /// Topology revision of the indices in the mesh.
    uploaded_revision: u32,
    /// The grab of the mouse, and its distance from the camera [m].
    held: Option<(Grab, f32)>,
}

/// The file of a scripted run for `--shot`.
#[derive(Resource)]
struct Script(String);

fn main() -> AppExit {
    let mut app = App::new();
    app.add_plugins(DefaultPlugins).insert_resource(ClearColor(Color::srgb(0.80, 0.83, 0.86)));
    app.insert_resource(GlobalAmbientLight { brightness: 600.0, ..default() });
    if let Some(file) = std::env::args().skip_while(|word| word != "--shot").nth(1) {
        app.insert_resource(Script(file)).add_systems(PostUpdate, save_picture);
    }
    app.add_systems(Startup, set_up).add_systems(Update, (drag_cloth, update_mesh).chain()).run()
}

/// Converts a vector to the version of glam that Muslin uses.
fn to_muslin(v: Vec3) -> muslin::glam::Vec3 {
    v.to_array().into()
}

/// Creates a horizontal sheet above the ball and the ground.
fn create_cloth() -> muslin::Result<Cloth> {
    let mut desc = GridDesc { columns: 52, rows: 52, spacing: 0.036, ..default() };
    (desc.origin, desc.down) = (to_muslin(Vec3::new(-0.86, 1.2, -0.98)), to_muslin(Vec3::Z));
    desc.pin_mode = PinMode::None;
    desc.material = muslin::Material::preset(Preset::Cotton);
    (desc.material.tear_stretch, desc.settings.tearing) = (1.5, true);
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc)?;
    let (shape, position) = (Shape::Sphere, to_muslin(BALL));
    cloth.add_collider(&ColliderDesc { shape, position, radius: RADIUS, ..default() })?;
    cloth.add_collider(&ColliderDesc::default())?;
    Ok(cloth)
}

fn set_up(
    mut commands: Commands,
    (mut meshes, mut images): (ResMut<Assets<Mesh>>, ResMut<Assets<Image>>),
    mut materials: ResMut<Assets<StandardMaterial>>,
) -> Result {
    let ball = Mesh3d(meshes.add(Sphere::new(RADIUS - 0.01).mesh().uv(64, 32)));
    let blue = MeshMaterial3d(materials.add(Color::srgb(0.16, 0.30, 0.42)));
    commands.spawn((ball, blue, Transform::from_translation(BALL)));
    let ground = Mesh3d(meshes.add(Plane3d::default().mesh().size(400.0, 400.0)));
    commands.spawn((ground, MeshMaterial3d(materials.add(Color::srgb(0.60, 0.56, 0.52)))));
    let sun = DirectionalLight { shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-2.0, 3.5, 2.5).looking_at(Vec3::ZERO, Vec3::Y)));
    let eye = Transform::from_xyz(0.9, 1.3, 2.0).looking_at(Vec3::Y * 0.55, Vec3::Y);
    commands.spawn((Camera3d::default(), Tonemapping::AcesFitted, eye));
    // Gingham: stripes of two colours cross.
    let colors = [[250, 246, 238, 255], [216, 132, 126, 255], [170, 36, 44, 255]];
    let texel = |i: usize| colors[(i % 256 / 8 + 1) % 2 + (i / 256 / 8 + 1) % 2];
    let texels = (0..256 * 256).flat_map(texel).collect();
    let (size, all) = (Extent3d { width: 256, height: 256, ..default() }, RenderAssetUsages::all());
    let image = Image::new(size, TextureDimension::D2, texels, TextureFormat::Rgba8UnormSrgb, all);
    let mut material = StandardMaterial { double_sided: true, cull_mode: None, ..default() };
    material.base_color_texture = Some(images.add(image));
    let sheet = Sheet { cloth: create_cloth()?, uploaded_revision: u32::MAX, held: None };
    let mesh = Mesh3d(meshes.add(Mesh::new(PrimitiveTopology::TriangleList, all)));
    commands.spawn((sheet, mesh, MeshMaterial3d(materials.add(material)), NoFrustumCulling));
    Ok(())
}

/// Drags the cloth with the mouse or the scripted pointer, at a constant distance from the camera.
fn drag_cloth(
    mut sheet: Single<&mut Sheet>,
    (camera, window): (Single<(&Camera, &GlobalTransform)>, Single<&Window>),
    (input, script, frames): (Res<ButtonInput<MouseButton>>, Option<Res<Script>>, Res<FrameCount>),
) -> Result {
    let mouse = (window.cursor_position(), input.pressed(MouseButton::Left));
    let (pointer, is_down) = script.map_or(mouse, |_| {
        let progress = frames.0.saturating_sub(130) as f32;
        (Some(Vec2::new(720.0 + 4.0 * progress, 480.0 + progress)), progress > 0.0)
    });
    let Some(pointer) = pointer else { return Ok(()) };
    let ray = camera.0.viewport_to_world(camera.1, pointer)?;
    let Sheet { cloth, held, .. } = &mut **sheet;
    if !is_down {
        held.take().map_or(Ok(()), |(grab, _)| cloth.release(grab))?;
    } else if let Some((grab, distance)) = *held {
        cloth.move_grab(grab, to_muslin(ray.get_point(distance)))?;
    } else {
        let hit = cloth.grab_ray(to_muslin(ray.origin), to_muslin(*ray.direction), 0.05)?;
        *held = hit.map(|(grab, position)| (grab, position.distance(to_muslin(ray.origin))));
    }
    Ok(())
}

/// Advances the cloth by the frame time, and copies it to its mesh.
fn update_mesh(
    sheet: Single<(&mut Sheet, &Mesh3d)>,
    mut meshes: ResMut<Assets<Mesh>>,
    (time, script): (Res<Time>, Option<Res<Script>>),
) -> Result {
    let (mut sheet, mesh) = sheet.into_inner();
    let Sheet { cloth, uploaded_revision, .. } = &mut *sheet;
    cloth.advance(if script.is_some() { 1.0 / 60.0 } else { time.delta_secs() })?;
    let view = cloth.view();
    let mut mesh = meshes.get_mut(mesh).ok_or("the mesh of the cloth is missing")?;
    let arrays = |v: &[muslin::glam::Vec3]| v.iter().map(|v| v.to_array()).collect::<Vec<_>>();
    mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, arrays(view.positions));
    mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, arrays(view.normals));
    if *uploaded_revision != view.topology_revision {
        let uvs = view.uvs.iter().map(|uv| uv.to_array()).collect::<Vec<_>>();
        mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, uvs);
        mesh.insert_indices(Indices::U32(view.indices.to_vec()));
        *uploaded_revision = view.topology_revision;
    }
    Ok(())
}

/// Saves the picture of frame 200 of a scripted run, and ends the program.
fn save_picture(mut commands: Commands, script: Res<Script>, frames: Res<FrameCount>) {
    if frames.0 == 200 {
        let save = save_to_disk(script.0.clone());
        commands.spawn(Screenshot::primary_window()).observe(save).observe(
            |_: On<ScreenshotCaptured>, mut exit: MessageWriter<AppExit>| {
                exit.write(AppExit::Success);
            },
        );
    }
}
