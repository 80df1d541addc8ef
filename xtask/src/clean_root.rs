//! Tries the packed artefacts as a new user would, in a root file system that holds nothing else: a
//! new Debian, in which each script of `tests/clean-root` installs one artefact and runs the program
//! of its README.
//!
//! ```text
//! dist/release/*.tar.gz ─┐                               ┌─ c.sh       CMake
//! dist/python/*.whl ─────┼─▶ /artefacts of a new Debian ─┼─ python.sh  pip
//! dist/*.tgz ────────────┘                               └─ react.sh   npm, Vite, React ─▶ Chromium
//! ```

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::serve::{Mount, Server};
use crate::setup::{self, Need};
use crate::{browser, clients, dist, files, python, shell};

/// What making the root needs, beside what the artefacts need.
pub const NEEDS: &[&Need] =
    &[&setup::DEBOOTSTRAP, &setup::NODE, &setup::CHROMIUM, &setup::CXX, &setup::PYTHON_VENV];

const TARGET: &str = "x86_64-unknown-linux-gnu";

/// The release of Debian, whose node is new enough for Vite.
const RELEASE: &str = "trixie";

/// What a user of the three languages has installed.
const PACKAGES: &str = "ca-certificates cmake gcc libc6-dev make nodejs npm python3-venv";

const SCRIPTS: [&str; 3] = ["c.sh", "python.sh", "react.sh"];

const PATH: &str = "PATH=/usr/sbin:/usr/bin:/sbin:/bin";

/// Files of this machine that programs in the root need to reach package registries.
const NETWORK: [&str; 2] = ["etc/resolv.conf", "etc/ssl/certs/ca-certificates.crt"];

/// Builds the artefacts, makes the root, runs the scripts in it, and opens the page of the last one.
pub fn test() -> Result {
    check_machine()?;
    let artefacts = artefacts()?;
    let work = files::target().join("clean-root");
    let root = work.join("root");
    make_root(&root)?;
    for (from, to) in [(&artefacts[..], "artefacts"), (&scripts()[..], "scripts")] {
        files::create_empty_dir(&root.join(to))?;
        for file in from {
            let name = file.file_name().unwrap_or_default();
            let during = || format!("copying {}", file.display());
            std::fs::copy(file, root.join(to).join(name)).during(during)?;
        }
    }
    files::create_empty_dir(&root.join("home"))?;
    for script in SCRIPTS {
        shell::run(inside(&root).args(["sh", &format!("/scripts/{script}")]))?;
    }
    let page = Mount { at: "/", dir: root.join("home/react/dist") };
    let url = Server::open(vec![page], 0)?.spawn();
    browser::node_test("tests/web/clean-root.test.mjs", &url, &[("MUSLIN_WORK", &work)])
}

/// Fails with one line where no root can be made.
fn check_machine() -> Result {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err(Failure::new("the clean root is made on x86-64 Linux only"));
    }
    let user = shell::output(shell::command("id").arg("-u"))?;
    if user.trim() != "0" {
        return Err(Failure::new("making a clean root needs the user root: chroot is refused"));
    }
    Ok(())
}

/// Builds the artefacts, and returns their files.
fn artefacts() -> Result<[PathBuf; 3]> {
    dist::run(&[TARGET.into()])?;
    python::install()?;
    clients::pack_for_tests()?;
    Ok([dist::archive_of(TARGET)?, python::wheel()?, clients::tarball()])
}

fn scripts() -> [PathBuf; 3] {
    SCRIPTS.map(|name| files::root().join("tests/clean-root").join(name))
}

/// Makes a new Debian in `root`, unless an earlier run has; its /home is emptied later.
fn make_root(root: &Path) -> Result {
    let stamp = root.with_extension("made");
    let wanted = format!("{RELEASE} {PACKAGES}");
    if files::read(&stamp).is_ok_and(|made| made == wanted) {
        return Ok(());
    }
    files::create_empty_dir(root)?;
    let mut debootstrap = shell::command("debootstrap");
    shell::run(debootstrap.args(["--variant=minbase", RELEASE]).arg(root))?;
    // debootstrap itself does not find packages that others provide.
    let install = format!("apt-get install -qq --no-install-recommends {PACKAGES}");
    shell::run(inside(root).args(["DEBIAN_FRONTEND=noninteractive", "sh", "-c", &install]))?;
    files::write(&stamp, &wanted)
}

/// The start of a command in the root, with the network of this machine, processes of its own, and
/// nothing else of it. Without /proc npm does not see that a script has ended.
fn inside(root: &Path) -> Command {
    for file in NETWORK {
        // A machine may lack one of them, and then reaches registries without it.
        std::fs::copy(Path::new("/").join(file), root.join(file)).ok();
    }
    let certificates = format!("/{}", NETWORK[1]);
    let mut chroot = shell::command("unshare");
    chroot.args(["--fork", "--kill-child", "--pid", "--mount"]);
    chroot.arg(format!("--mount-proc={}", root.join("proc").display()));
    chroot.arg("chroot").arg(root).args(["/usr/bin/env", "-i", PATH, "HOME=/home", "CI=1"]);
    chroot.args(["PIP_CERT", "NODE_EXTRA_CA_CERTS"].map(|name| format!("{name}={certificates}")));
    let proxies = ["http_proxy", "https_proxy"].map(|name| (name, std::env::var(name)));
    chroot.args(
        proxies
            .iter()
            .filter_map(|(name, value)| value.as_ref().ok().map(|value| format!("{name}={value}"))),
    );
    chroot
}
