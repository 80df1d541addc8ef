//! The items of a source file that the rules are about: paths, imports, type names, test modules.
//!
//! Reads the tokens of one file; keeps no state between files. Code under `#[cfg(test)]` does not
//! count.

use super::tokens::{Token, tokens};

/// What one file holds.
#[derive(Debug, Default)]
pub struct Items {
    /// What `use` declarations import.
    pub imports: Vec<Import>,
    /// Paths such as `super::names::find` outside `use` declarations.
    pub paths: Vec<ScopedPath>,
    /// Structs, enums, unions, traits and type aliases that are no associated types.
    pub types: Vec<String>,
    /// Modules in files of their own that are compiled for tests only.
    pub test_modules: Vec<String>,
}

/// One name that a `use` declaration brings into scope.
#[derive(Debug, PartialEq)]
pub struct Import {
    /// The path as it is written, without the braces of a group.
    pub path: ScopedPath,
    /// The name that the path has from here on; `*` for all names of a module.
    pub alias: String,
}

/// A path and the inline modules, from the file's own on, that it is written in.
#[derive(Clone, Debug, PartialEq)]
pub struct ScopedPath {
    /// Names of the inline modules, outermost first; empty at the top of a file.
    pub scope: Vec<String>,
    /// The segments of the path.
    pub segments: Vec<String>,
}

/// What a pair of braces belongs to.
#[derive(PartialEq)]
enum Block {
    Module,
    /// An `impl` or a trait: types in it are associated ones.
    Associated,
    Other,
}

/// Reads a file's text.
pub fn items(text: &str) -> Items {
    let tokens = tokens(text);
    let mut reader = Reader { tokens: &tokens, ..Reader::default() };
    while reader.at < tokens.len() {
        reader.read_item();
    }
    reader.items
}

#[derive(Default)]
struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    /// The inline modules around `at`.
    scope: Vec<String>,
    blocks: Vec<Block>,
    /// What the next `{` opens, where that is known.
    next_block: Option<Block>,
    items: Items,
}

