//! The text of an equation, read as a polynomial in the amplitudes.
//!
//! ```text
//! sum     = [+ -] product { (+ | -) product }
//! product = power { (* | /) power }
//! power   = atom [ ^ exponent ]
//! atom    = number | i | pi | parameter | z1, z2, .. | function(sum) | (sum) | |z1|
//! ```
//!
//! Functions of any sum are `conj`, `re(z) = (z + conj(z))/2` and `im(z) = (z - conj(z))/(2i)`. A parameter may be called `re` or `im`:
//! then the function has no name.

use super::coefficient::{Function, Kind, Tape};
use super::polynomial::{MOST_ORDER, MOST_TERMS, Monomial, Polynomial, Refusal};
use super::tokens::{TextError, Token, tokens};
use crate::error::nearest;
use std::ops::Range;

/// Names that no parameter can have, because they mean something else.
pub const RESERVED: [&str; 7] = ["i", "pi", "conj", "sqrt", "sin", "cos", "exp"];

/// Names of the imaginary unit, ours and those of other languages.
const IMAGINARY_UNITS: [&str; 4] = ["i", "j", "I", "J"];

/// Maximum depth of parentheses.
const DEEPEST: usize = 64;

/// Largest exponent of a coefficient.
const LARGEST_EXPONENT: i32 = 64;

/// The names with a meaning in an equation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names<'n> {
    /// The angular index of each amplitude: `z2` has 2.
    pub(super) modes: &'n [u32],
    /// The parameters.
    pub(super) parameters: &'n [String],
}

/// Reads one equation; its coefficients are appended to `tape`.
pub(super) fn parse(text: &str, names: Names<'_>, tape: &mut Tape) -> Result<Polynomial, TextError> {
    let tokens = tokens(text)?;
    let mut parser = Parser { tokens: &tokens, next: 0, end: text.len(), depth: 0, names, tape };
    let polynomial = parser.sum()?;
    match parser.peek() {
        None => Ok(polynomial),
        Some(Token::Sign(')')) => Err(parser.wrong("this parenthesis closes none")),
        Some(Token::Name(name)) if IMAGINARY_UNITS.contains(&name.as_str()) => {
            Err(parser.wrong("the imaginary unit is i, and products are written with *: 2*i"))
        }
        Some(token) => {
            let found = token.text();
            Err(parser.wrong(&format!("expected an operator before {found}: products are written with *")))
        }
    }
}

