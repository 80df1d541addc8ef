//! Tests of pictures that the demo draws without a window. They need EGL; without it they fail and
//! name the packages to install.

use muslin_demo::app::App;
use muslin_demo::gesture::{Gesture, GesturePlayer};
use muslin_demo::headless::Headless;
use muslin_demo::receipt;
use muslin_demo::render::{OffscreenCanvas, Renderer};
use muslin_demo::scene_kind::SceneKind;
use muslin_demo::settings::Settings;
use muslin_demo::shot::{Picture, ReceiptShot, Shot};

fn take(shot: &Shot) -> Picture {
    shot.take().unwrap_or_else(|error| panic!("{error}"))
}

fn small() -> Shot {
    Shot { size: [320, 180], ticks: 60, ..Shot::default() }
}

/// Mean brightness, 0 to 255, of a rectangle; `x` and `y` are fractions of the sides.
fn brightness(picture: &Picture, x: [f32; 2], y: [f32; 2]) -> f32 {
    let [width, height] = picture.size.map(|side| side as f32);
    let (mut sum, mut count) = (0.0, 0);
    for row in (y[0] * height) as usize..(y[1] * height) as usize {
        for column in (x[0] * width) as usize..(x[1] * width) as usize {
            let at = 3 * (row * picture.size[0] as usize + column);
            sum += picture.rgb[at..at + 3].iter().map(|c| f32::from(*c)).sum::<f32>() / 3.0;
            count += 1;
        }
    }
    sum / count as f32
}

/// Fraction of bytes that differ by more than 8 between two pictures.
fn difference(a: &Picture, b: &Picture) -> f32 {
    let differ = a.rgb.iter().zip(&b.rgb).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    differ as f32 / a.rgb.len() as f32
}

#[test]
fn the_sheet_is_bright_on_a_dark_background() {
    let picture = take(&small());
    let cloth = brightness(&picture, [0.42, 0.58], [0.25, 0.65]);
    let corner = brightness(&picture, [0.0, 0.12], [0.0, 0.15]);
    assert!(cloth > 70.0 && cloth < 240.0, "the cloth's brightness is {cloth}");
    assert!(corner < 30.0, "the corner's brightness is {corner}");
}

#[test]
fn the_floor_is_darker_in_the_shadow() {
    let lit = take(&small());
    let mut dropped = small();
    dropped.settings.pinning = muslin_demo::settings::Pinning::Corners;
    // The sheet pinned at four corners casts a different shadow on the same floor.
    let other = take(&dropped);
    assert!(difference(&lit, &other) > 0.02);
    let shadow = brightness(&lit, [0.62, 0.72], [0.84, 0.90]);
    let open = brightness(&lit, [0.20, 0.30], [0.84, 0.90]);
    assert!(open > 1.3 * shadow, "open floor {open}, shadow {shadow}");
}

#[test]
fn the_same_shot_gives_the_same_picture_and_later_ticks_give_another() {
    let first = take(&small());
    assert!(first.rgb == take(&small()).rgb);
    let later = take(&Shot { ticks: 90, ..small() });
    assert!(difference(&first, &later) > 0.01);
}

#[test]
fn wireframe_and_tears_are_visible() {
    let plain = take(&Shot { ticks: 120, ..small() });
    let settings = Settings { wireframe: true, ..Settings::default() };
    let lines = take(&Shot { ticks: 120, settings, ..small() });
    assert!(difference(&plain, &lines) > 0.05);
    let ripped = take(&Shot { ticks: 120, play: Some(Gesture::Tear), ..small() });
    assert!(difference(&plain, &ripped) > 0.01);
}

