//! A sentence of a report, and the question that it answers.

/// Two errors count as equal if the larger is at most this times the smaller.
///
/// The noise of the truth changes an error of five times its size by 2 % at most.
pub const AS_NEAR: f64 = 1.05;

/// The question that a sentence answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Question {
    /// The choice of a method.
    Use,
    /// The gain of areas over the thesis's lattice, and their cost.
    Areas,
    /// The cost of the thesis's method, and its value.
    Cost,
    /// The failures of filters.
    Fails,
    /// The doubtful numbers.
    Doubt,
}

/// A sentence of a report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sentence {
    /// The question that the sentence answers.
    pub question: Question,
    /// The name of the page that the sentence is about; `None` for all pages.
    pub page: Option<String>,
    /// The text.
    pub text: String,
}

impl Sentence {
    /// Returns a sentence about all pages.
    #[must_use]
    pub fn general(question: Question, text: String) -> Self {
        Self { question, page: None, text }
    }
}
