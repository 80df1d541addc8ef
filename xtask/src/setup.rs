//! What the machine must have: looked for, and installed where that is allowed.

use std::path::{Path, PathBuf};

use crate::failure::{Failure, Result};
use crate::shell::{self, which};

/// Something that the machine must have.
pub struct Need {
    /// What people call it.
    pub name: &'static str,
    /// The packages of Debian and Ubuntu that bring it.
    packages: &'static [&'static str],
    is_there: fn() -> bool,
}

/// A C++ compiler.
pub const CXX: Need =
    Need { name: "a C++ compiler", packages: &["g++"], is_there: || which("c++").is_some() };

/// What C and C++ projects are built with.
pub const CMAKE: Need = Need {
    name: "CMake and make",
    packages: &["cmake", "make"],
    is_there: || which("cmake").is_some() && which("make").is_some(),
};

/// What tells compilers where libraries are.
pub const PKG_CONFIG: Need = Need {
    name: "pkg-config",
    packages: &["pkg-config"],
    is_there: || which("pkg-config").is_some(),
};

/// The memory checker.
pub const VALGRIND: Need = Need {
    name: "valgrind",
    // Without libc6-dbg valgrind cannot follow the C library's string functions.
    packages: &["valgrind", "libc6-dbg"],
    is_there: || which("valgrind").is_some(),
};

/// Node, and npm for its packages.
pub const NODE: Need = Need {
    name: "node 18.19 or newer with npm",
    packages: &["nodejs", "npm"],
    is_there: || which("npm").is_some() && node_version() >= Some((18, 19)),
};

/// What imitates other processors, with AVX2 among what it imitates; there is none but for Linux.
pub const QEMU: Need = Need {
    name: "qemu-user 7.2 or newer",
    packages: &["qemu-user"],
    is_there: || {
        cfg!(not(target_os = "linux"))
            || ["qemu-aarch64", "qemu-x86_64"].iter().all(|qemu| qemu_version(qemu) >= Some((7, 2)))
    },
};

/// A browser that can be driven.
pub const CHROMIUM: Need =
    Need { name: "chromium", packages: &["chromium"], is_there: || chromium().is_some() };

/// What draws without a window.
pub const EGL: Need = Need {
    name: "EGL with a driver",
    packages: &["libegl1", "libgl1-mesa-dri"],
    is_there: || cfg!(not(target_os = "linux")) || has_egl(&library_dirs()),
};

/// A screen that nobody sees, with a driver that draws on it.
pub const XVFB: Need = Need {
    name: "Xvfb with OpenGL",
    packages: &["xvfb", "xauth", "libgl1", "libgl1-mesa-dri"],
    is_there: || {
        which("xvfb-run").is_some() && which("xauth").is_some() && has_driver(&library_dirs())
    },
};

/// Vulkan with a driver, which may be one that draws without a graphics card.
pub const VULKAN: Need = Need {
    name: "Vulkan with a driver",
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
    is_there: || {
        let drivers = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"].map(Path::new);
        let has_loader = library_dirs().iter().any(|dir| dir.join("libvulkan.so.1").exists());
        cfg!(not(target_os = "linux")) || has_loader && drivers.iter().any(|dir| dir.exists())
    },
};

/// What raylib is built with.
pub const RAYLIB: Need = Need {
    name: "the headers of X11",
    packages: &["libx11-dev", "libxcursor-dev", "libxi-dev", "libxinerama-dev", "libxrandr-dev"],
    is_there: || {
        let wanted = ["Xlib.h", "Xcursor/Xcursor.h", "extensions/XInput2.h"];
        let more = ["extensions/Xinerama.h", "extensions/Xrandr.h"];
        wanted.iter().chain(&more).all(|file| Path::new("/usr/include/X11").join(file).exists())
    },
};

/// The engine OGRE.
pub const OGRE: Need = Need {
    name: "OGRE 1.12",
    packages: &["libogre-1.12-dev"],
    is_there: || shell::succeeds("pkg-config", &["OGRE >= 1.12"]),
};

/// The interpreter.
pub const PYTHON: Need =
    Need { name: "Python 3", packages: &["python3"], is_there: || which("python3").is_some() };

