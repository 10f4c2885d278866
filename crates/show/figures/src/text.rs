//! Labels: a line of text with italic symbols, subscripts and superscripts.
//!
//! Markup: `*x*` italic; `_2` or `_{max}` subscript; `^2` or `^{-1}` superscript; a backslash takes the next
//! character literally. A hyphen before a digit becomes a true minus, unless it follows a letter or digit on the line.

use super::fonts::{self, Face};

/// The vertical position of a character on the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Script {
    /// On the line.
    Base,
    /// Lowered and smaller.
    Sub,
    /// Raised and smaller.
    Super,
}

impl Script {
    /// Font size relative to the line's: on paper no index is smaller than 7 pt.
    pub(crate) fn scale(self) -> f64 {
        if self == Self::Base { 1.0 } else { 0.82 }
    }

    /// Baseline, in font sizes below the line's.
    pub(crate) fn drop(self) -> f64 {
        match self {
            Self::Base => 0.0,
            Self::Sub => 0.22,
            Self::Super => -0.42,
        }
    }
}

/// A character and how it is set.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Set {
    character: char,
    face: Face,
    script: Script,
}

impl Set {
    /// Width in font sizes of the line.
    fn width(self) -> f64 {
        fonts::advance(self.face, self.character) * self.script.scale()
    }

    fn is_break(self) -> bool {
        self.character == ' ' && self.script == Script::Base
    }
}

/// A run of characters set alike.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// The characters.
    pub(crate) text: String,
    /// Upright or italic.
    pub(crate) face: Face,
    /// Height on the line.
    pub(crate) script: Script,
}

/// One line of rich text: `*x*` italic (digits of an index upright), `_2` or `_{max}` subscript, `^2` or `^{-1}` superscript, backslash
/// literal.
///
/// A hyphen before a digit becomes a true minus, unless it follows a letter or digit on the line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Label(Vec<Set>);

/// Returns `true` for the digits of an index or a power: they are upright, also of an italic symbol.
fn is_number(c: char, script: Script) -> bool {
    script != Script::Base && c.is_ascii_digit()
}

/// `text` with its markup characters taken literally: for file names and identifiers.
pub fn literal(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '*' | '_' | '^' | '\\') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Letters of formulas in sentences of results.
const SPELLED: [(&str, &str); 6] =
    [("lambda", "*λ*"), ("tau", "*τ*"), ("gamma", "*γ*"), ("k", "*k*"), ("p", "*p*"), ("pc", "*p*_c")];

/// A sentence of results, as terminals show it, as markup: `lambda_1 = 2.2e-4 +- 3.2e-4` has its letter, its powers of ten and its sign,
/// and a difference its minus.
pub fn sentence(text: &str) -> String {
    let mut out = powers(&literal(text))
        .replace("+-", "±")
        .replace("lambda\\_", "lambda_")
        .replace("\\^-gamma", "^{−gamma}")
        .replace("(-", "(−")
        .replace(" - ", " − ");
    for (word, letter) in SPELLED {
        let mut rest = std::mem::take(&mut out);
        while let Some(at) = rest.find(word) {
            let after = rest.split_off(at + word.len());
            let within = rest[..at].ends_with(|c: char| c.is_alphanumeric())
                || after.starts_with(|c: char| c.is_alphanumeric());
            if !within {
                rest.replace_range(at.., letter);
            }
            out += &rest;
            rest = after;
        }
        out += &rest;
    }
    out
}

/// The text with powers of ten where it has `1.5e-7`.
pub(crate) fn powers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut characters = text.char_indices().peekable();
    while let Some((at, c)) = characters.next() {
        let digit_before = text[..at].ends_with(|c: char| c.is_ascii_digit());
        let power = &text[at + c.len_utf8()..];
        let sign = usize::from(power.starts_with('-'));
        let length = sign + power[sign..].bytes().take_while(u8::is_ascii_digit).count();
        let ends = !power[length..].starts_with(|c: char| c.is_alphanumeric());
        if c == 'e' && digit_before && length > sign && ends {
            out += &format!("×10^{{{}}}", &power[..length]);
            characters.nth(length - 1);
        } else {
            out.push(c);
        }
    }
    out
}