struct Parser<'p> {
    tokens: &'p [(Token, Range<usize>)],
    next: usize,
    end: usize,
    depth: usize,
    names: Names<'p>,
    tape: &'p mut Tape,
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(token, _)| token)
    }

    fn sign(&mut self, signs: &[char]) -> Option<char> {
        let Some(&Token::Sign(found)) = self.peek() else { return None };
        signs.contains(&found).then(|| {
            self.next += 1;
            found
        })
    }

    /// The span of the next word, or the end of the text.
    fn here(&self) -> Range<usize> {
        self.tokens.get(self.next).map_or(self.end..self.end, |(_, span)| span.clone())
    }

    /// From the start of word `first` to the end of the last word that was read.
    fn since(&self, first: usize) -> Range<usize> {
        let start = self.tokens.get(first).map_or(self.end, |(_, span)| span.start);
        let end = self.tokens[..self.next].last().map_or(start, |(_, span)| span.end);
        start..end.max(start)
    }

    fn wrong(&self, problem: &str) -> TextError {
        TextError::new(self.here(), problem)
    }

    fn refused(&self, first: usize, refusal: Refusal) -> TextError {
        let problem = match refusal {
            Refusal::Order => format!("terms of order above {MOST_ORDER} are not supported"),
            Refusal::Terms => {
                format!("this has more than {MOST_TERMS} terms, or coefficients that are too long")
            }
        };
        TextError::new(self.since(first), problem)
    }

    fn sum(&mut self) -> Result<Polynomial, TextError> {
        let first = self.next;
        let mut sum = match self.sign(&['+', '-']) {
            Some('-') => {
                let product = self.product()?;
                product.map(|place| self.tape.negate(place))
            }
            _ => self.product()?,
        };
        while let Some(sign) = self.sign(&['+', '-']) {
            let product = self.product()?;
            sum =
                sum.add(&product, sign == '-', self.tape).map_err(|refusal| self.refused(first, refusal))?;
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Polynomial, TextError> {
        let first = self.next;
        let mut product = self.power()?;
        while let Some(sign) = self.sign(&['*', '/']) {
            let second = self.next;
            let factor = self.power()?;
            if sign == '*' {
                product =
                    product.multiply(&factor, self.tape).map_err(|refusal| self.refused(first, refusal))?;
                continue;
            }
            let Some(divisor) = factor.as_constant() else {
                return Err(TextError::new(
                    self.since(second),
                    "a divisor may contain parameters but no amplitude: equations are polynomials in z",
                ));
            };
            product = product.map(|place| self.tape.divide(place, divisor));
        }
        Ok(product)
    }

    fn power(&mut self) -> Result<Polynomial, TextError> {
        let first = self.next;
        if self.sign(&['|']).is_some() {
            return self.modulus(first);
        }
        let base = self.atom()?;
        if self.sign(&['^']).is_none() {
            return Ok(base);
        }
        let place = self.next;
        let negative = self.sign(&['-']).is_some();
        let exponent = self.atom()?;
        if self.peek() == Some(&Token::Sign('^')) {
            return Err(self.wrong("a power of a power needs parentheses"));
        }
        self.raise(&base, &exponent, negative, (first, place))
    }

    fn raise(
        &mut self,
        base: &Polynomial,
        exponent: &Polynomial,
        negative: bool,
        (first, place): (usize, usize),
    ) -> Result<Polynomial, TextError> {
        let Some(exponent) = exponent.as_constant() else {
            return Err(TextError::new(self.since(place), "an exponent contains no amplitude"));
        };
        let written = self.tape.number(exponent).map(|number| if negative { -number } else { number });
        let whole = written.filter(|x| x.fract() == 0.0 && x.abs() <= f64::from(LARGEST_EXPONENT));
        match (base.as_constant(), whole) {
            (Some(base), Some(whole)) => Ok(Polynomial::constant(self.tape.whole_power(base, whole as i32))),
            (Some(base), None) => {
                let exponent = if negative { self.tape.negate(exponent) } else { exponent };
                let power = self.tape.power(base, exponent);
                let problem = "only real numbers have powers that are not whole (up to 64)";
                power.map(Polynomial::constant).ok_or_else(|| TextError::new(self.since(first), problem))
            }
            (None, Some(whole)) if whole >= 0.0 => {
                let one = self.tape.real(1.0);
                let mut power = Polynomial::constant(one);
                for _ in 0..whole as u32 {
                    power =
                        power.multiply(base, self.tape).map_err(|refusal| self.refused(first, refusal))?;
                }
                Ok(power)
            }
            (None, _) => Err(TextError::new(
                self.since(place),
                "powers of amplitudes are whole numbers of at least 0, like z1^2",
            )),
        }
    }

    /// `|z1|^2` after its first bar.
    fn modulus(&mut self, first: usize) -> Result<Polynomial, TextError> {
        let amplitude = match self.peek() {
            Some(Token::Name(name)) if self.amplitude(name).is_some() => {
                let amplitude = self.amplitude(name);
                self.next += 1;
                amplitude
            }
            _ => None,
        };
        let Some(number) = amplitude else {
            return Err(self.wrong("between bars stands one amplitude, like |z1|^2"));
        };
        if self.sign(&['|']).is_none() {
            return Err(self.wrong("expected | after the amplitude, like |z1|^2"));
        }
        let exponent = match (self.sign(&['^']), self.peek()) {
            (Some(_), Some(&Token::Number(exponent))) => {
                self.next += 1;
                exponent
            }
            _ => f64::NAN,
        };
        if exponent % 2.0 != 0.0 || !(0.0..=64.0).contains(&exponent) {
            let problem = "a modulus has an even power, like |z1|^2: odd powers are no polynomials";
            return Err(TextError::new(self.since(first), problem));
        }
        if exponent > f64::from(MOST_ORDER) {
            return Err(self.refused(first, Refusal::Order));
        }
        let mut monomial = Monomial::default();
        monomial.0[number] = [exponent as u8 / 2; 2];
        Ok(Polynomial::term(monomial, self.tape.real(1.0)))
    }

    fn atom(&mut self) -> Result<Polynomial, TextError> {
        let here = self.here();
        let Some((token, _)) = self.tokens.get(self.next) else {
            return Err(self.wrong("the equation ends here: expected a number, a name or a parenthesis"));
        };
        match token {
            &Token::Number(number) => {
                self.next += 1;
                Ok(Polynomial::constant(self.tape.real(number)))
            }
            Token::Name(name) => {
                self.next += 1;
                self.named(name, here)
            }
            Token::Sign('(') => {
                self.next += 1;
                self.parenthesis()
            }
            token => {
                let found = token.text();
                Err(self.wrong(&format!("expected a number, a name or a parenthesis, not {found}")))
            }
        }
    }

    /// Reads the contents of a parenthesis that is open.
    fn parenthesis(&mut self) -> Result<Polynomial, TextError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong(&format!("more than {DEEPEST} parentheses in one another")));
        }
        let inside = self.sum()?;
        self.depth -= 1;
        match self.sign(&[')']) {
            Some(_) => Ok(inside),
            None => Err(self.wrong("expected ) or an operator")),
        }
    }

    fn amplitude(&self, name: &str) -> Option<usize> {
        let index: u32 = name.strip_prefix('z')?.parse().ok()?;
        self.names.modes.iter().position(|&n| n == index)
    }

    fn named(&mut self, name: &str, span: Range<usize>) -> Result<Polynomial, TextError> {
        if let Some(number) = self.amplitude(name) {
            return Ok(Polynomial::term(Monomial::amplitude(number), self.tape.real(1.0)));
        }
        if let Some(parameter) = self.names.parameters.iter().position(|known| known == name) {
            return Ok(Polynomial::constant(self.tape.parameter(parameter)));
        }
        match name {
            "i" => Ok(Polynomial::constant(self.tape.imaginary_unit())),
            "pi" => Ok(Polynomial::constant(self.tape.real(std::f64::consts::PI))),
            "conj" => {
                let inside = self.argument(name)?;
                Ok(inside.conj(self.tape))
            }
            "re" | "im" => {
                let first = self.next;
                let inside = self.argument(name)?;
                self.part(inside, name == "im").map_err(|refusal| self.refused(first, refusal))
            }
            _ => match Function::ALL.iter().find(|(known, _)| *known == name) {
                Some(&(_, function)) => self.function(name, function, span),
                None => Err(TextError::new(span, self.unknown(name))),
            },
        }
    }

    /// The real or the imaginary part.
    fn part(&mut self, whole: Polynomial, imaginary: bool) -> Result<Polynomial, Refusal> {
        let conjugate = whole.clone().conj(self.tape);
        let sum = whole.add(&conjugate, imaginary, self.tape)?;
        let half = self.tape.real(0.5);
        let factor = if imaginary {
            let unit = self.tape.imaginary_unit();
            let negative = self.tape.negate(unit);
            self.tape.multiply(negative, half)
        } else {
            half
        };
        Ok(sum.map(|place| self.tape.multiply(place, factor)))
    }

    fn argument(&mut self, name: &str) -> Result<Polynomial, TextError> {
        match self.sign(&['(']) {
            Some(_) => self.parenthesis(),
            None => Err(self.wrong(&format!("expected ( after {name}"))),
        }
    }

    fn function(
        &mut self,
        name: &str,
        function: Function,
        span: Range<usize>,
    ) -> Result<Polynomial, TextError> {
        let first = self.next;
        let inside = self.argument(name)?;
        let Some(argument) = inside.as_constant() else {
            let problem =
                format!("{name} takes parameters and numbers, no amplitude: equations are polynomials in z");
            return Err(TextError::new(self.since(first), problem));
        };
        match self.tape.apply(function, argument) {
            Some(place) => Ok(Polynomial::constant(place)),
            None => Err(TextError::new(span, format!("{name} takes a real number"))),
        }
    }

    /// A suggestion of what an unknown name was meant to be.
    fn unknown(&self, name: &str) -> String {
        let modes = self.names.modes;
        if let Some(index) = name.strip_prefix('z').filter(|rest| rest.parse::<u32>().is_ok()) {
            let known: Vec<String> = modes.iter().map(|n| format!("z{n}")).collect();
            let known = known.join(", ");
            return format!("there is no amplitude z{index}: modes gives {known}");
        }
        if IMAGINARY_UNITS.contains(&name) {
            return format!("unknown name {name}: the imaginary unit is i");
        }
        let names = self.names.parameters.iter().map(String::as_str);
        let known: Vec<&str> = names.chain(RESERVED).chain(["re", "im"]).collect();
        match nearest(name, known.iter().copied()) {
            Some(found) => format!("unknown name {name} (did you mean {found}?)"),
            None => format!("unknown name {name}: give it a value in [model.amplitudes.parameters]"),
        }
    }
}

/// Returns `true` if all coefficients of a polynomial are real for all values of the parameters.
pub(super) fn is_real(polynomial: &Polynomial, tape: &Tape) -> bool {
    polynomial.0.values().all(|&place| tape.kind(place) == Kind::Real)
}
