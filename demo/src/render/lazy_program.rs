//! Shader program that is compiled when it is first needed.
//!
//! Method: the first frame compiles only what it draws; each later frame prepares one more program,
//! so that none of them is missing when a scene, a cut or the wireframe first needs it.
//!
//! Reads the sources; writes a compiled program.
//!
//! Invariant: a program is compiled at most once per context.

use std::cell::OnceCell;

use three_d::{Context, CoreError, Program};

/// Sources of a program, and the program once it is compiled.
pub(super) struct LazyProgram {
    context: Context,
    vertex: &'static str,
    fragment: &'static str,
    program: OnceCell<Program>,
}

impl LazyProgram {
    pub(super) fn new(context: &Context, vertex: &'static str, fragment: &'static str) -> Self {
        Self { context: context.clone(), vertex, fragment, program: OnceCell::new() }
    }

    /// Returns the program; compiles it if needed.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub(super) fn get(&self) -> Result<&Program, CoreError> {
        if let Some(program) = self.program.get() {
            return Ok(program);
        }
        let program = Program::from_source(&self.context, self.vertex, self.fragment)?;
        Ok(self.program.get_or_init(|| program))
    }

    /// Returns whether the program is compiled.
    pub(super) fn is_ready(&self) -> bool {
        self.program.get().is_some()
    }
}
