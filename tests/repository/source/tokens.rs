//! Splits Rust source text into tokens, without comments.

/// A token of Rust source text. Lifetimes are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    /// Identifier or keyword, without a leading `r#`.
    Name(String),
    /// `::`
    PathSeparator,
    /// Any other character that is not part of a name or literal.
    Symbol(char),
    /// String literal, without its quotes, escapes unchanged.
    Text(String),
    /// Number or character literal.
    Literal,
}

impl Token {
    /// True if the token is this name.
    pub fn is_name(&self, name: &str) -> bool {
        matches!(self, Self::Name(own) if own == name)
    }

    /// True if the token is this character.
    pub fn is(&self, symbol: char) -> bool {
        *self == Self::Symbol(symbol)
    }

    /// The identifier or keyword; `None` for other tokens.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Name(name) => Some(name),
            _ => None,
        }
    }
}

/// Returns the tokens of a file.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut reader = Reader { rest: text };
    std::iter::from_fn(|| reader.next()).flatten().collect()
}

/// The part of the text that has not been read yet.
struct Reader<'a> {
    rest: &'a str,
}

impl<'a> Reader<'a> {
    /// Reads up to the end of the next token. The inner value is `None` for a comment, a space or a lifetime.
    fn next(&mut self) -> Option<Option<Token>> {
        let first = self.rest.chars().next()?;
        if self.rest.starts_with("//") {
            let end = self.rest.find('\n').unwrap_or(self.rest.len());
            self.take(end);
            return Some(None);
        }
        if self.rest.starts_with("/*") {
            self.skip_block_comment();
            return Some(None);
        }
        if self.rest.starts_with("::") {
            self.take(2);
            return Some(Some(Token::PathSeparator));
        }
        if let Some(text) = self.string() {
            return Some(Some(Token::Text(text)));
        }
        if first == '\'' {
            return Some(self.character_or_lifetime());
        }
        if first.is_ascii_digit() {
            self.word();
            return Some(Some(Token::Literal));
        }
        if first.is_alphabetic() || first == '_' {
            if let Some(raw) = self.rest.strip_prefix("r#") {
                self.rest = raw;
            }
            return Some(Some(Token::Name(self.word().to_owned())));
        }
        self.take(first.len_utf8());
        Some((!first.is_whitespace()).then_some(Token::Symbol(first)))
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest;
        taken
    }

    fn word(&mut self) -> &'a str {
        let end = self
            .rest
            .find(|character: char| !(character.is_alphanumeric() || character == '_'));
        self.take(end.unwrap_or(self.rest.len()))
    }

    /// Skips a block comment, which may contain others.
    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        loop {
            let (step, change) = match self.rest {
                rest if rest.starts_with("/*") => (2, 1),
                rest if rest.starts_with("*/") => (2, -1),
                rest => match rest.chars().next() {
                    Some(character) => (character.len_utf8(), 0),
                    None => return,
                },
            };
            self.take(step);
            depth += change;
            if depth == 0 {
                return;
            }
        }
    }

    /// Reads a string literal of any kind; `None` if the text does not start with one.
    fn string(&mut self) -> Option<String> {
        let prefix = ["br", "cr", "r", "b", "c", ""].into_iter().find(|prefix| {
            let rest = self.rest.strip_prefix(prefix);
            let rest = rest.map(|rest| {
                if prefix.ends_with('r') {
                    rest.trim_start_matches('#')
                } else {
                    rest
                }
            });
            rest.is_some_and(|rest| rest.starts_with('"'))
        })?;
        self.take(prefix.len());
        if prefix.ends_with('r') {
            let hashes = self.rest.len() - self.rest.trim_start_matches('#').len();
            self.take(hashes + 1);
            let end = format!("\"{}", "#".repeat(hashes));
            let length = self.rest.find(&end).unwrap_or(self.rest.len());
            let text = self.take(length).to_owned();
            self.take(end.len().min(self.rest.len()));
            return Some(text);
        }
        self.take(1);
        let mut escaped = false;
        let end = self.rest.find(|character: char| {
            let is_end = character == '"' && !escaped;
            escaped = character == '\\' && !escaped;
            is_end
        });
        let text = self.take(end.unwrap_or(self.rest.len())).to_owned();
        self.take(1.min(self.rest.len()));
        Some(text)
    }

    fn character_or_lifetime(&mut self) -> Option<Token> {
        self.take(1);
        let mut characters = self.rest.chars();
        let first = characters.next()?;
        if first == '\\' {
            // The second character is escaped; `\u{..}` has further characters up to the closing quote.
            let after = 1 + characters.next().map_or(0, char::len_utf8);
            let end = self.rest[after..]
                .find('\'')
                .map_or(self.rest.len(), |at| after + at + 1);
            self.take(end);
            return Some(Token::Literal);
        }
        if characters.next() == Some('\'') {
            self.take(first.len_utf8() + 1);
            return Some(Token::Literal);
        }
        self.word();
        None
    }
}

#[test]
fn comments_and_strings_hide_what_looks_like_code() {
    let text = r####"
        // use crate::a;
        /* use crate::b; /* nested */ use crate::c; */
        let x = ("use \"crate::d", r#"use "crate"::e"#, b"f", '"', '\'', '\u{1F600}', 'x');
        fn lives<'a>(r#type: &'a str) -> u8 { crate::g::h(1.5e3) }
    "####;
    let names: Vec<String> = tokens(text)
        .iter()
        .filter_map(Token::name)
        .map(str::to_owned)
        .collect();
    let expected = "let x fn lives type str u8 crate g h";
    assert_eq!(names.join(" "), expected);
    let strings = tokens(text).into_iter().filter_map(|token| match token {
        Token::Text(text) => Some(text),
        _ => None,
    });
    let strings: Vec<String> = strings.collect();
    assert_eq!(strings, ["use \\\"crate::d", "use \"crate\"::e", "f"]);
}
