//! The figures of the thesis's appendix, A.1 and on, by their numbers.

/// Returns the number of the figure that a text names: `A.` and a number from 1 without a leading 0.
#[must_use]
pub fn number(text: &str) -> Option<u8> {
    let number = text.strip_prefix("A.")?;
    let plain = number.len() <= 2 && !number.starts_with(['0', '+']);
    if plain { number.parse().ok() } else { None }
}

/// Returns a short list of figures, such as `A.2-A.4, A.9`. The numbers must ascend.
#[must_use]
pub fn listed(numbers: &[u8]) -> String {
    let mut runs: Vec<(u8, u8)> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let texts = runs.into_iter().map(|(first, last)| match last - first {
        0 => format!("A.{first}"),
        1 => format!("A.{first}, A.{last}"),
        _ => format!("A.{first}-A.{last}"),
    });
    texts.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_figures_have_numbers() {
        assert_eq!((number("A.1"), number("A.11")), (Some(1), Some(11)));
        for text in ["A.0", "A.05", "A.+5", "A.", "A5", "a.5", "B.5", "A.5 ", "A.123", ".json"] {
            assert_eq!(number(text), None, "{text}");
        }
    }

    #[test]
    fn three_in_a_row_become_a_range() {
        assert_eq!(listed(&[2, 3, 4]), "A.2-A.4");
        assert_eq!(listed(&[1, 8, 9]), "A.1, A.8, A.9");
        assert_eq!(listed(&[]), "");
    }
}
