//! The token that tells viewers from strangers.

use sha1::{Digest, Sha1};

use crate::ServerError;

/// Random bytes of a generated token.
const RANDOM_BYTES: usize = 16;

/// Lengths of a token.
const LENGTHS: std::ops::RangeInclusive<usize> = 12..=128;

/// A secret text of an address.
#[derive(Clone)]
pub(crate) struct Token(String);

impl Token {
    /// Takes a token over.
    ///
    /// # Errors
    /// It is too short, too long, or has characters that an address would change.
    pub fn new(text: String) -> Result<Self, ServerError> {
        let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_';
        if !LENGTHS.contains(&text.len()) || !text.bytes().all(is_plain) {
            let length = text.chars().count();
            return Err(ServerError::Token { length });
        }
        Ok(Self(text))
    }

    /// A token that nobody guesses.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub fn random() -> Result<Self, ServerError> {
        let mut bytes = [0; RANDOM_BYTES];
        getrandom::fill(&mut bytes).map_err(|error| ServerError::Random(error.to_string()))?;
        Ok(Self(
            bytes.iter().map(|byte| format!("{byte:02x}")).collect(),
        ))
    }

    pub fn text(&self) -> &str {
        &self.0
    }

    /// True if a viewer gave this token. The time that this takes says nothing about how much of it was right.
    pub fn is(&self, given: &str) -> bool {
        // Digests have the same length and share no prefix.
        let [ours, theirs] = [&*self.0, given].map(|text| Sha1::digest(text.as_bytes()));
        let pairs = ours.iter().zip(theirs.iter());
        std::hint::black_box(pairs.fold(0, |all, (a, b)| all | (a ^ b))) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::Token;

    #[test]
    fn only_the_whole_token_is_the_token() {
        let token = Token::new("abcdefghijkl".into()).unwrap();
        assert!(token.is("abcdefghijkl"));
        for wrong in ["", "abcdefghijk", "abcdefghijklm", "Abcdefghijkl"] {
            assert!(!token.is(wrong), "{wrong}");
        }
    }

    #[test]
    fn random_tokens_differ_and_stand_in_an_address() {
        let [one, other] = [Token::random().unwrap(), Token::random().unwrap()];
        assert_ne!(one.text(), other.text());
        assert!(Token::new(one.text().to_owned()).is_ok());
    }

    #[test]
    fn short_and_strange_tokens_are_refused() {
        for wrong in [
            "short",
            "with space in it",
            "percent%20percent",
            "ümlaut-ümlaut",
        ] {
            assert!(Token::new(wrong.into()).is_err(), "{wrong}");
        }
    }
}
