//! Where the piece of a law ends that holds.

use nboom_dynamics::Recursive;
use nboom_elements::{Coordinate, ElementId, Elements, Switched};
use nboom_model::Mode;
use nboom_scalar::{Number, Real};

/// A bound at which the piece of a law that holds ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bound {
    pub element: ElementId,
    /// Which of the element's bounds.
    pub number: usize,
    /// Whether the piece ends above it and not below.
    pub rises: bool,
}

impl Bound {
    /// The piece that holds beyond it.
    pub fn next_piece(self) -> usize {
        self.number + usize::from(self.rises)
    }

    pub fn scale<R: Real>(self, elements: &Elements<R>) -> f64 {
        elements.switched()[self.element.index].scale(self.number)
    }

    /// The bounds of the pieces that hold in `mode` of all elements that can come to one.
    pub fn all<R: Number>(dynamics: &Recursive<R>, mode: &Mode) -> impl Iterator<Item = Self> {
        let can_move = move |coordinate| match coordinate {
            Coordinate::Length(line) => dynamics.elements().lines()[line].link.is_some(),
            Coordinate::Angle(hinge) | Coordinate::Rate(hinge) => mode.is_free(hinge),
        };
        let moving = dynamics.elements().switched().iter().filter(move |e| can_move(e.coordinate));
        let of_element = move |element: &Switched| {
            let (id, piece) = (element.id, mode.pieces[element.id.index]);
            let below = piece.checked_sub(1).filter(|number| *number < element.bounds.len());
            let below = below.map(|number| (number, false));
            let above = (piece < element.bounds.len()).then_some((piece, true));
            let ends = below.into_iter().chain(above);
            ends.map(move |(number, rises)| Bound { element: id, number, rises })
        };
        moving.flat_map(of_element)
    }
}
