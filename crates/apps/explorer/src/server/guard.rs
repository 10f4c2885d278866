//! Access control: requests need the token, and must come from a page of this server under its own host name.

use crate::server::Error;
use std::fmt::Write;
use tungstenite::http::{HeaderMap, HeaderName, header};

/// The secret part of the address.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

impl std::fmt::Debug for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Token(..)") // not for logs
    }
}

/// Letters and digits of a given token.
const LENGTHS: std::ops::RangeInclusive<usize> = 16..=128;

impl Token {
    /// 128 random bits from the system.
    ///
    /// # Errors
    /// [`Error::Random`].
    pub fn random() -> Result<Self, Error> {
        let mut bits = [0_u8; 16];
        getrandom::fill(&mut bits).map_err(Error::Random)?;
        Ok(Self(bits.iter().fold(String::new(), |mut hex, byte| {
            let _ = write!(hex, "{byte:02x}"); // a string takes everything
            hex
        })))
    }

    /// A token that was given, of an earlier start for example.
    ///
    /// # Errors
    /// [`Error::Token`] for other characters than letters and digits, and for tokens that are too short.
    pub fn given(token: &str) -> Result<Self, Error> {
        if LENGTHS.contains(&token.len()) && token.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
            Ok(Self(token.to_owned()))
        } else {
            Err(Error::Token { token: token.to_owned() })
        }
    }

    /// The token as text of the address.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// Returns `true` if `other` is the token; takes as long for every wrong one of the same length.
    pub(crate) fn is(&self, other: &str) -> bool {
        let difference = self.0.bytes().zip(other.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
        self.0.len() == other.len() && std::hint::black_box(difference) == 0
    }
}

/// The names of a server on this port.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    port: u16,
}

impl Names {
    pub(crate) fn new(port: u16) -> Self {
        Self { port }
    }

    /// Returns `true` if a request was sent to this server under its own name: not through another name that
    /// was made to point here (DNS rebinding).
    pub(crate) fn host_is_ours(&self, headers: &HeaderMap) -> bool {
        one(headers, header::HOST).is_some_and(|host| self.hosts().contains(&host.to_owned()))
    }

    /// Returns `true` if a request comes from a page of this server: browsers always send the origin of a
    /// WebSocket.
    pub(crate) fn origin_is_ours(&self, headers: &HeaderMap) -> bool {
        let ours = self.hosts().map(|host| format!("http://{host}"));
        one(headers, header::ORIGIN).is_some_and(|origin| ours.contains(&origin.to_owned()))
    }

    fn hosts(&self) -> [String; 2] {
        ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port))
    }
}

/// The origin of a page that has none, such as one in a sandboxed frame.
pub(crate) const NO_ORIGIN: &str = "null";

/// Returns `true` if a request comes from a page without an origin.
pub(crate) fn no_origin(headers: &HeaderMap) -> bool {
    one(headers, header::ORIGIN) == Some(NO_ORIGIN)
}

/// The value of a header that must occur exactly once.
fn one(headers: &HeaderMap, name: HeaderName) -> Option<&str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?.to_str().ok()?;
    values.next().is_none().then_some(value)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn tokens_differ_and_are_compared_whole() {
        let (a, b) = (Token::random().unwrap(), Token::random().unwrap());
        assert!(a != b && a.text().len() == 32);
        assert!(a.is(a.text()) && !a.is(b.text()) && !a.is(&a.text()[1..]) && !a.is(""));
        assert!(!format!("{a:?}").contains(a.text()));
        assert!(Token::given(a.text()).unwrap() == a);
        for bad in ["", "short", "with/a/slash/in/it", "with a space in it", "../../../../etc/passwd"] {
            assert!(Token::given(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn only_our_own_names_are_ours() {
        let names = Names::new(7373);
        let with = |name: HeaderName, values: &[&str]| {
            let mut headers = HeaderMap::new();
            for value in values {
                headers.append(name.clone(), value.parse().unwrap());
            }
            headers
        };
        let host = |values: &[&str]| names.host_is_ours(&with(header::HOST, values));
        assert!(host(&["127.0.0.1:7373"]) && host(&["localhost:7373"]));
        for bad in ["127.0.0.1", "127.0.0.1:7374", "evil.example:7373", "127.0.0.1:7373.evil.example", ""] {
            assert!(!host(&[bad]), "{bad}");
        }
        assert!(!host(&[]) && !host(&["127.0.0.1:7373", "evil.example"]));
        let origin = |values: &[&str]| names.origin_is_ours(&with(header::ORIGIN, values));
        assert!(origin(&["http://127.0.0.1:7373"]) && origin(&["http://localhost:7373"]));
        for bad in ["null", "https://127.0.0.1:7373", "http://evil.example", "http://127.0.0.1:7373/", ""] {
            assert!(!origin(&[bad]), "{bad}");
        }
        assert!(!origin(&[]));
    }
}
