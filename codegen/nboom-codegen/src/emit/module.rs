//! What one file of generated code has.

use std::fmt::Write;

use nboom_formulation::Formulation;
use nboom_model::{Scene, Structure};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::file::{self, Standing};
use crate::emit::routine::{generate, quiet, scalar, source};
use crate::emit::text::formatted;
use crate::hash;
use crate::request::{CodegenError, Level, Output, Request, StressRequest};
use crate::trace::Equations;

/// Routines that stand together.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// Routines for accelerations, equations, inverse dynamics and right sides.
    pub routines: Vec<Request>,
    /// Routines for loads and stresses.
    pub stresses: Vec<StressRequest>,
}

impl Module {
    /// What a simulator for a scene has: [`Request::of_simulator`], right sides, and with a structure code
    /// for its loads and stresses, unless that is too long for a compiler. A scene without structure has
    /// nothing of loads and stresses.
    ///
    /// # Errors
    /// When the scene is not made of chains and paddles, or a section is not one.
    pub fn of_simulator(
        scene: &Scene,
        structure: Option<&Structure>,
        formulation: Formulation,
        level: Level,
    ) -> Result<Self, CodegenError> {
        let routines = Request::of_simulator(scene, formulation, level)?;
        let stresses = structure.map(|structure| StressRequest::of_scene(scene, structure, level));
        let stresses: Vec<StressRequest> = stresses.transpose()?.into_iter().collect();
        let is_short = |request: &StressRequest| request.check_length().is_ok();
        let stresses = stresses.into_iter().filter(is_short).collect();
        Ok(Self { routines, stresses }.with_right_sides(scene))
    }

    /// With [`Request::right_sides`] beside the routines for accelerations of a scene, but for code that
    /// would be too long.
    pub fn with_right_sides(mut self, scene: &Scene) -> Self {
        let is_right = |request: &Request| request.check().is_ok();
        // What is wrong with a routine is told when it is generated.
        if self.routines.iter().all(is_right) {
            let right_sides = Request::right_sides(scene, &self.routines).into_iter();
            let is_short = |request: &Request| is_right(request) && Equations::of(request).is_ok();
            self.routines.extend(right_sides.filter(is_short));
        }
        self
    }

    /// Sets the path of the crate `nboom_scalar` where the code is to stand.
    pub fn at(mut self, scalar_path: &str) -> Self {
        let of_routines = self.routines.iter_mut().map(|request| &mut request.scalar_path);
        let of_stresses = self.stresses.iter_mut().map(|request| &mut request.scalar_path);
        of_routines.chain(of_stresses).for_each(|path| scalar_path.clone_into(path));
        self
    }

    /// All routines and the function `kernels` that lists those ready to run.
    ///
    /// # Errors
    /// As [`generate`] and [`StressRequest::generate`].
    pub fn tokens(&self) -> Result<TokenStream, CodegenError> {
        let mut all = TokenStream::new();
        for request in &self.routines {
            all.extend(generate(request)?.tokens);
        }
        for request in &self.stresses {
            all.extend(request.generate()?.tokens);
        }
        all.extend(self.table()?);
        Ok(all)
    }

    /// The routines one after the other, under a line that tells what they were generated from,
    /// and the function `kernels`.
    ///
    /// # Errors
    /// As [`tokens`](Self::tokens).
    pub fn text(&self) -> Result<String, CodegenError> {
        let routines = self.routines.iter().map(source);
        let stresses = self.stresses.iter().map(StressRequest::source);
        let mut parts: Vec<String> =
            routines.chain(stresses).collect::<Result<_, CodegenError>>()?;
        parts.extend(Some(formatted(self.table()?)).filter(|table| !table.is_empty()));
        let text = as_written(&parts.join("\n"));
        Ok(format!("{}\n{text}", file::head(self.key(), hash(text.as_bytes()))))
    }

    /// How a text stands to [`text`](Self::text); nothing is generated to find out.
    pub fn standing(&self, text: &str) -> Standing {
        file::standing(text, self.key())
    }

    /// A number for everything that the code depends on: the requests and the generator.
    pub fn key(&self) -> u64 {
        let mut text = env!("NBOOM_GENERATOR").to_owned();
        // Debug writes every field, and numbers so that they read back the same.
        write!(text, "{self:?}").expect("a string takes any text");
        hash(text.as_bytes())
    }

    /// Code of a function `kernels` that lists the routines ready to run, and of a function `batches`;
    /// equations and inverse dynamics are left out, since no run takes them, and there are no functions where nothing is left.
    fn table(&self) -> Result<TokenStream, CodegenError> {
        let runs = |request: &&Request| {
            matches!(request.output, Output::Accelerations | Output::RightSide)
        };
        let routines = self.routines.iter().filter(runs).map(|r| (&r.name, &r.scalar_path));
        let stresses = self.stresses.iter().map(|r| (&r.name, &r.scalar_path));
        let listed: Vec<(&String, &String)> = routines.chain(stresses).collect();
        let Some((name, path)) = listed.first() else { return Ok(TokenStream::new()) };
        let scalar = scalar(name, path)?;
        let count = Literal::usize_unsuffixed(listed.len());
        let names = listed.iter().map(|(name, _)| format_ident!("{name}"));
        let on_eight = self.routines.iter().filter(|request| request.on_eight_states);
        let batched = on_eight.map(|request| format_ident!("{}", request.name));
        let batched: Vec<_> = batched.collect();
        let batch_count = Literal::usize_unsuffixed(batched.len());
        let quiet = quiet();
        Ok(quote! {
            /// The routines, ready to run on this processor.
            #quiet
            pub fn kernels() -> &'static [#scalar::Kernel] {
                static ALL: ::std::sync::OnceLock<[#scalar::Kernel; #count]> =
                    ::std::sync::OnceLock::new();
                ALL.get_or_init(|| [#(#scalar::Kernel::of::<#names>()),*])
            }

            /// Right sides on eight states at once, ready to run on this processor.
            #quiet
            pub fn batches() -> &'static [#scalar::Batch] {
                static ALL: ::std::sync::OnceLock<[#scalar::Batch; #batch_count]> =
                    ::std::sync::OnceLock::new();
                ALL.get_or_init(|| [#(#scalar::Batch::of::<#batched>()),*])
            }
        })
    }
}

/// The text of items with what keeps rustfmt from them: the program around them may have another style, and a file
/// that was changed counts as edited.
fn as_written(items: &str) -> String {
    // Each of them is quiet.
    items.replace("\n#[allow(", "\n#[rustfmt::skip]\n#[allow(")
}

impl From<Vec<Request>> for Module {
    fn from(routines: Vec<Request>) -> Self {
        Self { routines, stresses: Vec::new() }
    }
}
