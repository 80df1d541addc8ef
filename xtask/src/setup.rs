//! Programs and libraries that chores need: finds missing ones, and installs them where that is
//! allowed.

use std::path::{Path, PathBuf};

use crate::failure::{Failure, Result};
use crate::files;
use crate::shell::{self, which};

/// A program or library that a chore needs.
pub struct Need {
    /// Its usual name.
    pub name: &'static str,
    /// The packages of Debian and Ubuntu that contain it.
    packages: &'static [&'static str],
    is_installed: fn() -> bool,
}

/// A C++ compiler.
pub const CXX: Need =
    Need { name: "a C++ compiler", packages: &["g++"], is_installed: || which("c++").is_some() };

/// CMake and make.
pub const CMAKE: Need = Need {
    name: "CMake and make",
    packages: &["cmake", "make"],
    is_installed: || which("cmake").is_some() && which("make").is_some(),
};

/// The program that finds libraries for compilers.
pub const PKG_CONFIG: Need = Need {
    name: "pkg-config",
    packages: &["pkg-config"],
    is_installed: || which("pkg-config").is_some(),
};

/// The memory checker.
pub const VALGRIND: Need = Need {
    name: "valgrind",
    // Valgrind needs libc6-dbg to intercept the string functions of the C library.
    packages: &["valgrind", "libc6-dbg"],
    is_installed: || which("valgrind").is_some(),
};

/// Node and npm.
pub const NODE: Need = Need {
    name: "node 18.19 or newer with npm",
    packages: &["nodejs", "npm"],
    is_installed: || which("npm").is_some() && node_version() >= Some((18, 19)),
};

/// Node and npm in a version that frameworks run in.
pub const NEW_NODE: Need = Need {
    name: "node 20.19 or newer with npm",
    packages: &["nodejs", "npm"],
    is_installed: || which("npm").is_some() && node_version() >= Some((20, 19)),
};

/// The emulator of other processors, in a version that emulates AVX2; on Linux only.
pub const QEMU: Need = Need {
    name: "qemu-user 7.2 or newer",
    packages: &["qemu-user"],
    is_installed: || {
        cfg!(not(target_os = "linux"))
            || ["qemu-aarch64", "qemu-x86_64"].iter().all(|qemu| qemu_version(qemu) >= Some((7, 2)))
    },
};

/// The C compiler for 64-bit ARM Linux, with its C library.
pub const AARCH64_GCC: Need = Need {
    name: "gcc for aarch64 Linux",
    packages: &["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross"],
    is_installed: || {
        which("aarch64-linux-gnu-gcc").is_some()
            && Path::new("/usr/aarch64-linux-gnu/include/stdio.h").exists()
    },
};

/// The C compiler for Windows.
pub const MINGW: Need = Need {
    name: "MinGW-w64",
    packages: &["gcc-mingw-w64-x86-64"],
    is_installed: || which("x86_64-w64-mingw32-gcc").is_some(),
};

/// The C compiler for WebAssembly.
pub const EMSCRIPTEN: Need = Need {
    name: "Emscripten",
    packages: &["emscripten"],
    is_installed: || which("emcc").is_some() && which("em-config").is_some(),
};

/// What runs programs for Windows.
pub const WINE: Need =
    Need { name: "Wine", packages: &["wine", "wine64"], is_installed: || which("wine").is_some() };

/// Programs that pack and unpack archives for Windows.
pub const ZIP: Need = Need {
    name: "zip and unzip",
    packages: &["zip", "unzip"],
    is_installed: || which("zip").is_some() && which("unzip").is_some(),
};

/// A browser that scripts can control.
pub const CHROMIUM: Need =
    Need { name: "chromium", packages: &["chromium"], is_installed: || chromium().is_some() };

/// EGL, which draws without a window.
pub const EGL: Need = Need {
    name: "EGL with a driver",
    packages: &["libegl1", "libgl1-mesa-dri"],
    is_installed: || cfg!(not(target_os = "linux")) || has_egl(&library_dirs()),
};

/// A virtual screen, with a driver that draws on it.
pub const XVFB: Need = Need {
    name: "Xvfb with OpenGL",
    packages: &["xvfb", "xauth", "libgl1", "libgl1-mesa-dri"],
    is_installed: || {
        which("xvfb-run").is_some() && which("xauth").is_some() && has_driver(&library_dirs())
    },
};

