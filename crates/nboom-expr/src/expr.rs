use std::cell::RefCell;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use nboom_scalar::Real;

use crate::fold;
use crate::graph::{Builder, Id, Node};

thread_local! {
    /// The graph under construction; it exists only inside [`record`].
    static BUILDER: RefCell<Option<Builder>> = const { RefCell::new(None) };
}

/// A scalar that stands for a node of the graph being recorded.
///
/// Two are equal when they are the same node. Outside [`Graph::trace`](crate::Graph::trace)
/// every operation panics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expr(Id);

/// Runs `computation` with `empty` as the graph; returns the graph and the results.
pub(crate) fn record(
    empty: Builder,
    computation: impl FnOnce() -> Vec<Expr>,
) -> (Builder, Vec<Expr>) {
    let outer = BUILDER.replace(Some(empty));
    let results = computation();
    let builder = BUILDER.replace(outer).expect("only record takes the graph away");
    (builder, results)
}

fn with_builder<T>(use_builder: impl FnOnce(&mut Builder) -> T) -> T {
    BUILDER.with_borrow_mut(|builder| {
        use_builder(builder.as_mut().expect("Expr is used only inside Graph::trace"))
    })
}

impl Expr {
    pub(crate) fn input(i: usize) -> Self {
        Self(with_builder(|builder| builder.intern(Node::Input(i as u32))))
    }

    pub(crate) fn id(self) -> Id {
        self.0
    }
}

impl Real for Expr {
    fn constant(value: f64) -> Self {
        Self(with_builder(|builder| fold::constant(builder, value)))
    }

    fn sqrt(self) -> Self {
        Self(with_builder(|builder| fold::sqrt(builder, self.0)))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = with_builder(|builder| fold::sin_cos(builder, self.0));
        (Self(sin), Self(cos))
    }

    fn remark(words: impl FnOnce() -> String) {
        let words = words();
        with_builder(|builder| builder.remark(words));
    }
}

impl Add for Expr {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(with_builder(|builder| fold::add(builder, self.0, other.0)))
    }
}

impl Sub for Expr {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(with_builder(|builder| fold::sub(builder, self.0, other.0)))
    }
}

impl Mul for Expr {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(with_builder(|builder| fold::mul(builder, self.0, other.0)))
    }
}

impl Div for Expr {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self(with_builder(|builder| fold::div(builder, self.0, other.0)))
    }
}

impl Neg for Expr {
    type Output = Self;
    fn neg(self) -> Self {
        Self(with_builder(|builder| fold::neg(builder, self.0)))
    }
}

impl AddAssign for Expr {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Expr {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
