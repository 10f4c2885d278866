//! The words of an equation.

use std::ops::Range;

/// A fault in a text, and its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub(super) struct TextError {
    /// Bytes of the text that it is about.
    pub span: Range<usize>,
    /// The problem, and what to write instead.
    pub problem: String,
}

impl TextError {
    pub(super) fn new(span: Range<usize>, problem: impl Into<String>) -> Self {
        Self { span, problem: problem.into() }
    }
}

/// One word.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Name(String),
    /// One of `+ - * / ^ ( ) |`.
    Sign(char),
}

impl Token {
    /// For messages.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Name(name) => name.clone(),
            Self::Sign(sign) => sign.to_string(),
        }
    }
}

/// Maximum length of an equation (bytes).
const LONGEST: usize = 10_000;

/// The words of a text, each with its place.
pub(super) fn tokens(text: &str) -> Result<Vec<(Token, Range<usize>)>, TextError> {
    if text.len() > LONGEST {
        return Err(TextError::new(
            0..text.len(),
            format!("an equation may have {LONGEST} characters, this one has {}", text.len()),
        ));
    }
    let mut tokens = Vec::new();
    let mut rest = text;
    loop {
        rest = rest.trim_start();
        let start = text.len() - rest.len();
        let Some(first) = rest.chars().next() else { return Ok(tokens) };
        let (token, length) = match first {
            '0'..='9' | '.' => number(rest, start)?,
            'a'..='z' | 'A'..='Z' | '_' => {
                let length =
                    rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
                (Token::Name(rest[..length].to_owned()), length)
            }
            '*' if rest.starts_with("**") => {
                return Err(TextError::new(start..start + 2, "a power is written ^, as in z1^2"));
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | '|' => (Token::Sign(first), 1),
            '\u{2212}' => (Token::Sign('-'), first.len_utf8()),
            '\u{b7}' | '\u{d7}' => (Token::Sign('*'), first.len_utf8()),
            '=' => {
                return Err(TextError::new(
                    start..start + 1,
                    "an equation is its right-hand side alone: z1 = \"...\" means dz1/dt = ...",
                ));
            }
            other => {
                return Err(TextError::new(
                    start..start + other.len_utf8(),
                    format!("{other:?} has no meaning here: names are ASCII, signs are + - * / ^ ( ) |"),
                ));
            }
        };
        tokens.push((token, start..start + length));
        rest = &rest[length..];
    }
}

/// A number at the beginning of `rest`: digits, a point, an exponent.
fn number(rest: &str, start: usize) -> Result<(Token, usize), TextError> {
    let bytes = rest.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length = digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let end = digits(length + 1 + sign);
        if end > length + 1 + sign {
            length = end;
        }
    }
    let value = rest[..length].parse::<f64>().ok().filter(|value| value.is_finite());
    match value {
        Some(value) => Ok((Token::Number(value), length)),
        None => Err(TextError::new(
            start..start + length,
            format!("{} is not a number: write it like 0.25 or 1e-3", &rest[..length]),
        )),
    }
}
