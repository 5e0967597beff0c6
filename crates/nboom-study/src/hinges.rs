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
