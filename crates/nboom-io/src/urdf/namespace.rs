//! For whom elements and attributes are. A robot may have a namespace; elements of another one, and attributes of
//! any, are for the program that it belongs to.

use roxmltree::{Attribute, Node};

/// Whether an element is for another program than its owner.
pub(super) fn is_foreign(part: &Node<'_, '_>) -> bool {
    part.parent().is_some_and(|owner| owner.tag_name().namespace() != part.tag_name().namespace())
}

/// Whether an element is a macro of xacro. Addresses of its namespace have changed, and xacro itself goes by the prefix.
pub(super) fn is_macro(node: Node<'_, '_>) -> bool {
    let of_xacro = |namespace: &str| {
        namespace.contains("xacro") || node.lookup_prefix(namespace) == Some("xacro")
    };
    node.is_element() && node.tag_name().namespace().is_some_and(of_xacro)
}

/// The elements in this one that are no other program's.
pub(super) fn elements<'d>(owner: Node<'d, 'd>) -> impl Iterator<Item = Node<'d, 'd>> {
    owner.children().filter(|part| part.is_element() && !is_foreign(part))
}

/// The attribute of this name that is no other program's.
pub(super) fn attribute<'d>(node: Node<'d, 'd>, name: &str) -> Option<Attribute<'d, 'd>> {
    node.attributes().find(|attribute| attribute.namespace().is_none() && attribute.name() == name)
}

/// What it says.
pub(super) fn value<'d>(node: Node<'d, 'd>, name: &str) -> Option<&'d str> {
    attribute(node, name).map(|attribute| attribute.value())
}

/// The tag of an element as it is written.
pub(super) fn tag(node: Node<'_, '_>) -> String {
    let name = node.tag_name().name();
    let prefix = node.tag_name().namespace().and_then(|namespace| node.lookup_prefix(namespace));
    prefix.map_or_else(|| name.to_owned(), |prefix| format!("{prefix}:{name}"))
}