/// What the demo's window needs of X11.
pub const X11: Need = Need {
    name: "the X11 libraries",
    packages: &["libx11-6", "libx11-xcb1", "libxcursor1", "libxi6", "libxrandr2", "libgl1"],
    is_there: || {
        let wanted = ["libX11.so.6", "libX11-xcb.so.1", "libXcursor.so.1", "libXi.so.6"];
        let dirs = library_dirs();
        cfg!(not(target_os = "linux"))
            || wanted.iter().all(|file| dirs.iter().any(|dir| dir.join(file).exists()))
    },
};

/// Makes sure that the machine has all of these.
pub fn ensure(needs: &[&Need]) -> Result {
    let missing = missing(needs);
    if missing.is_empty() {
        return Ok(());
    }
    let names = names(&missing);
    let packages = packages(&missing);
    if which("apt-get").is_none() {
        return Err(Failure::new(format!(
            "missing: {names}; there is no apt-get here, so install what Debian calls {}",
            packages.join(" ")
        )));
    }
    let Some(prefix) = privilege() else {
        return Err(Failure::new(format!("missing: {names}; run: {}", by_hand(&packages))));
    };
    println!("missing: {names}");
    shell::run(&mut apt(prefix, &["update", "-q"]))?;
    let install = ["install", "-y", "-q", "--no-install-recommends"];
    shell::run(apt(prefix, &install).args(&packages))?;
    let still = self::missing(needs);
    if still.is_empty() {
        return Ok(());
    }
    Err(Failure::new(format!(
        "still missing after {}: {}",
        by_hand(&packages),
        self::names(&still)
    )))
}

/// Says what is missing and what would be run, and changes nothing.
pub fn tell(needs: &[&Need]) {
    for need in needs {
        let state = if (need.is_there)() { "there" } else { "missing" };
        println!("{state:8} {} ({})", need.name, need.packages.join(" "));
    }
    let missing = missing(needs);
    if !missing.is_empty() {
        println!("to be run: {}", by_hand(&packages(&missing)));
    }
}

/// Makes sure that Rust can build for a target.
pub fn ensure_target(target: &str) -> Result {
    let mut rustc = shell::command("rustc");
    let libraries = shell::output(rustc.args(["--print", "target-libdir", "--target", target]))?;
    if Path::new(libraries.trim()).is_dir() {
        return Ok(());
    }
    rustup(&format!("rustc cannot build for {target}"), &["target", "add", target])
}

/// Has rustup add what is missing, or says so.
pub fn rustup(missing: &str, args: &[&str]) -> Result {
    if which("rustup").is_none() {
        return Err(Failure::new(format!("{missing}; with rustup: rustup {}", args.join(" "))));
    }
    shell::run(shell::command("rustup").args(args))
}

/// Makes sure that a part of cargo such as `fmt` is there, which `component` brings.
pub fn ensure_component(part: &str, component: &str) -> Result {
    let mut probe = shell::cargo(&[part, "--version"]);
    let probe = probe.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
    if probe.status().is_ok_and(|status| status.success()) {
        return Ok(());
    }
    rustup(&format!("`cargo {part}` is missing"), &["component", "add", component])
}

/// Makes sure that the source of Rust's own library is there, to be built in other ways.
pub fn ensure_std_source() -> Result {
    let root = shell::output(shell::command("rustc").args(["--print", "sysroot"]))?;
    if Path::new(root.trim()).join("lib/rustlib/src/rust/library/Cargo.lock").exists() {
        return Ok(());
    }
    rustup("the source of Rust's library is missing", &["component", "add", "rust-src"])
}

/// The browser.
pub fn chromium() -> Option<PathBuf> {
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
        .into_iter()
        .find_map(which)
}

/// Whether there is a screen to open a window on.
pub fn has_display() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos")) || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

fn missing<'a>(needs: &[&'a Need]) -> Vec<&'a Need> {
    needs.iter().copied().filter(|need| !(need.is_there)()).collect()
}

fn names(needs: &[&Need]) -> String {
    needs.iter().map(|need| need.name).collect::<Vec<_>>().join(", ")
}

fn packages(needs: &[&Need]) -> Vec<&'static str> {
    needs.iter().flat_map(|need| need.packages).copied().collect()
}

