use nboom_model::{Scene, piece_of_friction};
use nboom_scalar::Number;

use crate::{Kind, elements};

/// Which of the elements with several pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementId {
    /// Its place in [`Mode::pieces`](nboom_model::Mode).
    pub index: usize,
    /// What it is.
    pub kind: Kind,
    /// The hinge, or the hinge of the body, on which it acts.
    pub hinge: usize,
}

/// A force element whose law has several pieces, each of them smooth, one after another along a
/// length, an angle or a rate; which of them holds is in [`Mode::pieces`](nboom_model::Mode).
#[derive(Clone, Debug, PartialEq)]
pub struct Switched {
    /// Which one it is.
    pub id: ElementId,
    /// What its law is a function of.
    pub coordinate: Coordinate,
    /// Where one piece ends and the next begins, ascending: piece p reaches from bound p − 1 to
    /// bound p \[L, rad or rad/T\].
    pub bounds: Vec<f64>,
}

/// What the law of an element is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// The length of a [`Line`](crate::Line), by its place among [`Elements::lines`](crate::Elements).
    Length(usize),
    /// The angle of a hinge.
    Angle(usize),
    /// The rate of a hinge.
    Rate(usize),
}

impl Switched {
    /// Writes all of a scene to `all`, in the order of [`Mode::pieces`](nboom_model::Mode).
    pub(crate) fn write_all(scene: &Scene, all: &mut Vec<Self>) {
        let mut count = 0;
        elements::switched(scene, |kind, hinge, coordinate, at| {
            let id = ElementId { index: count, kind, hinge };
            let room = all.get_mut(count).map(|one| std::mem::take(&mut one.bounds));
            let mut bounds = room.unwrap_or_default();
            bounds.clear();
            bounds.extend(at);
            let one = Self { id, coordinate, bounds };
            match all.get_mut(count) {
                Some(place) => *place = one,
                None => all.push(one),
            }
            count += 1;
        });
        all.truncate(count);
    }

    /// The piece that holds at `value` of the coordinate; at a bound, the one below, but for rates of zero, which have
    /// one of their own.
    pub fn piece_at<R: Number>(&self, value: R) -> usize {
        if let Coordinate::Rate(_) = self.coordinate {
            return piece_of_friction(value.to_f64());
        }
        let is_beyond = |&&bound: &&f64| R::to_f64(value - R::constant(bound)) > 0.0;
        self.bounds.iter().take_while(is_beyond).count()
    }

    /// The size by which differences from a bound are judged: the bound's own of a length, a
    /// radian of an angle; zero of a rate, which is exactly at its bound or elsewhere.
    pub fn scale(&self, bound: usize) -> f64 {
        match self.coordinate {
            Coordinate::Length(_) => self.bounds[bound],
            Coordinate::Angle(_) => 1.0,
            Coordinate::Rate(_) => 0.0,
        }
    }
}
