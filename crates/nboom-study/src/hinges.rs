//! What studies call hinges: the names of their bodies, or their numbers.

use nboom_model::HingeLabel;

/// The name of a hinge's body, or its numbers as `1,2`.
pub(crate) fn name(label: &HingeLabel) -> String {
    label.name.as_deref().map_or_else(|| numbers(label), str::to_owned)
}

/// The numbers of a hinge, `1,2`.
pub(crate) fn numbers(label: &HingeLabel) -> String {
    let [appendage, segment] = label.numbers();
    format!("{appendage},{segment}")
}

/// The hinge that a text names. Names come before numbers, since a name may look like the numbers of another hinge.
pub(crate) fn find(hinges: &[HingeLabel], text: &str) -> Option<usize> {
    let named = |text: &str| hinges.iter().position(|label| label.name.as_deref() == Some(text));
    let numbered = || {
        let (appendage, segment) = text.split_once(',')?;
        let numbers: [usize; 2] = [appendage.trim().parse().ok()?, segment.trim().parse().ok()?];
        hinges.iter().position(|label| label.numbers() == numbers)
    };
    named(text).or_else(|| named(text.trim())).or_else(numbered)
}
