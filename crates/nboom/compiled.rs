use std::path::Path;

use nboom_io::{Format, InputError, ReadOptions, SceneFile, parse};
use nboom_model::{Scene, Structure};
use nboom_scalar::Kernel;

/// A scene that is part of the program, with routines generated for it; made by
/// [`scene!`](crate::scene).
#[derive(Clone, Copy, Debug)]
pub struct CompiledScene {
    file: &'static str,
    name: &'static str,
    text: &'static str,
    kernels: fn() -> &'static [Kernel],
}

impl CompiledScene {
    /// What the macro expands to.
    #[doc(hidden)]
    pub const fn new(
        file: &'static str,
        name: &'static str,
        text: &'static str,
        kernels: fn() -> &'static [Kernel],
    ) -> Self {
        Self { file, name, text, kernels }
    }

    /// The name of the scene.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The text of the scene: of a deck its file, of a scene in TOML what stands for it and all files
    /// that it includes.
    pub const fn text(&self) -> &'static str {
        self.text
    }

    /// The scene.
    ///
    /// # Errors
    /// None unless the program was compiled with another version of the reader.
    pub fn scene(&self) -> Result<Scene, InputError> {
        self.read().map(|file| file.scene)
    }

    /// The scene's stations and slices, if it has any.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    pub fn structure(&self) -> Result<Option<Structure>, InputError> {
        self.read().map(|file| file.structure)
    }

    fn read(&self) -> Result<SceneFile, InputError> {
        let path = Path::new(self.file);
        let format = Format::of(path).ok_or_else(|| InputError::NotAScene { path: path.into() })?;
        parse(format, (self.file, self.text), self.name, None, &ReadOptions::default())
    }

    /// Routines for this scene: with its numbers built in, with numbers at run time, and for states
    /// with held hinges, for [`Options::kernels`](crate::sim::Options::kernels); of a scene with
    /// stations also for its loads and stresses, for
    /// [`StressAnalysis::with_kernels`](crate::strength::StressAnalysis::with_kernels).
    pub fn kernels(&self) -> &'static [Kernel] {
        (self.kernels)()
    }
}
