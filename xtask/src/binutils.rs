//! The programs that read and write object files: those of this machine, or those of LLVM, which
//! serve all targets.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::setup;
use crate::shell;

/// Programs for object files. All take the options of the GNU programs.
pub struct Binutils {
    pub ld: PathBuf,
    pub nm: PathBuf,
    pub objcopy: PathBuf,
    pub strip: PathBuf,
    pub ar: PathBuf,
}

impl Binutils {
    /// The programs of this machine, for its own libraries.
    pub fn host() -> Self {
        let [ld, nm, objcopy, strip, ar] = ["ld", "nm", "objcopy", "strip", "ar"].map(Into::into);
        Self { ld, nm, objcopy, strip, ar }
    }

    /// The programs that belong to the Rust compiler, for the libraries of all targets.
    pub fn llvm() -> Result<Self> {
        let dir = setup::ensure_llvm_tools()?;
        Ok(Self {
            ld: dir.join("gcc-ld/ld.lld"),
            nm: dir.join("llvm-nm"),
            objcopy: dir.join("llvm-objcopy"),
            strip: dir.join("llvm-strip"),
            ar: dir.join("llvm-ar"),
        })
    }

    /// Links archives into one archive of one object, which exports the functions `names` only, so
    /// that the copy of Rust's standard library in it cannot clash with another one. `work` is a
    /// folder for what lies between.
    pub fn prelink(
        &self,
        archives: &[&Path],
        names: &[String],
        work: &Path,
        archive: &Path,
    ) -> Result {
        let (whole, object, list) =
            (work.join("whole.o"), work.join("muslin.o"), work.join("exports"));
        crate::files::write(&list, &(names.join("\n") + "\n"))?;
        let mut ld = shell::command(&self.ld);
        ld.args(["-r", "--gc-sections", "--force-group-allocation"]);
        names.iter().for_each(|name| {
            ld.args(["-u", name]);
        });
        // The whole command would fill the screen.
        println!("$ ld -r … -o {} libmuslin.a", whole.display());
        shell::output(ld.arg("-o").arg(&whole).args(archives))?;
        let mut keep = std::ffi::OsString::from("--keep-global-symbols=");
        keep.push(&list);
        // A linked object needs no bytecode for link-time optimisation.
        let drop = ["--strip-debug", "--remove-section=.llvmbc", "--remove-section=.llvmcmd"];
        shell::run(shell::command(&self.objcopy).arg(keep).args(drop).arg(&whole).arg(&object))?;
        shell::run(shell::command(&self.ar).arg("rcsD").arg(archive).arg(&object))
    }
}