impl Label {
    /// Reads the markup. Never fails: a mark without partner is dropped, control characters become spaces.
    pub fn parse(markup: &str) -> Self {
        let mut out = Vec::new();
        let (mut face, mut script, mut braced) = (Face::Regular, Script::Base, false);
        let mut characters = markup.chars().peekable();
        while let Some(mut c) = characters.next() {
            match c {
                '*' => {
                    face = if face == Face::Regular { Face::Italic } else { Face::Regular };
                    continue;
                }
                '_' | '^' if script == Script::Base => {
                    script = if c == '_' { Script::Sub } else { Script::Super };
                    braced = characters.next_if_eq(&'{').is_some();
                    continue;
                }
                '}' if braced => {
                    (script, braced) = (Script::Base, false);
                    continue;
                }
                '\\' => c = characters.next().unwrap_or('\\'),
                '-' if is_minus(&out, script, characters.peek()) => c = '\u{2212}',
                _ => {}
            }
            let face = if is_number(c, script) { Face::Regular } else { face };
            out.push(Set { character: if c.is_control() { ' ' } else { c }, face, script });
            if !braced {
                script = Script::Base;
            }
        }
        Self(out)
    }

    /// The text for a terminal: subscripts as `z_1` or `x_{n+1}`, superscripts as `10^-3`, no italics.
    pub fn terminal(&self) -> String {
        let mut groups: Vec<(Script, String)> = Vec::new();
        for run in self.runs() {
            match groups.last_mut() {
                Some((script, text)) if *script == run.script => text.push_str(&run.text),
                _ => groups.push((run.script, run.text)),
            }
        }
        let shown = |(script, text): &(Script, String)| {
            let mark = match script {
                Script::Base => return text.clone(),
                Script::Sub => '_',
                Script::Super => '^',
            };
            let text = text.replace('\u{2212}', "-");
            let number = text.trim_start_matches('-').chars().all(|c| c.is_ascii_digit());
            if number || text.chars().count() == 1 {
                format!("{mark}{text}")
            } else {
                format!("{mark}{{{text}}}")
            }
        };
        groups.iter().map(shown).collect()
    }

    /// Width in pixels at a font size in pixels.
    pub fn width(&self, size: f64) -> f64 {
        size * self.0.iter().map(|s| s.width()).sum::<f64>()
    }

    /// Returns `true` if there is no character.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Breaks at spaces into lines of at most `width` pixels, and a longer word at any of its characters.
    pub fn wrap(&self, size: f64, width: f64) -> Vec<Self> {
        self.lines(size, width, width)
    }

    /// Breaks at spaces into lines of at most `width` pixels, and no word: a unit stays whole.
    pub fn wrap_words(&self, size: f64, width: f64) -> Vec<Self> {
        self.lines(size, width, f64::INFINITY)
    }

    /// The lines of at most `width` pixels, of words in pieces of at most `piece` pixels.
    fn lines(&self, size: f64, width: f64, piece: f64) -> Vec<Self> {
        let mut lines: Vec<Vec<Set>> = Vec::new();
        let words = self.0.split(|s| s.is_break()).filter(|word| !word.is_empty());
        for (word, is_rest) in words.flat_map(|word| pieces(word, piece / size)) {
            let space = Set { character: ' ', face: Face::Regular, script: Script::Base };
            let long = |line: &[Set]| {
                let em: f64 = line.iter().chain([&space]).chain(word).map(|s| s.width()).sum();
                em * size > width
            };
            match lines.last_mut() {
                Some(line) if !is_rest && !long(line) => {
                    line.push(space);
                    line.extend_from_slice(word);
                }
                _ => lines.push(word.to_vec()),
            }
        }
        lines.into_iter().map(Self).collect()
    }

    /// The text as runs of equal setting.
    pub(crate) fn runs(&self) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for set in &self.0 {
            match runs.last_mut() {
                Some(run) if run.face == set.face && run.script == set.script => run.text.push(set.character),
                _ => runs.push(Run { text: set.character.into(), face: set.face, script: set.script }),
            }
        }
        runs
    }
}

/// A word in pieces of at most so many times the font size, one character at least; and `true` for all but the first.
fn pieces(word: &[Set], width: f64) -> Vec<(&[Set], bool)> {
    let mut found = Vec::new();
    let mut begin = 0;
    let mut room = width;
    for (place, set) in word.iter().enumerate() {
        if set.width() > room && place > begin {
            found.push((&word[begin..place], begin > 0));
            (begin, room) = (place, width);
        }
        room -= set.width();
    }
    found.push((&word[begin..], begin > 0));
    found
}