impl Reader<'_> {
    fn read_item(&mut self) {
        if self.is_test_attribute() {
            return self.skip_test_item();
        }
        match self.word(0) {
            Some("use") => self.read_use(),
            Some("mod") if self.word(1).is_some() => self.read_module(),
            Some("struct" | "enum" | "trait" | "union" | "type") => self.read_type(),
            Some("impl") if self.is_at_item() => {
                self.next_block = Some(Block::Associated);
                self.at += 1;
            }
            // `pub(in crate::a)` says who may use an item and uses nothing.
            Some("in") if self.mark(-1) == Some('(') => _ = self.path_from(self.at + 1),
            Some(_) => self.read_path(),
            None => self.read_mark(),
        }
    }

    fn token(&self, ahead: isize) -> Option<&Token> {
        self.at.checked_add_signed(ahead).and_then(|at| self.tokens.get(at))
    }

    fn word(&self, ahead: isize) -> Option<&str> {
        match self.token(ahead)? {
            Token::Word(word) => Some(word),
            _ => None,
        }
    }

    fn mark(&self, ahead: isize) -> Option<char> {
        match self.token(ahead)? {
            Token::Mark(mark) => Some(*mark),
            _ => None,
        }
    }

    /// Whether an item may start here, rather than `impl Trait` as the type of an argument or
    /// result.
    fn is_at_item(&self) -> bool {
        let starts_repetition = self.mark(-1) == Some('(') && self.mark(-2) == Some('$');
        self.word(-1) == Some("unsafe")
            || self.at == 0
            || matches!(self.mark(-1), Some('}' | '{' | ';' | ']'))
            || starts_repetition
    }

    fn read_mark(&mut self) {
        match self.mark(0) {
            Some('{') => self.blocks.push(self.next_block.take().unwrap_or(Block::Other)),
            Some('}') if self.blocks.pop() == Some(Block::Module) => _ = self.scope.pop(),
            Some(';') => self.next_block = None,
            _ => {}
        }
        self.at += 1;
    }

    fn read_module(&mut self) {
        if self.mark(2) == Some('{') {
            self.scope.extend(self.word(1).map(str::to_owned));
            self.next_block = Some(Block::Module);
        }
        self.at += 2;
    }

    fn read_type(&mut self) {
        let keyword = self.word(0).unwrap_or_default().to_owned();
        let is_name = |name: &&str| name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        if let Some(name) = self.word(1).filter(is_name).map(str::to_owned) {
            if self.blocks.last() != Some(&Block::Associated) {
                self.items.types.push(name);
            }
            if keyword == "trait" {
                self.next_block = Some(Block::Associated);
            }
            self.at += 1;
        }
        self.at += 1;
    }

    /// Reads a path of two segments or more; skips a lone word.
    fn read_path(&mut self) {
        let segments = self.path_from(self.at);
        if segments.len() > 1 {
            self.items.paths.push(ScopedPath { scope: self.scope.clone(), segments });
        }
    }

    /// Reads `a::b::c` from `start` on and moves behind it.
    fn path_from(&mut self, start: usize) -> Vec<String> {
        self.at = start;
        let mut segments = Vec::new();
        while let Some(word) = self.word(0) {
            segments.push(word.to_owned());
            self.at += 1;
            if self.token(0) != Some(&Token::PathSeparator) || self.word(1).is_none() {
                break;
            }
            self.at += 1;
        }
        segments
    }

    fn read_use(&mut self) {
        self.at += 1;
        self.read_use_tree(&[]);
    }

    /// Reads a tree such as `a::{b, c::d as e}`, whose paths all begin with `prefix`.
    fn read_use_tree(&mut self, prefix: &[String]) {
        if self.token(0) == Some(&Token::PathSeparator) {
            self.at += 1;
        }
        let path = [prefix, &self.path_from(self.at)].concat();
        if self.token(0) == Some(&Token::PathSeparator) {
            self.at += 1;
        }
        match self.mark(0) {
            Some('{') => {
                while matches!(self.mark(0), Some('{' | ',')) {
                    self.at += 1;
                    if self.mark(0) != Some('}') {
                        self.read_use_tree(&path);
                    }
                }
                self.at += 1;
            }
            Some('*') => {
                self.push_import(path, "*".into());
                self.at += 1;
            }
            _ => self.read_alias(path),
        }
    }

    fn read_alias(&mut self, mut path: Vec<String>) {
        // `self` in a group means what the group is of.
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        let alias = match (self.word(0), self.word(1)) {
            (Some("as"), Some(alias)) => Some(alias.to_owned()),
            _ => None,
        };
        if alias.is_some() {
            self.at += 2;
        }
        let alias = alias.or_else(|| path.last().cloned());
        self.push_import(path, alias.unwrap_or_default());
    }

    fn push_import(&mut self, segments: Vec<String>, alias: String) {
        let path = ScopedPath { scope: self.scope.clone(), segments };
        self.items.imports.push(Import { path, alias });
    }

    /// Whether `#[cfg(test)]` or `#[cfg(all(test, …))]` stands here.
    fn is_test_attribute(&self) -> bool {
        let starts = |text: &str| self.tokens[self.at..].starts_with(&tokens(text));
        self.mark(0) == Some('#') && (starts("#[cfg(test)]") || starts("#[cfg(all(test"))
    }

    /// Skips the item that is compiled for tests only, with all its attributes.
    fn skip_test_item(&mut self) {
        while self.mark(0) == Some('#') {
            self.at += 1;
            self.skip_brackets();
        }
        let is_field = self.mark(1) == Some(':');
        if let (Some("mod"), Some(name), Some(';')) = (self.word(0), self.word(1), self.mark(2)) {
            let name = name.to_owned();
            self.items.test_modules.push(name);
        }
        while let Some(token) = self.token(0) {
            match token {
                Token::Mark('{') => return self.skip_brackets(),
                Token::Mark('(' | '[') => self.skip_brackets(),
                Token::Mark('}') => return,
                Token::Mark(end) if *end == ';' || is_field && *end == ',' => {
                    self.at += 1;
                    return;
                }
                _ => self.at += 1,
            }
        }
    }

    /// Moves behind the bracket that closes the one here.
    fn skip_brackets(&mut self) {
        let mut depth = 0;
        while let Some(token) = self.token(0) {
            match token {
                Token::Mark('(' | '[' | '{') => depth += 1,
                Token::Mark(')' | ']' | '}') => depth -= 1,
                _ => {}
            }
            self.at += 1;
            if depth == 0 {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn import_of(import: &Import) -> String {
        format!("{} as {}", import.path.segments.join("::"), import.alias)
    }

    #[test]
    fn a_grouped_use_is_one_import_for_each_name() {
        let found = items("use crate::a::{self, b, c::{D, E as F}, g::*};\nuse super::h;");
        let imports: Vec<_> = found.imports.iter().map(import_of).collect();
        assert_eq!(
            imports,
            [
                "crate::a as a",
                "crate::a::b as b",
                "crate::a::c::D as D",
                "crate::a::c::E as F",
                "crate::a::g as *",
                "super::h as h",
            ]
        );
    }

    #[test]
    fn paths_are_found_in_bodies_macros_and_signatures() {
        let text = "fn f(x: &crate::a::B) { m!(super::c::d(x)); e::<u8>::g(); h::i::<u8>() }";
        let paths: Vec<_> = items(text).paths.iter().map(|path| path.segments.join("::")).collect();
        assert_eq!(paths, ["crate::a::B", "super::c::d", "h::i"]);
    }

    #[test]
    fn a_path_knows_the_inline_modules_around_it() {
        let found = items("mod a { mod b { use super::c; } fn f() { d::e(); } } fn g() { h::i() }");
        assert_eq!(found.imports[0].path.scope, ["a", "b"]);
        let scopes: Vec<_> = found.paths.iter().map(|path| path.scope.join("::")).collect();
        assert_eq!(scopes, ["a", ""]);
    }

    #[test]
    fn code_for_tests_does_not_count() {
        let text = "#[cfg(test)] #[path = \"t.rs\"] mod t;\n#[cfg(test)] mod u { use crate::a; }\n\
                    struct S { #[cfg(test)] seen: crate::b::C, kept: crate::d::E }\n\
                    #[cfg(test)] fn f<A, B>(a: [u8; 2]) { crate::g::h(a) }\nstruct T;";
        let found = items(text);
        assert_eq!(found.test_modules, ["t"]);
        assert!(found.imports.is_empty());
        let paths: Vec<_> = found.paths.iter().map(|path| path.segments.join("::")).collect();
        assert_eq!(paths, ["crate::d::E"]);
        assert_eq!(found.types, ["S", "T"]);
    }

    #[test]
    fn associated_types_are_not_types_of_their_own() {
        let text = "trait A { type B; } impl A for C { type B = u8; }\n\
                    macro_rules! m { ($($a:ty)*) => {$(impl A for $a { type B = u8; })*} }\n\
                    fn f() -> impl Fn() { struct D; D } pub type E<T> = Vec<T>; union F { a: u8 }";
        assert_eq!(items(text).types, ["A", "D", "E", "F"]);
    }

    #[test]
    fn a_restricted_visibility_is_no_path() {
        assert!(items("pub(in crate::a) struct B;").paths.is_empty());
    }
}
