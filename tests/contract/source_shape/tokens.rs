//! A lexer for Rust that keeps words, `::` and punctuation.
//!
//! It drops comments, white space, and string and character literals, so that names in them do not
//! count as uses. It reads one file's text and writes nothing.

/// A part of Rust source.
#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    /// An identifier, a keyword or a number.
    Word(String),
    /// `::`
    PathSeparator,
    /// Any other character that is not white space.
    Mark(char),
}

/// The tokens of a text.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut lexer = Lexer { rest: text, tokens: Vec::new() };
    while let Some(first) = lexer.rest.chars().next() {
        lexer.read_token(first);
    }
    lexer.tokens
}

struct Lexer<'a> {
    rest: &'a str,
    tokens: Vec<Token>,
}

impl Lexer<'_> {
    fn read_token(&mut self, first: char) {
        if self.rest.starts_with("//") {
            self.skip(self.rest.find('\n').unwrap_or(self.rest.len()));
        } else if self.rest.starts_with("/*") {
            self.skip_block_comment();
        } else if let Some(hashes) = raw_string_hashes(self.rest) {
            self.skip_raw_string(hashes);
        } else if first == '"' {
            self.skip_string();
        } else if first == '\'' {
            self.skip_character_or_lifetime();
        } else if self.rest.starts_with("::") {
            self.tokens.push(Token::PathSeparator);
            self.skip(2);
        } else if is_word(first) {
            let end = self.rest.find(|c| !is_word(c)).unwrap_or(self.rest.len());
            self.tokens.push(Token::Word(self.rest[..end].to_owned()));
            self.skip(end);
        } else {
            if !first.is_whitespace() {
                self.tokens.push(Token::Mark(first));
            }
            self.skip(first.len_utf8());
        }
    }

    fn skip(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes..];
    }

    /// Skips a block comment, which may hold others.
    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        loop {
            let step = match self.rest.as_bytes() {
                [b'/', b'*', ..] => {
                    depth += 1;
                    2
                }
                [b'*', b'/', ..] => {
                    depth -= 1;
                    2
                }
                [] => return,
                _ => self.rest.chars().next().map_or(1, char::len_utf8),
            };
            self.skip(step);
            if depth == 0 {
                return;
            }
        }
    }

    fn skip_raw_string(&mut self, hashes: usize) {
        let end = format!("\"{}", "#".repeat(hashes));
        let start = self.rest.find('"').map_or(self.rest.len(), |quote| quote + 1);
        let length = self.rest[start..].find(&end).map(|at| start + at + end.len());
        self.skip(length.unwrap_or(self.rest.len()));
    }

    fn skip_string(&mut self) {
        let mut is_escaped = false;
        let closes = |c: char| {
            let does = c == '"' && !is_escaped;
            is_escaped = c == '\\' && !is_escaped;
            does
        };
        let end = self.rest[1..].find(closes).map_or(self.rest.len(), |at| at + 2);
        self.skip(end);
    }

    /// Skips `'x'` or `'\n'` as a whole, and of `'a` in `&'a str` the quote and the name.
    fn skip_character_or_lifetime(&mut self) {
        let mut following = self.rest.char_indices().skip(1);
        let (character, after) = (following.next(), following.next());
        let end = match (character, after) {
            (Some((_, '\\')), Some((escaped, c))) => {
                let start = escaped + c.len_utf8();
                self.rest[start..].find('\'').map(|at| start + at + 1)
            }
            (_, Some((quote, '\''))) => Some(quote + 1),
            _ => self.rest[1..].find(|c| !is_word(c)).map(|at| at + 1),
        };
        self.skip(end.unwrap_or(self.rest.len()));
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// How many `#` open the raw string that the text starts with; none if it starts with no raw
/// string.
fn raw_string_hashes(text: &str) -> Option<usize> {
    let text = text.strip_prefix('b').or(text.strip_prefix('c')).unwrap_or(text);
    let text = text.strip_prefix('r')?;
    let hashes = text.len() - text.trim_start_matches('#').len();
    text[hashes..].starts_with('"').then_some(hashes)
}

#[test]
fn comments_and_literals_hold_no_tokens() {
    let text = r###"
        // crate::a
        /* crate::b /* crate::c */ still a comment */
        x("crate::d \" crate::e", r#"crate::f " "#, b"g", '"', '\'', '\u{e9}', '::');
    "###;
    let words: Vec<_> =
        tokens(text).into_iter().filter(|token| matches!(token, Token::Word(_))).collect();
    // The `b` before a byte string is a word, which no rule minds.
    assert_eq!(words, ["x", "b"].map(|word| Token::Word(word.into())));
}

#[test]
fn a_lifetime_is_not_the_start_of_a_character() {
    let words = ["fn", "f", "a", "str", "g"].map(|word| Token::Word(word.into()));
    let found = tokens("fn f<'a>(a: &'a str) { g('a') }");
    assert_eq!(found.into_iter().filter(|t| words.contains(t)).count(), words.len());
}

#[test]
fn paths_are_words_and_separators() {
    let word = |text: &str| Token::Word(text.into());
    let expected = [word("a"), Token::PathSeparator, word("b"), Token::Mark(':'), word("c")];
    assert_eq!(tokens("a::b : c"), expected);
}