/// Vulkan with a driver, which may be a software renderer.
pub const VULKAN: Need = Need {
    name: "Vulkan with a driver",
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
    is_installed: || {
        let drivers = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"].map(Path::new);
        let has_loader = library_dirs().iter().any(|dir| dir.join("libvulkan.so.1").exists());
        cfg!(not(target_os = "linux")) || has_loader && drivers.iter().any(|dir| dir.exists())
    },
};

/// The headers that raylib needs.
pub const RAYLIB: Need = Need {
    name: "the headers of X11",
    packages: &["libx11-dev", "libxcursor-dev", "libxi-dev", "libxinerama-dev", "libxrandr-dev"],
    is_installed: || {
        let wanted = ["Xlib.h", "Xcursor/Xcursor.h", "extensions/XInput2.h"];
        let more = ["extensions/Xinerama.h", "extensions/Xrandr.h"];
        wanted.iter().chain(&more).all(|file| Path::new("/usr/include/X11").join(file).exists())
    },
};

/// The graphics engine OGRE.
pub const OGRE: Need = Need {
    name: "OGRE 1.12",
    packages: &["libogre-1.12-dev"],
    is_installed: || shell::succeeds("pkg-config", &["OGRE >= 1.12"]),
};

/// The Python interpreter.
pub const PYTHON: Need =
    Need { name: "Python 3", packages: &["python3"], is_installed: || which("python3").is_some() };

/// The Python interpreter with what makes environments, in a version that the tools of the Python
/// package run in.
pub const PYTHON_VENV: Need = Need {
    name: "Python 3.11 or newer with venv",
    packages: &["python3", "python3-venv"],
    is_installed: || {
        // Debian's venv without python3-venv lacks ensurepip.
        let probe = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";
        shell::succeeds("python3", &["-c", probe])
    },
};

/// The compiler and the runtime of C#.
pub const MONO: Need = Need {
    name: "Mono",
    packages: &["mono-mcs", "mono-runtime"],
    is_installed: || which("mcs").is_some() && which("mono").is_some(),
};

/// What makes a new Debian in a folder.
pub const DEBOOTSTRAP: Need = Need {
    name: "debootstrap",
    packages: &["debootstrap"],
    is_installed: || Path::new("/usr/sbin/debootstrap").exists(),
};

/// The X11 libraries that the demo's window needs.
pub const X11: Need = Need {
    name: "the X11 libraries",
    packages: &["libx11-6", "libx11-xcb1", "libxcursor1", "libxi6", "libxrandr2", "libgl1"],
    is_installed: || {
        let wanted = ["libX11.so.6", "libX11-xcb.so.1", "libXcursor.so.1", "libXi.so.6"];
        let dirs = library_dirs();
        cfg!(not(target_os = "linux"))
            || wanted.iter().all(|file| dirs.iter().any(|dir| dir.join(file).exists()))
    },
};

/// Installs those of `needs` that are missing.
///
/// # Errors
/// Where this process may not install, fails with one line that names the missing programs and the
/// command that installs them.
pub fn ensure(needs: &[&Need]) -> Result {
    let missing = missing(needs);
    if missing.is_empty() {
        return Ok(());
    }
    let names = names(&missing);
    let packages = packages(&missing);
    if which("apt-get").is_none() {
        return Err(Failure::new(format!(
            "missing: {names}; there is no apt-get here, so install the equivalents of Debian's {}",
            packages.join(" ")
        )));
    }
    let Some(prefix) = privilege() else {
        return Err(Failure::new(format!("missing: {names}; run: {}", install_command(&packages))));
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
        install_command(&packages),
        self::names(&still)
    )))
}

/// Prints which of `needs` are missing and the command that installs them; installs nothing.
pub fn print_state(needs: &[&Need]) {
    for need in needs {
        let state = if (need.is_installed)() { "found" } else { "missing" };
        println!("{state:8} {} ({})", need.name, need.packages.join(" "));
    }
    let missing = missing(needs);
    if !missing.is_empty() {
        println!("to install: {}", install_command(&packages(&missing)));
    }
}

/// Installs the standard library of a target unless it is there.
pub fn ensure_target(target: &str) -> Result {
    let _lock = files::lock("rustup")?;
    let mut rustc = shell::command("rustc");
    let libraries = shell::output(rustc.args(["--print", "target-libdir", "--target", target]))?;
    if Path::new(libraries.trim()).is_dir() {
        return Ok(());
    }
    rustup(&format!("rustc cannot build for {target}"), &["target", "add", target])
}

/// Runs rustup with `args`; without rustup, fails with `missing` and the command.
pub fn rustup(missing: &str, args: &[&str]) -> Result {
    if which("rustup").is_none() {
        return Err(Failure::new(format!("{missing}; with rustup: rustup {}", args.join(" "))));
    }
    shell::run(shell::command("rustup").args(args))
}

