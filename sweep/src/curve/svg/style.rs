//! Properties of SVG elements, from their attributes and their `style`.

use roxmltree::Node;

/// Returns the value of a property of an element: of its `style`, or of the attribute.
pub(super) fn property<'a>(node: Node<'a, '_>, key: &str) -> Option<&'a str> {
    let declared = |style: &'a str| {
        let mut pairs = style.split(';').filter_map(|part| part.split_once(':'));
        pairs.rfind(|(name, _)| name.trim() == key)
    };
    let value = match node.attribute("style").and_then(declared) {
        Some((_, value)) => value,
        None => node.attribute(key)?,
    };
    Some(value.trim().trim_end_matches("!important").trim_end())
}

/// Returns whether the nonzero rule fills an element, as its `fill-rule` says, or else that of the element around it.
pub(super) fn nonzero(node: Node<'_, '_>, around: bool) -> bool {
    match property(node, "fill-rule") {
        Some("nonzero") => true,
        Some("evenodd") => false,
        // Other values are not valid, and count as left out.
        _ => around,
    }
}
