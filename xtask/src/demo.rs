//! Builds and runs the demo: in a window, as a picture, as a page.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::failure::{During, Failure, Result};
use crate::serve::{Mount, Server};
use crate::{files, picture, setup, share, shell, web};

/// How the demo is built.
#[derive(Clone, Copy, PartialEq)]
pub enum Build {
    /// As it is shipped: with link-time optimisation.
    Release,
    /// As the tests are built: it takes less time to build, and runs two thirds as fast.
    Dev,
}

/// The option of `cargo xtask demo` for [`Build::Dev`].
const DEV_BUILD: &str = "--dev-build";

/// `cargo xtask demo`: runs the demo with its options, and ends this process with its status.
pub fn run(options: &[String]) -> Result {
    let has = |name: &str| options.iter().any(|option| option.split('=').next() == Some(name));
    if has("--web") {
        return serve(options);
    }
    if !has("--help") && !has("-h") {
        if !has("--shot") && !setup::has_display() {
            return Err(Failure::new(
                "there is no display for a window; `cargo xtask demo --web` serves the demo as \
                 a page, \
                 `cargo xtask demo --shot FILE.png` draws it without a screen",
            ));
        }
        setup::ensure(if has("--shot") { &[&setup::EGL] } else { &[&setup::EGL, &setup::X11] })?;
    }
    let program = build(if has(DEV_BUILD) { Build::Dev } else { Build::Release })?;
    let options = options.iter().filter(|option| *option != DEV_BUILD);
    let status =
        Command::new(program).args(options).status().during(|| "starting the demo".into())?;
    // The demo has printed its own error.
    std::process::exit(status.code().unwrap_or(1))
}

/// Builds the demo and returns the program.
fn build(build: Build) -> Result<PathBuf> {
    let (profile, folder) = match build {
        Build::Release => ("release", "release"),
        Build::Dev => ("dev", "debug"),
    };
    let profile = format!("--profile={profile}");
    let args = ["build", &profile, "--package=muslin-demo", "--bin=muslin-demo"];
    shell::run(&mut shell::cargo(&args))?;
    Ok(files::target().join(folder).join("muslin-demo"))
}

fn serve(options: &[String]) -> Result {
    let mut port = None;
    let mut open = true;
    let mut options = options.iter().flat_map(|option| option.splitn(2, '='));
    while let Some(option) = options.next() {
        match option {
            "--web" => {}
            "--no-open" => open = false,
            "--port" => {
                let number = options.next().and_then(|text| text.parse().ok());
                port = Some(number.ok_or_else(|| Failure::new("--port must be 0 to 65535"))?);
            }
            other => {
                return Err(Failure::new(format!(
                    "--web goes with --port and --no-open, not {other}"
                )));
            }
        }
    }
    web::build()?;
    let server = match port {
        Some(port) => Server::open(vec![Mount { at: "/", dir: web::dir() }], port)?,
        None => Server::open_anywhere(&web::dir())?,
    };
    println!("serving {} (Ctrl-C stops)", server.url());
    if open && setup::has_display() {
        open_browser(&server.url());
    }
    server.run();
    Ok(())
}

/// Opens the page in a browser if there is one.
fn open_browser(url: &str) {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    if shell::which(opener).is_some() {
        shell::command(opener).arg(url).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok();
    }
}

/// The pictures of step `shot`: the name of each, and the options of the demo that draw it. Film
/// strips show gestures: tearing and cutting the sheet, handling the receipt. The small receipt has
/// fewer particles and takes less time; `letter` shows the large one.
const TEST_PICTURES: [(&str, &str); 7] = [
    ("shot", ""),
    ("yank", "--play yank --strip 5 --size 400x400"),
    ("cut", "--play cut --strip 5 --size 400x400"),
    ("tender-fold", "--scene tender --small --play fold --strip 5 --size 400x400"),
    ("tender-letter", "--scene tender --play letter --strip 5 --size 400x400"),
    ("tender-crumple", "--scene tender --small --play crumple --strip 5 --size 400x400"),
    ("tender-toss", "--scene tender --small --play toss --strip 5 --size 400x400"),
];

/// Whether step `shot` draws a picture with these options.
pub fn is_test_picture(options: &[&str]) -> bool {
    TEST_PICTURES.iter().any(|(_, words)| words.split_whitespace().eq(options.iter().copied()))
}

/// Draws pictures with `cargo xtask demo --shot` in the build of the tests and checks them; then checks
/// the error without a display.
pub fn test_shot() -> Result {
    let shots = files::target().join("shots");
    files::create_dir(&shots)?;
    for (name, options) in TEST_PICTURES {
        let options: Vec<_> = options.split_whitespace().collect();
        shoot(&shots.join(name).with_extension("png"), &options, Build::Dev)?;
    }
    check_error_without_display()
}