/// Returns `true` if a hyphen after `before` is a minus sign: in "x = -2" and in any script, but not in
/// "1e-3" or "7-12".
fn is_minus(before: &[Set], script: Script, next: Option<&char>) -> bool {
    let free = script != Script::Base || before.last().is_none_or(|s| !s.character.is_alphanumeric());
    free && next.is_some_and(|c| c.is_ascii_digit() || *c == '.')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(markup: &str) -> String {
        Label::parse(markup).runs().into_iter().map(|r| r.text).collect()
    }

    #[test]
    fn a_terminal_keeps_exponents_and_indices() {
        let shown = Label::parse("*x*_{*n*+1} = 10^{-3} *z*_1^2, -0.9").terminal();
        assert_eq!(shown, "x_{n+1} = 10^-3 z_1^2, \u{2212}0.9");
    }

    /// The label of the speed on a low panel of a slide: its unit was broken within the bracket.
    #[test]
    fn units_stay_whole() {
        let label = Label::parse("speed (µm/min)");
        let plain = |lines: Vec<Label>| lines.iter().map(Label::terminal).collect::<Vec<_>>();
        assert_eq!(plain(label.wrap_words(13.0, 30.0)), ["speed", "(µm/min)"]);
        assert!(plain(label.wrap(13.0, 30.0)).len() > 2);
    }

    #[test]
    fn markup_becomes_runs() {
        let runs = Label::parse("*κ*_2 = -0.9, *x*_{*n*+1}^2").runs();
        let seen: Vec<_> = runs.iter().map(|r| (r.text.as_str(), r.face, r.script)).collect();
        use Face::{Italic, Regular};
        use Script::{Base, Sub, Super};
        assert_eq!(
            seen,
            [
                ("κ", Italic, Base),
                ("2", Regular, Sub),
                (" = \u{2212}0.9, ", Regular, Base),
                ("x", Italic, Base),
                ("n", Italic, Sub),
                ("+1", Regular, Sub),
                ("2", Regular, Super),
            ]
        );
    }

    #[test]
    fn hyphens_stay_where_they_are_no_minus() {
        assert_eq!(plain("1e-3, 7-12, 2026-11-21, a-b"), "1e-3, 7-12, 2026-11-21, a-b");
        assert_eq!(plain("10^{-3} (-2) -.5"), "10\u{2212}3 (\u{2212}2) \u{2212}.5");
    }

    #[test]
    fn sentences_of_results_are_typeset() {
        let text = "lambda_1 = -2.2e-4 +- 3.2e-4, tau = 1.075e5 (pc - p)^-gamma, exp(-k p), a constant, file_1e-b.toml";
        assert_eq!(
            Label::parse(&sentence(text)).terminal(),
            "λ_1 = −2.2×10^-4 ± 3.2×10^-4, τ = 1.075×10^5 (p_c − p)^{-γ}, exp(−k p), a constant, file_1e-b.toml"
        );
    }

    #[test]
    fn literal_text_survives() {
        assert_eq!(plain(&literal("run_2*a^b\\c.toml")), "run_2*a^b\\c.toml");
    }

    #[test]
    fn a_word_that_is_longer_than_a_line_is_broken() {
        let label = Label::parse(&"supercalifragilistic".repeat(8));
        let lines = label.wrap(12.0, 90.0);
        assert!(lines.len() > 8 && lines.iter().all(|l| l.width(12.0) <= 90.0 && !l.is_empty()));
        assert_eq!(lines.iter().map(|l| l.0.len()).sum::<usize>(), label.0.len());
        assert_eq!(label.wrap(12.0, 1.0).len(), label.0.len());
    }

    #[test]
    fn wrapped_lines_fit_and_lose_no_word() {
        let label = Label::parse("one two three four five six seven eight nine ten");
        let lines = label.wrap(12.0, 90.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| l.width(12.0) <= 90.0));
        assert_eq!(lines.iter().map(|l| l.0.len() + 1).sum::<usize>(), label.0.len() + 1);
    }
}