/// The frayed threads of the cut were those of the fine mesh, and the coarse one has fewer vertices.
#[test]
fn a_cut_sheet_is_drawn_without_gaps_after_slow_frames_lower_its_detail() {
    let headless = Headless::new().unwrap_or_else(|error| panic!("{error}"));
    let mut app = App::new(Settings::default(), || 0.0).unwrap();
    app.camera().set_drift(false);
    let mut renderer = Renderer::new(&headless.context).unwrap();
    let canvas = OffscreenCanvas::new(&headless.context, 320, 180);
    let mut cut = GesturePlayer::new(Gesture::Cut, &mut app);
    for _ in 0..Gesture::Cut.ticks() {
        cut.step(&mut app).unwrap();
    }
    app.set("paused", 1.0).unwrap();
    let mut picture = |app: &mut App| {
        app.draw(&mut renderer, &canvas.target()).unwrap();
        let rgb = canvas.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).collect();
        Picture { size: [320, 180], rgb, times: Vec::new(), rate: None }
    };
    let fine = picture(&mut app);
    for _ in 0..20 {
        app.frame(0.4).unwrap();
    }
    let coarse = picture(&mut app);
    let share = difference(&fine, &coarse);
    assert!(share > 0.0 && share < 0.2, "{share} of the picture differs");
}

#[test]
fn a_photo_shows_the_screen_at_four_thousand_pixels() {
    let headless = Headless::new().unwrap_or_else(|error| panic!("{error}"));
    let mut app = App::new(Settings::default(), || 0.0).unwrap();
    app.resize(glam::Vec2::new(320.0, 180.0));
    app.set_photo(true).unwrap();
    let mut renderer = Renderer::new(&headless.context).unwrap();
    let canvas = OffscreenCanvas::new(&headless.context, 320, 180);
    let screen = |app: &mut App, renderer: &mut Renderer| {
        app.draw(renderer, &canvas.target()).unwrap();
        canvas.pixels()
    };
    let before = screen(&mut app, &mut renderer);
    let photo = app.take_photo(&mut renderer).unwrap();
    assert_eq!((photo.size, photo.pixels.len()), ([3840, 2160], 3840 * 2160));
    assert!(screen(&mut app, &mut renderer) == before, "the photo changed the screen");
    // The mean of each square of 12 x 12 pixels is the pixel of the screen.
    let mean = |x: usize, y: usize| {
        let square = (0..144).map(|i| photo.pixels[(12 * y + i / 12) * 3840 + 12 * x + i % 12]);
        square.map(|pixel| u32::from(pixel[1])).sum::<u32>() / 144
    };
    let off = (0..320 * 180).map(|i| mean(i % 320, i / 320).abs_diff(u32::from(before[i][1])));
    let mean_off = off.sum::<u32>() as f32 / (320.0 * 180.0);
    assert!(mean_off < 3.0, "the photo differs from the screen by {mean_off} of 255");
}

#[test]
fn the_frames_of_a_film_strip_differ() {
    let settings = Settings::default();
    for gesture in [Gesture::Yank, Gesture::Cut] {
        let shot = Shot {
            size: [160, 160],
            play: Some(gesture),
            strip: 3,
            settings: settings.clone(),
            ..small()
        };
        let strip = take(&shot);
        assert_eq!(strip.size, [480, 160]);
        let frame = |i: usize| {
            let rows = strip.rgb.chunks_exact(3 * 480);
            rows.flat_map(|row| &row[3 * 160 * i..3 * 160 * (i + 1)]).copied().collect()
        };
        let frames = [0, 1, 2].map(|i| Picture {
            times: Vec::new(),
            rate: None,
            size: [160, 160],
            rgb: frame(i),
        });
        for two in frames.windows(2) {
            let differ = difference(&two[0], &two[1]);
            assert!(differ > 0.02, "{gesture:?}: two frames differ by {differ}");
        }
    }
}

