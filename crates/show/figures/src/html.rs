//! Labels as HTML.

use super::fonts::Face;
use super::svg::escape;
use super::text::{Label, Script};

impl Label {
    /// The label as HTML text, `<i>`, `<sub>` and `<sup>` for its markup, all else escaped.
    pub fn html(&self) -> String {
        let mut out = String::new();
        for run in self.runs() {
            let (open, close) = match run.script {
                Script::Base => ("", ""),
                Script::Sub => ("<sub>", "</sub>"),
                Script::Super => ("<sup>", "</sup>"),
            };
            let (italic, upright) = if run.face == Face::Italic { ("<i>", "</i>") } else { ("", "") };
            out.extend([open, italic, &escape(&run.text), upright, close]);
        }
        out
    }

    /// The characters alone.
    pub fn plain(&self) -> String {
        self.runs().into_iter().map(|run| run.text).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_tags_and_nothing_else_does() {
        let label = Label::parse("*x*_{*n*+1} < 10^{-3} & <b>");
        assert_eq!(
            label.html(),
            "<i>x</i><sub><i>n</i></sub><sub>+1</sub> &lt; 10<sup>\u{2212}3</sup> &amp; &lt;b&gt;"
        );
        assert_eq!(label.plain(), "xn+1 < 10\u{2212}3 & <b>");
    }
}