/// The one command that a person runs.
fn by_hand(packages: &[&str]) -> String {
    let install = "apt-get install -y --no-install-recommends";
    format!("sudo apt-get update && sudo {install} {}", packages.join(" "))
}

/// What a command must start with to be allowed to install; nothing if it cannot be.
fn privilege() -> Option<&'static [&'static str]> {
    let id = shell::output(shell::command("id").arg("-u")).ok()?;
    if id.trim() == "0" {
        return Some(&[]);
    }
    shell::succeeds("sudo", &["-n", "true"]).then_some(&["sudo", "-n"])
}

fn apt(prefix: &[&str], args: &[&str]) -> std::process::Command {
    let words = [prefix, &["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"], args].concat();
    let mut command = shell::command(words[0]);
    command.args(&words[1..]);
    command
}

fn node_version() -> Option<(u32, u32)> {
    which("node")?;
    version(&shell::output(shell::command("node").arg("--version")).ok()?)
}

fn qemu_version(qemu: &str) -> Option<(u32, u32)> {
    which(qemu)?;
    let told = shell::output(shell::command(qemu).arg("--version")).ok()?;
    version(told.lines().next()?.split("version ").nth(1)?.split(' ').next()?)
}

/// The first two numbers of `v20.1.2`.
fn version(text: &str) -> Option<(u32, u32)> {
    let mut numbers = text.trim().trim_start_matches('v').split('.').map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}

/// The folders that hold shared libraries: the usual ones, and those of each architecture in them.
fn library_dirs() -> Vec<PathBuf> {
    let mut dirs: Vec<_> =
        ["/usr/lib", "/usr/lib64", "/usr/local/lib", "/lib"].map(PathBuf::from).into();
    for top in dirs.clone() {
        let inner =
            std::fs::read_dir(top).into_iter().flatten().flatten().map(|entry| entry.path());
        let own = format!("{}-linux", std::env::consts::ARCH);
        dirs.extend(inner.filter(|dir| {
            dir.file_name().is_some_and(|name| name.to_string_lossy().starts_with(&own))
        }));
    }
    dirs
}

/// Whether there are EGL, a vendor behind it, and for Mesa a driver that draws on any machine.
fn has_egl(dirs: &[PathBuf]) -> bool {
    let any = |start: &str| dirs.iter().any(|dir| has_file(dir, start));
    any("libEGL.so.1") && (any("libEGL_nvidia") || any("libEGL_mesa") && has_driver(dirs))
}

/// Whether there is Mesa's driver that draws on any machine.
fn has_driver(dirs: &[PathBuf]) -> bool {
    dirs.iter().any(|dir| has_file(dir, "libgallium") || has_file(&dir.join("dri"), "swrast_dri"))
}

/// Whether a file of a folder begins with this.
fn has_file(dir: &Path, start: &str) -> bool {
    let names = std::fs::read_dir(dir).into_iter().flatten().flatten().map(|e| e.file_name());
    names.into_iter().any(|name| name.to_string_lossy().starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_to_run_by_hand_names_every_package_once() {
        let command = by_hand(&packages(&[&NODE, &EGL]));
        assert_eq!(
            command,
            "sudo apt-get update && sudo apt-get install -y --no-install-recommends \
             nodejs npm libegl1 libgl1-mesa-dri"
        );
    }

    #[test]
    fn node_versions_compare_by_number() {
        assert_eq!(version("v18.20.4\n"), Some((18, 20)));
        assert!(
            version("v18.9.0") < version("v18.15.0") && version("v20.0.0") > version("v18.15.0")
        );
        assert_eq!(version("not node"), None);
    }

    #[test]
    fn egl_without_a_driver_is_not_enough() {
        let dir = crate::files::target().join("xtask-tests").join("egl");
        crate::files::make_empty(&dir).unwrap();
        let dirs = [dir.clone()];
        assert!(!has_egl(&dirs));
        for name in ["libEGL.so.1", "libEGL_mesa.so.0"] {
            crate::files::write(&dir.join(name), "").unwrap();
        }
        assert!(!has_egl(&dirs));
        crate::files::make(&dir.join("dri")).unwrap();
        crate::files::write(&dir.join("dri").join("swrast_dri.so"), "").unwrap();
        assert!(has_egl(&dirs));
    }
}
