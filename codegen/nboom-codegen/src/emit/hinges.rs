//! Where loops read and write the numbers of a state.

use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::Topology;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::places::place;
use crate::request::Output;
use crate::trace::Equal;

/// Where ω begins in a state.
pub(crate) fn omega(output: Output) -> usize {
    match output {
        Output::RightSide => RightSideLayout::OMEGA.start,
        _ => 0,
    }
}

/// ω in every lane.
pub(crate) fn omega_spread(output: Output) -> TokenStream {
    let start = omega(output);
    let places = (start..start + 3).map(Literal::usize_unsuffixed);
    quote!(P::spread_all([#(x[#places]),*]))
}

/// A hinge of an appendage: so many from the first one, and those that a variable counts.
pub(crate) type Hinge<'a> = (usize, Option<&'a Ident>);

/// The hinges of a group of equal appendages: those of appendage `a` and those packed with it.
///
/// In a state for accelerations the hinges of equal appendages stand side by side, those of equal parts of a limb part
/// by part; in the variables of a right side all stand appendage by appendage.
pub(crate) struct Hinges<'a> {
    pub group: &'a Equal,
    pub topology: &'a Topology,
    pub output: Output,
}

impl Hinges<'_> {
    /// β of a hinge.
    pub fn beta(&self, hinge: Hinge<'_>) -> TokenStream {
        match self.output {
            Output::RightSide => self.among(RightSideLayout::beta(self.topology).start, hinge),
            _ => self.in_row(0, hinge),
        }
    }

    /// τ of a hinge.
    pub fn tau(&self, hinge: Hinge<'_>) -> TokenStream {
        match self.output {
            Output::RightSide => self.among(RightSideLayout::tau(self.topology).start, hinge),
            _ => self.in_row(1, hinge),
        }
    }

    /// The torque about a hinge, of a state for accelerations.
    pub fn torque(&self, hinge: Hinge<'_>) -> TokenStream {
        self.in_row(2, hinge)
    }

    /// Writes τ̇ of a hinge.
    pub fn write(&self, tau_dot: &Ident, hinge: Hinge<'_>) -> TokenStream {
        let start = match self.output {
            Output::RightSide => RightSideLayout::tau(self.topology).start,
            _ if self.group.part.is_some() => Layout::OUTPUT,
            _ => {
                let start = Layout::OUTPUT + self.group.hinge;
                let at = self.place(start, [self.group.count, 1], hinge);
                return quote!(#tau_dot.scatter(out, #at););
            }
        };
        let (at, links) = self.apart(start, hinge);
        quote!(#tau_dot.scatter_apart(out, #at, #links);)
    }

    /// β, τ or torque by `row`, which follow each other for all appendages, and for each hinge of a part.
    fn in_row(&self, row: usize, hinge: Hinge<'_>) -> TokenStream {
        let first = Layout::STATE + Layout::HINGE * self.group.hinge;
        if self.group.part.is_some() {
            let part = Layout::HINGE * self.group.shape.hinges();
            let at = self.place(first + row, [Layout::HINGE, part], hinge);
            let part = Literal::usize_unsuffixed(part);
            return quote!(P::gather_apart(x, #at, #part));
        }
        let count = self.group.count;
        let start = first + row * count;
        let at = self.place(start, [Layout::HINGE * count, 1], hinge);
        quote!(P::gather(x, #at))
    }

    /// What stands among the numbers of all hinges, which begin at `start`.
    fn among(&self, start: usize, hinge: Hinge<'_>) -> TokenStream {
        let (at, links) = self.apart(start, hinge);
        quote!(P::gather_apart(x, #at, #links))
    }

    /// The place of a hinge among the numbers of all, and how far that of the next appendage is.
    fn apart(&self, start: usize, hinge: Hinge<'_>) -> (TokenStream, Literal) {
        let links = self.group.shape.hinges();
        let at = self.place(start + self.group.hinge, [1, links], hinge);
        (at, Literal::usize_unsuffixed(links))
    }

    /// `start` and strides from hinge to hinge and from appendage to appendage.
    fn place(
        &self,
        start: usize,
        [hinges, appendages]: [usize; 2],
        hinge: Hinge<'_>,
    ) -> TokenStream {
        let (first, i) = hinge;
        let a = format_ident!("a");
        place(start + hinges * first, &[(hinges, i), (appendages, Some(&a))])
    }
}
