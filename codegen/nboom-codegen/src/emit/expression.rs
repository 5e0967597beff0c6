use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

/// An expression, with what is needed to put it into another one.
#[derive(Clone)]
pub(crate) struct Expression {
    pub tokens: TokenStream,
    /// Columns that it takes.
    pub width: usize,
    strength: Strength,
}

/// How strongly an expression holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Sign,
    Whole,
}

impl Expression {
    /// What stands under a name.
    pub fn named(name: &str) -> Self {
        let ident = format_ident!("{name}");
        Self { tokens: quote!(#ident), width: name.chars().count(), strength: Strength::Whole }
    }

    /// A constant as the shortest literal that reads back the same.
    pub fn constant(value: f64) -> Self {
        let (tokens, width) = match value {
            0.0 => (quote!(R::zero()), 9),
            1.0 => (quote!(R::one()), 8),
            _ => {
                let literal = number(value);
                let written = literal.to_string().replace(' ', "");
                let width = "R::constant()".len() + written.len();
                (quote!(R::constant(#literal)), width)
            }
        };
        Self { tokens, width, strength: Strength::Whole }
    }

    pub fn sum(a: &Self, b: &Self) -> Self {
        Self::binary(a, &quote!(+), b, Strength::Sum)
    }

    pub fn difference(a: &Self, b: &Self) -> Self {
        Self::binary(a, &quote!(-), b, Strength::Sum)
    }

    pub fn product(a: &Self, b: &Self) -> Self {
        Self::binary(a, &quote!(*), b, Strength::Product)
    }

    pub fn quotient(a: &Self, b: &Self) -> Self {
        Self::binary(a, &quote!(/), b, Strength::Product)
    }

    pub fn negated(&self) -> Self {
        let Self { tokens, width, .. } = self.of_strength(Strength::Whole);
        Self { tokens: quote!(-#tokens), width: width + 1, strength: Strength::Sign }
    }

    pub fn square_root(&self) -> Self {
        let Self { tokens, width, .. } = self.of_strength(Strength::Whole);
        Self { tokens: quote!(#tokens.sqrt()), width: width + 7, strength: Strength::Whole }
    }

    /// `a b + term`
    pub fn fused(a: &Self, b: &Self, term: &Self) -> Self {
        let a = a.of_strength(Strength::Whole);
        let width = a.width + b.width + term.width + ".mul_add(, )".len();
        let (a, b, term) = (&a.tokens, &b.tokens, &term.tokens);
        Self { tokens: quote!(#a.mul_add(#b, #term)), width, strength: Strength::Whole }
    }

    /// Operations of one strength are taken from left to right.
    fn binary(a: &Self, operator: &TokenStream, b: &Self, strength: Strength) -> Self {
        let beyond = if strength == Strength::Sum { Strength::Product } else { Strength::Sign };
        let (a, b) = (a.of_strength(strength), b.of_strength(beyond));
        let width = a.width + b.width + 3;
        let (a, b) = (&a.tokens, &b.tokens);
        Self { tokens: quote!(#a #operator #b), width, strength }
    }

    /// The expression, in parentheses if it is weaker.
    fn of_strength(&self, strength: Strength) -> Self {
        if self.strength >= strength {
            return self.clone();
        }
        let tokens = &self.tokens;
        Self { tokens: quote!((#tokens)), width: self.width + 2, strength: Strength::Whole }
    }
}

/// A number. Those that are not finite, which follow from numbers of a scene that are far too large, have no
/// literal; no comparison with other code lets them pass.
pub(crate) fn number(value: f64) -> TokenStream {
    if value.is_nan() {
        return quote!(f64::NAN);
    }
    let literal = if value.is_infinite() {
        quote!(f64::INFINITY)
    } else {
        Literal::f64_unsuffixed(value.abs()).into_token_stream()
    };
    if value.is_sign_negative() { quote!(-#literal) } else { quote!(#literal) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parentheses_keep_the_order_of_operations() {
        let [a, b, c] = ["a", "b", "c"].map(Expression::named);
        let (sum, product) = (Expression::sum(&a, &b), Expression::product(&a, &b));
        for (expression, expected) in [
            (Expression::sum(&sum, &c), "a + b + c"),
            (Expression::difference(&c, &sum), "c - (a + b)"),
            (Expression::product(&product, &c), "a * b * c"),
            (Expression::product(&c, &product), "c * (a * b)"),
            (Expression::product(&sum, &c), "(a + b) * c"),
            (Expression::quotient(&c, &product), "c / (a * b)"),
            (Expression::sum(&c, &product), "c + a * b"),
            (product.negated(), "-(a * b)"),
            (Expression::product(&a.negated(), &b), "-a * b"),
            (Expression::fused(&a.negated(), &sum, &product), "(-a).mul_add(a + b, a * b)"),
            (sum.square_root(), "(a + b).sqrt()"),
            (Expression::difference(&a, &Expression::constant(-1.5)), "a - R::constant(-1.5)"),
            (Expression::constant(f64::INFINITY), "R::constant(f64::INFINITY)"),
            (Expression::constant(f64::NAN), "R::constant(f64::NAN)"),
        ] {
            let tokens: TokenStream = expected.parse().expect("Rust");
            assert_eq!(expression.tokens.to_string(), tokens.to_string());
            assert_eq!(expression.width, expected.len(), "{expected}");
        }
    }
}
