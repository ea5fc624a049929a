//! Formulas of one variable, evaluated with dual numbers, which carry an exact derivative.
//!
//! A formula has numbers, the variable `t`, the constants `pi` and `tau`, the operators `+ - * / ^` with the usual
//! precedence (`^` binds to the right and stronger than a sign), parentheses, and the functions of [`FUNCTIONS`]. Angles
//! are in radians. A formula can do nothing but compute: there are no other names, no assignments and no loops.
//!
//! Libraries of formulas were tried first: exmex has no derivative of `abs` or `atan2` and no positions in its messages,
//! and it takes half a minute of processor time to build.

mod dual;

pub use dual::Dual;

/// Longest formula in bytes; deeper nesting would take too much of the stack.
const LONGEST: usize = 1000;

/// The names of functions, with the number of their arguments.
pub const FUNCTIONS: [(&str, usize); 16] = [
    ("sin", 1),
    ("cos", 1),
    ("tan", 1),
    ("asin", 1),
    ("acos", 1),
    ("atan", 1),
    ("sinh", 1),
    ("cosh", 1),
    ("tanh", 1),
    ("exp", 1),
    ("ln", 1),
    ("sqrt", 1),
    ("abs", 1),
    ("atan2", 2),
    ("min", 2),
    ("max", 2),
];

/// A formula that has been read.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula(Node);

#[derive(Debug, Clone, PartialEq)]
enum Node {
    Number(f64),
    Variable,
    Negative(Box<Node>),
    Binary(u8, Box<[Node; 2]>),
    /// A function, by its index in [`FUNCTIONS`].
    Call(usize, Vec<Node>),
}

impl Formula {
    /// Reads a formula.
    ///
    /// # Errors
    /// The message says what was found, at which character, and what was expected.
    pub fn new(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST {
            return Err(format!("found {} bytes, expected at most {LONGEST}", text.len()));
        }
        let mut reader = Reader { text, at: 0 };
        let node = reader.sum()?;
        reader.skip();
        if reader.at < text.len() {
            return Err(reader.expected("an operator or the end"));
        }
        Ok(Self(node))
    }

    /// Returns the value and the derivative at `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> Dual {
        self.0.at(Dual { value: t, slope: 1.0 })
    }
}

