//! Godot from Debian's unstable release, below `target`: beside the system, without root.
//!
//! ```text
//! apt with folders of its own ─▶ packages of Godot and all that it needs, the C library included
//! dpkg-deb ─▶ target/godot/engine ─▶ its dynamic loader ─▶ its Godot
//! ```
//! Stable releases of Debian have no Godot that loads extensions. The address is that of the mirror
//! that this machine's apt uses.

use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};
use crate::shell::which;
use crate::{files, shell};

/// The release of Debian that has Godot 4.
const RELEASE: &str = "sid";

/// Folders of libraries in the engine's folder.
const LIBRARIES: [&str; 2] = ["usr/lib/x86_64-linux-gnu", "usr/lib/x86_64-linux-gnu/pulseaudio"];

/// Installs Godot unless it is there, and returns the words that start it.
///
/// # Errors
/// Fails where there is no apt of Debian or another processor than x86-64.
pub fn godot() -> Result<Vec<PathBuf>> {
    let dir = files::target().join("godot/engine");
    let program = dir.join("usr/bin/godot");
    if !program.exists() {
        let _lock = files::lock("godot-engine")?;
        if !program.exists() {
            download(&dir)?;
        }
    }
    let loader = dir.join("usr/lib64/ld-linux-x86-64.so.2");
    let libraries = LIBRARIES.map(|folder| dir.join(folder).display().to_string()).join(":");
    Ok(vec![loader, "--library-path".into(), libraries.into(), program])
}

fn download(dir: &Path) -> Result {
    let has_tools = which("apt-get").is_some() && which("dpkg-deb").is_some();
    if !(has_tools && cfg!(all(target_os = "linux", target_arch = "x86_64"))) {
        return Err(Failure::new("only on x86-64 Debian it can be installed below target"));
    }
    let mirror = mirror()?;
    let apt = files::target().join("godot/apt");
    for folder in ["lists/partial", "cache/archives/partial"] {
        files::create_dir(&apt.join(folder))?;
    }
    files::write(&apt.join("sources.list"), &format!("deb {mirror} {RELEASE} main\n"))?;
    files::write(&apt.join("status"), "")?;
    let run_apt = |args: &[&str]| {
        let mut command = shell::command("apt-get");
        for (option, value) in [
            ("Dir::Etc::sourcelist", "sources.list"),
            ("Dir::Etc::sourceparts", "none"),
            ("Dir::State::lists", "lists"),
            ("Dir::State::status", "status"),
            ("Dir::State::extended_states", "extended"),
            ("Dir::Cache", "cache"),
        ] {
            command.arg("-o").arg(format!("{option}={}", apt.join(value).display()));
        }
        command.args(["-o", "Debug::NoLocking=1", "-o", "APT::Sandbox::User=", "-qq"]);
        shell::run(command.args(args))
    };
    run_apt(&["update"])?;
    let install = ["install", "--download-only", "-y", "--no-install-recommends"];
    run_apt(&[&install[..], &["godot", "libgl1-mesa-dri"]].concat())?;
    let unpacked = dir.with_extension("unpacked");
    files::create_empty_dir(&unpacked)?;
    for package in files::with_suffix(&apt.join("cache/archives"), ".deb")? {
        let mut dpkg = shell::command("dpkg-deb");
        shell::output(dpkg.arg("--extract").arg(&package).arg(&unpacked))?;
    }
    std::fs::remove_dir_all(&apt).during(|| format!("removing {}", apt.display()))?;
    std::fs::rename(&unpacked, dir).during(|| format!("naming {}", dir.display()))
}

/// The mirror of Debian in the sources of this machine's apt.
fn mirror() -> Result<String> {
    let mut apt = shell::command("apt-get");
    apt.args(["indextargets", "--format", "$(LABEL) $(REPO_URI)", "Identifier: Packages"]);
    let targets = shell::output(&mut apt)?;
    let found = targets.lines().find_map(|line| line.strip_prefix("Debian "));
    found
        .map(String::from)
        .ok_or_else(|| Failure::new("apt knows no mirror of Debian; run apt-get update"))
}
