use nboom_io::{InputError, parse_deck};
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

    /// The text of the scene's file.
    pub const fn text(&self) -> &'static str {
        self.text
    }

    /// The scene.
    ///
    /// # Errors
    /// None unless the program was compiled with another version of the reader.
    pub fn scene(&self) -> Result<Scene, InputError> {
        parse_deck(self.file, self.text, self.name).map(|file| file.scene)
    }

    /// The scene's stations and slices, if it has any.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    pub fn structure(&self) -> Result<Option<Structure>, InputError> {
        parse_deck(self.file, self.text, self.name).map(|file| file.structure)
    }

    /// Routines for this scene: with its numbers built in, with numbers at run time, and for states
    /// with held hinges, for [`Options::kernels`](crate::sim::Options::kernels); of a scene with
    /// stations also for its loads and stresses, for
    /// [`StressAnalysis::with_kernels`](crate::strength::StressAnalysis::with_kernels).
    pub fn kernels(&self) -> &'static [Kernel] {
        (self.kernels)()
    }
}