#[test]
fn discs_and_curtain_are_visible_on_the_stage() {
    let scene = |scene| Settings { scene, fabric: scene.fabric(), ..Settings::default() };
    let discs = take(&Shot { settings: scene(SceneKind::Discs), ..small() });
    let at = |x: f32, y: f32| brightness(&discs, [x - 0.03, x + 0.03], [y - 0.04, y + 0.04]);
    let [silk, cotton, denim] = [at(0.26, 0.40), at(0.50, 0.44), at(0.76, 0.45)];
    assert!(silk > 80.0 && cotton > silk && denim < 0.7 * silk, "{silk}, {cotton}, {denim}");
    for x in [0.10, 0.39, 0.63, 0.92] {
        assert!(at(x, 0.30) < 45.0, "between discs, at {x}, it is {}", at(x, 0.30));
    }
    let curtain = take(&Shot { settings: scene(SceneKind::Curtain), ..small() });
    let cloth = brightness(&curtain, [0.42, 0.58], [0.25, 0.55]);
    assert!(cloth > 60.0, "the curtain's brightness is {cloth}");
    let later = take(&Shot { ticks: 140, settings: scene(SceneKind::Curtain), ..small() });
    assert!(difference(&curtain, &later) > 0.02, "the ball does not roll");
}

#[test]
fn balls_of_glass_show_the_sheet_upside_down_and_gather_light_on_the_floor() {
    let settings = Settings { scene: SceneKind::Glass, ..Settings::default() };
    let picture = take(&Shot { size: [640, 400], ticks: 90, settings, ..small() });
    // The sheet is above and behind the front ball, and its image is low in it.
    let ball = |y: f32| brightness(&picture, [0.41, 0.45], [y - 0.01, y + 0.01]);
    let (upper, image) = (ball(0.66), ball(0.83));
    assert!(image > 1.3 * upper, "the image has {image}, the glass above it {upper}");
    let shadow = brightness(&picture, [0.565, 0.585], [0.785, 0.80]);
    let caustic = brightness(&picture, [0.505, 0.525], [0.805, 0.825]);
    assert!(caustic > 1.15 * shadow, "the caustic has {caustic}, the shadow {shadow}");
}

#[test]
fn the_walker_parts_the_curtain_of_the_doorway() {
    let settings = Settings { scene: SceneKind::Doorway, ..Settings::default() };
    let settings = Settings { fabric: settings.scene.fabric(), ..settings };
    let shot = |ticks| take(&Shot { ticks, settings: settings.clone(), ..small() });
    let (closed, parted) = (shot(40), shot(150));
    let bright = |picture: &Picture| {
        picture.rgb.chunks_exact(3).filter(|p| p.iter().all(|c| *c > 110)).count()
    };
    assert!(bright(&closed) > 3000, "{} pixels of cotton", bright(&closed));
    assert!(difference(&closed, &parted) > 0.05, "nobody walks through");
}

#[test]
fn the_torn_flag_whips_in_the_rain() {
    let settings = Settings { scene: SceneKind::Storm, ..Settings::default() };
    let settings = Settings { fabric: settings.scene.fabric(), ..settings };
    let shot = |ticks| take(&Shot { ticks, settings: settings.clone(), ..small() });
    let (first, later) = (shot(60), shot(66));
    let flag = first.rgb.chunks_exact(3).filter(|p| p[0] > 150 && p[2] < 90).count();
    assert!(flag > 700, "{flag} pixels of the red stripe");
    // Streaks of rain are brighter than the pixels beside them, where there is no flag.
    let streaks = |picture: &Picture| {
        let rows = picture.rgb.chunks_exact(3 * 320).skip(20).take(60);
        let steps = rows.flat_map(|row| (5..90).map(|x| row[3 * x].abs_diff(row[3 * x - 3])));
        steps.filter(|step| *step > 6).count()
    };
    assert!(streaks(&first) > 40, "{} streaks", streaks(&first));
    assert!(difference(&first, &later) > 0.01, "the flag does not move");
}