impl Node {
    fn at(&self, t: Dual) -> Dual {
        match self {
            Self::Number(value) => Dual::constant(*value),
            Self::Variable => t,
            Self::Negative(node) => -node.at(t),
            Self::Binary(operator, nodes) => {
                let [a, b] = [nodes[0].at(t), nodes[1].at(t)];
                match operator {
                    b'+' => a + b,
                    b'-' => a - b,
                    b'*' => a * b,
                    b'/' => a / b,
                    _ => a.power(b),
                }
            }
            Self::Call(function, arguments) => {
                let a = arguments[0].at(t);
                match FUNCTIONS[*function].0 {
                    "sin" => a.sin(),
                    "cos" => a.cos(),
                    "tan" => a.sin() / a.cos(),
                    "asin" => a.asin(),
                    "acos" => Dual::constant(std::f64::consts::FRAC_PI_2) - a.asin(),
                    "atan" => a.atan2(Dual::constant(1.0)),
                    "sinh" => (a.exp() - (-a).exp()) * Dual::constant(0.5),
                    "cosh" => (a.exp() + (-a).exp()) * Dual::constant(0.5),
                    "tanh" => a.tanh(),
                    "exp" => a.exp(),
                    "ln" => a.ln(),
                    "sqrt" => a.sqrt(),
                    "abs" => {
                        if a.value < 0.0 {
                            -a
                        } else {
                            a
                        }
                    }
                    name => {
                        let b = arguments[1].at(t);
                        match name {
                            "atan2" => a.atan2(b),
                            "min" => {
                                if b.value < a.value {
                                    b
                                } else {
                                    a
                                }
                            }
                            _ => {
                                if b.value > a.value {
                                    b
                                } else {
                                    a
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn skip(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn next_is(&mut self, all: &[u8]) -> Option<u8> {
        self.skip();
        let found = self.text.as_bytes().get(self.at).copied().filter(|byte| all.contains(byte))?;
        self.at += 1;
        Some(found)
    }

    fn sum(&mut self) -> Result<Node, String> {
        let mut node = self.product()?;
        while let Some(operator) = self.next_is(b"+-") {
            node = Node::Binary(operator, Box::new([node, self.product()?]));
        }
        Ok(node)
    }

    fn product(&mut self) -> Result<Node, String> {
        let mut node = self.signed()?;
        while let Some(operator) = self.next_is(b"*/") {
            node = Node::Binary(operator, Box::new([node, self.signed()?]));
        }
        Ok(node)
    }

    fn signed(&mut self) -> Result<Node, String> {
        match self.next_is(b"+-") {
            Some(b'-') => Ok(Node::Negative(Box::new(self.signed()?))),
            Some(_) => self.signed(),
            None => self.power(),
        }
    }

    fn power(&mut self) -> Result<Node, String> {
        let base = self.atom()?;
        match self.next_is(b"^") {
            Some(operator) => Ok(Node::Binary(operator, Box::new([base, self.signed()?]))),
            None => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Node, String> {
        if self.next_is(b"(").is_some() {
            let node = self.sum()?;
            return self.next_is(b")").map(|_| node).ok_or_else(|| self.expected("`)`"));
        }
        self.skip();
        let rest = &self.text[self.at..];
        let length = |fits: fn(char) -> bool| rest.find(|c| !fits(c)).unwrap_or(rest.len());
        if rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            let mut end = length(|c| c.is_ascii_digit() || c == '.');
            let exponent = rest[end..].strip_prefix(['e', 'E']).map(|rest| {
                let sign = usize::from(rest.starts_with(['+', '-']));
                let digits =
                    rest[sign..].find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len() - sign);
                (digits > 0).then_some(1 + sign + digits)
            });
            end += exponent.flatten().unwrap_or(0);
            let number = rest[..end].parse().map_err(|_| self.expected("a number"))?;
            self.at += end;
            return Ok(Node::Number(number));
        }
        let end = length(|c| c.is_alphanumeric() || c == '_');
        let node = match &rest[..end] {
            "t" => Node::Variable,
            "pi" | "π" => Node::Number(std::f64::consts::PI),
            "tau" | "τ" => Node::Number(std::f64::consts::TAU),
            "" => return Err(self.expected("a number, `t`, a function or `(`")),
            name => {
                let Some(function) = FUNCTIONS.iter().position(|(known, _)| *known == name) else {
                    let known: Vec<&str> = FUNCTIONS.iter().map(|function| function.0).collect();
                    let expected = format!("`t`, `pi`, `tau` or one of {}", known.join(", "));
                    let position = 1 + self.text[..self.at].chars().count();
                    return Err(format!(
                        "found `{name}` at character {position}, expected {expected}"
                    ));
                };
                self.at += end;
                return self.call(function);
            }
        };
        self.at += end;
        Ok(node)
    }

    fn call(&mut self, function: usize) -> Result<Node, String> {
        let (name, count) = FUNCTIONS[function];
        self.next_is(b"(").ok_or_else(|| self.expected(&format!("`(` after `{name}`")))?;
        let mut arguments = vec![self.sum()?];
        while arguments.len() < count {
            self.next_is(b",")
                .ok_or_else(|| self.expected(&format!("`,`: `{name}` has two arguments")))?;
            arguments.push(self.sum()?);
        }
        self.next_is(b")").ok_or_else(|| self.expected("`)`"))?;
        Ok(Node::Call(function, arguments))
    }

    fn expected(&mut self, what: &str) -> String {
        self.skip();
        let position = 1 + self.text[..self.at].chars().count();
        match self.text[self.at..].chars().next() {
            Some(found) => format!("found `{found}` at character {position}, expected {what}"),
            None => format!("found the end at character {position}, expected {what}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_arithmetic_and_slopes_those_of_differences() {
        for (text, value) in [
            ("1+2*3-4/8", 6.5),
            ("-2^2", -4.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("(1+t)*(1-t)", 0.75),
            ("cos(pi)+sin(tau/4)", 0.0),
            ("atan2(1,1)*4/pi", 1.0),
            ("min(3,t)+max(3,t)", 3.5),
            ("1.5e1 - 1E-1", 14.9),
            ("exp(ln(t))+sqrt(t^2)+abs(-t)", 1.5),
            ("tan(t)-sin(t)/cos(t)+asin(t)+acos(t)", std::f64::consts::FRAC_PI_2),
            ("sinh(t)+cosh(t)-exp(t)+tanh(t)-sinh(t)/cosh(t)+atan(t)-atan2(t,1)", 0.0),
            ("(2+cos(3*t))*sin(2*t)", (2.0 + 1.5_f64.cos()) * 1_f64.sin()),
            ("t^t + 3^t + t^3", 0.5_f64.sqrt() + 3_f64.sqrt() + 0.125),
        ] {
            let formula = Formula::new(text).unwrap();
            let Dual { value: found, slope } = formula.at(0.5);
            assert!((found - value).abs() < 1e-14, "{text}: {found}");
            let h = 1e-6;
            let difference = (formula.at(0.5 + h).value - formula.at(0.5 - h).value) / (2.0 * h);
            // The error of a central difference is h^2, and its rounding 1e-16 / h.
            assert!((slope - difference).abs() < 1e-8, "{text}: {slope} {difference}");
        }
    }

    #[test]
    fn faults_are_named_with_their_position() {
        for (text, message) in [
            ("", "found the end at character 1, expected a number, `t`, a function or `(`"),
            ("2 pi", "found `p` at character 3, expected an operator or the end"),
            ("(t", "found the end at character 3, expected `)`"),
            ("foo(t)", "found `foo` at character 1, expected `t`, `pi`, `tau` or one of sin,"),
            ("sin t", "found `t` at character 5, expected `(` after `sin`"),
            ("atan2(t)", "found `)` at character 8, expected `,`: `atan2` has two arguments"),
            ("1..2", "found `1` at character 1, expected a number"),
        ] {
            let found = Formula::new(text).unwrap_err();
            assert!(found.starts_with(message), "{text}: {found}");
        }
        assert!(Formula::new(&"(".repeat(5000)).is_err());
    }
}