/// Installs `component` unless cargo has the subcommand `part`, such as `fmt`.
pub fn ensure_component(part: &str, component: &str) -> Result {
    let _lock = files::lock("rustup")?;
    let mut probe = shell::cargo(&[part, "--version"]);
    let probe = probe.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
    if probe.status().is_ok_and(|status| status.success()) {
        return Ok(());
    }
    rustup(&format!("`cargo {part}` is missing"), &["component", "add", component])
}

/// Installs the source of Rust's standard library unless it is there.
pub fn ensure_std_source() -> Result {
    let root = shell::output(shell::command("rustc").args(["--print", "sysroot"]))?;
    if Path::new(root.trim()).join("lib/rustlib/src/rust/library/Cargo.lock").exists() {
        return Ok(());
    }
    rustup("the source of Rust's library is missing", &["component", "add", "rust-src"])
}

/// Installs the programs of LLVM that belong to the Rust compiler, and returns their folder.
pub fn ensure_llvm_tools() -> Result<PathBuf> {
    let _lock = files::lock("rustup")?;
    let libraries = shell::output(shell::command("rustc").args(["--print", "target-libdir"]))?;
    let dir = Path::new(libraries.trim()).with_file_name("bin");
    if !dir.join("llvm-nm").exists() {
        rustup("the programs of LLVM are missing", &["component", "add", "llvm-tools"])?;
    }
    Ok(dir)
}

/// The path of the browser.
pub fn chromium() -> Option<PathBuf> {
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
        .into_iter()
        .find_map(which)
}

/// Whether there is a display for windows.
pub fn has_display() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos")) || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

fn missing<'a>(needs: &[&'a Need]) -> Vec<&'a Need> {
    needs.iter().copied().filter(|need| !(need.is_installed)()).collect()
}

fn names(needs: &[&Need]) -> String {
    needs.iter().map(|need| need.name).collect::<Vec<_>>().join(", ")
}

fn packages(needs: &[&Need]) -> Vec<&'static str> {
    needs.iter().flat_map(|need| need.packages).copied().collect()
}

/// The command that installs packages, for a person to run.
fn install_command(packages: &[&str]) -> String {
    let install = "apt-get install -y --no-install-recommends";
    format!("sudo apt-get update && sudo {install} {}", packages.join(" "))
}

/// The words before a command that let it install packages; none if this process may not.
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
    let output = shell::output(shell::command(qemu).arg("--version")).ok()?;
    version(output.lines().next()?.split("version ").nth(1)?.split(' ').next()?)
}

/// The first two numbers of a version such as `v20.1.2`.
fn version(text: &str) -> Option<(u32, u32)> {
    let mut numbers = text.trim().trim_start_matches('v').split('.').map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}

/// The folders of shared libraries: the usual ones, and their folders for this architecture.
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

/// Whether there is EGL with the library of a vendor, and for Mesa a software renderer.
fn has_egl(dirs: &[PathBuf]) -> bool {
    let any = |start: &str| dirs.iter().any(|dir| has_file(dir, start));
    any("libEGL.so.1") && (any("libEGL_nvidia") || any("libEGL_mesa") && has_driver(dirs))
}

/// Whether there is Mesa's software renderer.
fn has_driver(dirs: &[PathBuf]) -> bool {
    dirs.iter().any(|dir| has_file(dir, "libgallium") || has_file(&dir.join("dri"), "swrast_dri"))
}

/// Whether the name of a file in a folder begins with `start`.
fn has_file(dir: &Path, start: &str) -> bool {
    let names = std::fs::read_dir(dir).into_iter().flatten().flatten().map(|e| e.file_name());
    names.into_iter().any(|name| name.to_string_lossy().starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_install_command_names_every_package_once() {
        let command = install_command(&packages(&[&NODE, &EGL]));
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
        let dir = files::target().join("xtask-tests").join("egl");
        files::create_empty_dir(&dir).unwrap();
        let dirs = [dir.clone()];
        assert!(!has_egl(&dirs));
        for name in ["libEGL.so.1", "libEGL_mesa.so.0"] {
            files::write(&dir.join(name), "").unwrap();
        }
        assert!(!has_egl(&dirs));
        files::create_dir(&dir.join("dri")).unwrap();
        files::write(&dir.join("dri").join("swrast_dri.so"), "").unwrap();
        assert!(has_egl(&dirs));
    }
}