#[test]
fn the_figure_is_dressed_and_walks() {
    let settings = Settings { scene: SceneKind::Figure, ..Settings::default() };
    let settings = Settings { fabric: settings.scene.fabric(), ..settings };
    let shot = |ticks| take(&Shot { ticks, settings: settings.clone(), ..small() });
    let (first, later) = (shot(60), shot(90));
    let red = |picture: &Picture| {
        let pixels = picture.rgb.chunks_exact(3);
        pixels.filter(|p| p[0] > 90 && p[0] / 2 > p[1] && p[0] / 2 > p[2]).count()
    };
    assert!(red(&first) > 300, "{} pixels of the skirt", red(&first));
    let light = first.rgb.chunks_exact(3).filter(|p| p.iter().all(|c| *c > 110)).count();
    assert!(light > 500, "{light} pixels of body and shirt");
    assert!(difference(&first, &later) > 0.01, "the figure does not walk");
}

#[test]
fn fabrics_and_paper_differ_side_by_side() {
    let row = take(&Shot { size: [120, 160], ticks: 30, fabrics: true, ..Shot::default() });
    assert_eq!(row.size, [600, 160]);
    // Silk is blue, cotton light, denim dark, nylon printed; paper hangs before a light ground.
    let mean = |i: usize, channel: usize| {
        let rows = row.rgb.chunks_exact(3 * 600).skip(70).take(10);
        let middle =
            rows.flat_map(|row| (120 * i + 50..120 * i + 70).map(|x| row[3 * x + channel]));
        middle.map(u32::from).sum::<u32>() / 200
    };
    assert!(mean(0, 2) > mean(0, 0) + 30, "silk: {} {}", mean(0, 0), mean(0, 2));
    assert!(mean(1, 0) > 150 && mean(1, 0) > mean(1, 2), "cotton: {}", mean(1, 0));
    assert!(mean(2, 1) < 110, "denim: {}", mean(2, 1));
    assert!(mean(3, 0) > 120, "nylon: {}", mean(3, 0));
    assert!((0..3).all(|channel| mean(4, channel) > 120), "paper: {}", mean(4, 1));
}

fn receipt(play: Option<receipt::gestures::ReceiptGesture>, strip: u32) -> Picture {
    let receipt = ReceiptShot { play, small: true, ..ReceiptShot::default() };
    let ticks = 60 + play.map_or(0, receipt::gestures::ReceiptGesture::ticks);
    take(&Shot { size: [240, 240], ticks, strip, receipt: Some(receipt), ..Shot::default() })
}

#[test]
fn the_receipt_is_printed_paper_over_a_light_ground() {
    let picture = receipt(None, 1);
    // The backdrop has the specified colour, up to one step of dither.
    for x in [0, 239] {
        for channel in &picture.rgb[3 * x..3 * x + 3] {
            assert!(channel.abs_diff(0xe8) <= 1, "the backdrop is {channel}");
        }
    }
    let paper = brightness(&picture, [0.42, 0.58], [0.08, 0.10]);
    let text = brightness(&picture, [0.42, 0.58], [0.11, 0.15]);
    assert!(paper > 215.0 && text < paper - 15.0, "paper {paper}, print {text}");
    let open = brightness(&picture, [0.85, 0.98], [0.80, 0.90]);
    let shade = brightness(&picture, [0.40, 0.50], [0.76, 0.78]);
    assert!(shade < 0.85 * open, "open ground {open}, its shadow {shade}");
}

#[test]
fn the_gestures_of_the_receipt_are_visible() {
    let still = receipt(None, 1);
    for (name, gesture) in receipt::gestures::ReceiptGesture::ALL {
        let strip = receipt(Some(gesture), 3);
        for i in 0..3 {
            let rows = strip.rgb.chunks_exact(3 * 720);
            let rgb = rows.flat_map(|row| &row[720 * i..720 * (i + 1)]).copied().collect();
            let frame = Picture { times: Vec::new(), rate: None, size: [240, 240], rgb };
            let differ = difference(&still, &frame);
            assert!(differ > 0.03, "frame {i} of {name} differs by {differ}");
        }
    }
}
