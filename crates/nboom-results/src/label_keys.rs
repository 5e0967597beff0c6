use nboom_model::HingeLabel;
use serde::Serialize;

/// Which hinge, in files of keys; the name is that of the body on it, of a scene that has names.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct LabelKeys {
    appendage: usize,
    segment: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
}

impl From<&HingeLabel> for LabelKeys {
    fn from(label: &HingeLabel) -> Self {
        let [appendage, segment] = label.numbers();
        Self { appendage, segment, name: label.name.as_deref().map(str::to_owned) }
    }
}