/// Draws one picture with the demo as it is shipped, and checks it.
pub fn test_release() -> Result {
    let shots = files::target().join("shots");
    files::create_dir(&shots)?;
    shoot(&shots.join("release.png"), &[], Build::Release)
}

/// The pictures of the manual: the name of each, and the options of the demo that draw it.
const MANUAL_PICTURES: [(&str, &str); 6] = [
    ("hanging-sheet", "--scene sheet --size 480x360"),
    ("drape", "--scene discs --size 640x270 --zoom 0.68 --frames 400"),
    ("tear", "--play yank --strip 4 --size 220x220"),
    ("cut", "--play cut --strip 4 --size 220x220"),
    ("crumple", "--scene tender --play crumple --strip 4 --size 240x240 --zoom 0.75"),
    ("folds", "--scene tender --play fold --strip 4 --size 240x240"),
];

/// `cargo xtask manual-pictures`: draws the pictures of the manual into `docs/manual/pictures`.
pub fn draw_manual_pictures() -> Result {
    let dir = files::root().join("docs/manual/pictures");
    files::create_dir(&dir)?;
    for (name, options) in MANUAL_PICTURES {
        let options: Vec<_> = options.split(' ').collect();
        shoot(&dir.join(name).with_extension("png"), &options, Build::Release)?;
    }
    Ok(())
}

/// `cargo xtask share-pictures`: draws the pictures of previews of links into `demo/web`.
pub fn draw_share_pictures() -> Result {
    let shots = files::target().join("shots");
    files::create_dir(&shots)?;
    for (scene, options) in share::shots() {
        let png = shots.join(format!("share-{scene}.png"));
        shoot(&png, &options, Build::Release)?;
        share::save_picture(scene, &png)?;
    }
    Ok(())
}

/// The pictures by which a change of the demo is judged: the name of each, and the options of the
/// demo that draw it.
const REVIEW_PICTURES: [(&str, &str); 19] = [
    ("first-load", "--scene sheet --frames 1"),
    ("pulled", "--play yank --frames 18"),
    ("torn", "--play tear"),
    ("cut", "--play cut"),
    ("behind", "--scene sheet --orbit 1.1,0"),
    ("cotton", "--scene sheet --fabric 1"),
    ("denim", "--scene sheet --fabric 2"),
    ("nylon", "--scene sheet --fabric 3"),
    ("curtain", "--scene curtain"),
    ("discs", "--scene discs --frames 300"),
    ("receipt-hung", "--scene tender"),
    ("receipt-folded", "--scene tender --play letter"),
    ("receipt-crumpled", "--scene tender --play crumple"),
    ("flag", "--scene flag --fabric 3"),
    ("ball", "--scene ball --fabric 1"),
    ("figure", "--scene figure --fabric 1"),
    ("glass", "--scene glass"),
    ("doorway", "--scene doorway --fabric 1 --frames 170"),
    ("storm", "--scene storm --fabric 3"),
];

/// Sizes of these pictures [px]: a desktop, a small laptop, a phone.
const REVIEW_SIZES: [&str; 3] = ["1440x900", "1280x720", "390x844"];

/// `cargo xtask review-pictures`: draws every scene at three sizes into a folder, to compare with
/// those of another commit.
pub fn draw_review_pictures(options: &[String]) -> Result {
    let dir = match options {
        [] => files::target().join("shots/review"),
        [dir] if !dir.starts_with('-') => dir.into(),
        _ => return Err(Failure::new("`cargo xtask review-pictures` takes only a folder")),
    };
    files::create_dir(&dir)?;
    for (name, options) in REVIEW_PICTURES {
        for size in REVIEW_SIZES {
            let options: Vec<_> = options.split(' ').chain(["--size", size]).collect();
            shoot(&dir.join(format!("{name}-{size}.png")), &options, Build::Release)?;
        }
    }
    Ok(())
}

/// Draws a picture with `cargo xtask demo --shot` and checks it.
pub fn shoot(file: &Path, options: &[&str], build: Build) -> Result {
    if file.exists() {
        std::fs::remove_file(file).during(|| format!("removing {}", file.display()))?;
    }
    let dev_build = (build == Build::Dev).then_some(DEV_BUILD);
    shell::run(shell::xtask(&["demo", "--shot"])?.arg(file).args(options).args(dev_build))?;
    picture::check(file)
}

fn check_error_without_display() -> Result {
    let mut demo = shell::xtask(&["demo"])?;
    let demo = demo.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let output = demo.output().during(|| "starting `cargo xtask demo`".into())?;
    let line = String::from_utf8_lossy(&output.stderr);
    let offers =
        line.contains("--web") && line.contains("--shot") && line.trim().lines().count() == 1;
    if !output.status.success() && offers {
        return Ok(());
    }
    Err(Failure::new(format!(
        "`cargo xtask demo` without a display must fail with one line that offers --web and \
         --shot, \
         not {} and {line:?}",
        output.status
    )))
}
