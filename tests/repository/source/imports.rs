//! Finds the submodules and items that a module declares, and the paths into its own crate that it names.

use super::tokens::Token;

/// A path as a list of names, such as `["crate", "health", "Watch"]`.
pub type Path = Vec<String>;

/// Declarations and paths of one module.
#[derive(Debug, Default)]
pub struct Contents {
    /// Modules in files of their own.
    pub files: Vec<String>,
    /// Modules whose text is in this file.
    pub inline: Vec<(String, Contents)>,
    /// Functions, types and so on defined here.
    pub items: Vec<String>,
    /// Paths named outside `use`; the first name is `crate`, `self` or `super`.
    pub paths: Vec<Path>,
    /// Imports.
    pub uses: Vec<Use>,
}

/// One name that a `use` brings into scope.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Use {
    /// Name in this module; `*` for all names of the path.
    pub name: String,
    /// Full path of what is imported.
    pub path: Path,
    /// True if other modules may import the name from here.
    pub is_public: bool,
}

const DEFINING: [&str; 8] = [
    "fn", "struct", "enum", "union", "trait", "type", "const", "static",
];

/// Reads the contents of a module from its tokens. Leaves out code that is compiled only for tests.
pub fn contents(tokens: &[Token]) -> Contents {
    let mut contents = Contents::default();
    let mut at = 0;
    let mut depth = 0;
    let mut is_public = false;
    while let Some(token) = tokens.get(at) {
        let rest = &tokens[at..];
        let previous = at.checked_sub(1).and_then(|at| tokens.get(at));
        at += match token {
            Token::Symbol('#') => attribute(rest),
            Token::Name(name) if name == "pub" => {
                is_public = true;
                // A path in `pub(in path)` imports nothing.
                at += 1 + if tokens.get(at + 1).is_some_and(|next| next.is('(')) {
                    group(&tokens[at + 1..])
                } else {
                    0
                };
                continue;
            }
            Token::Name(name) if name == "use" => {
                let length = rest
                    .iter()
                    .position(|token| token.is(';'))
                    .unwrap_or(rest.len() - 1);
                tree(&rest[1..length], &[], &mut |path, name| {
                    contents.uses.push(Use {
                        name,
                        path,
                        is_public,
                    });
                });
                length + 1
            }
            Token::Name(name) if name == "mod" && depth == 0 => module(rest, &mut contents),
            Token::Name(name) if matches!(&**name, "crate" | "self" | "super") => {
                let is_start = previous != Some(&Token::PathSeparator);
                let (path, length) = path(rest);
                if is_start && path.len() > 1 {
                    contents.paths.push(path);
                }
                length
            }
            Token::Name(name) if depth == 0 && DEFINING.contains(&&**name) => {
                contents
                    .items
                    .extend(rest.get(1).and_then(Token::name).map(str::to_owned));
                1
            }
            Token::Symbol('{' | '(' | '[') => {
                depth += 1;
                1
            }
            Token::Symbol('}' | ')' | ']') => {
                depth -= 1;
                1
            }
            _ => 1,
        };
        is_public = false;
    }
    contents
}

/// Length of an attribute, including the item after it if that is compiled only for tests.
fn attribute(tokens: &[Token]) -> usize {
    let open = if tokens.get(1).is_some_and(|token| token.is('!')) {
        2
    } else {
        1
    };
    if !tokens.get(open).is_some_and(|token| token.is('[')) {
        return 1;
    }
    let length = open + group(&tokens[open..]);
    let inner = &tokens[open + 1..length];
    let starts_with = |names: &[&str]| {
        let own = inner.iter().filter_map(Token::name);
        own.take(names.len()).eq(names.iter().copied())
    };
    if starts_with(&["cfg", "test"])
        || starts_with(&["cfg", "all", "test"])
        || starts_with(&["test"])
    {
        return length + item(&tokens[length..]);
    }
    1 // The attribute may contain paths.
}

/// Length of an item with its attributes.
fn item(tokens: &[Token]) -> usize {
    let mut at = 0;
    let is_use = |at: usize| tokens[..at].iter().all(|token| !token.is_name("use"));
    while let Some(token) = tokens.get(at) {
        at += match token {
            Token::Symbol(';') => return at + 1,
            Token::Symbol('{') if is_use(at) => return at + group(&tokens[at..]),
            Token::Symbol('(' | '[' | '{') => group(&tokens[at..]),
            _ => 1,
        };
    }
    at
}

/// Length of a group in brackets, which starts with the opening one.
fn group(tokens: &[Token]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        match token {
            Token::Symbol('(' | '[' | '{') => depth += 1,
            Token::Symbol(')' | ']' | '}') => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    tokens.len()
}

/// Adds `mod name;` or `mod name { .. }`; returns its length.
fn module(tokens: &[Token], contents: &mut Contents) -> usize {
    let Some(name) = tokens.get(1).and_then(Token::name) else {
        return 1;
    };
    match tokens.get(2) {
        Some(Token::Symbol(';')) => {
            contents.files.push(name.to_owned());
            3
        }
        Some(Token::Symbol('{')) => {
            let length = group(&tokens[2..]);
            let inner = self::contents(&tokens[3..2 + length - 1]);
            contents.inline.push((name.to_owned(), inner));
            2 + length
        }
        _ => 1,
    }
}

/// Reads names joined by `::`; returns them and the length.
fn path(tokens: &[Token]) -> (Path, usize) {
    let mut path = Vec::new();
    let mut at = 0;
    while let Some(name) = tokens.get(at).and_then(Token::name) {
        path.push(name.to_owned());
        at += 1;
        if tokens.get(at) != Some(&Token::PathSeparator) {
            break;
        }
        at += 1;
    }
    (path, at.max(1))
}

/// Calls `add` with the path and the name of each leaf of a tree such as `a::{self, b as c, d::*}`.
fn tree(tokens: &[Token], before: &[String], add: &mut impl FnMut(Path, String)) {
    let (names, length) = match tokens.first() {
        Some(Token::Name(_)) => path(tokens),
        _ => (Vec::new(), 0),
    };
    let mut whole = [before, &names].concat();
    let rest = &tokens[length..];
    match rest.first() {
        Some(Token::Symbol('{')) => {
            let inner = &rest[1..group(rest) - 1];
            let mut start = 0;
            while start < inner.len() {
                let mut end = start;
                while end < inner.len() && !inner[end].is(',') {
                    end += if inner[end].is('{') {
                        group(&inner[end..])
                    } else {
                        1
                    };
                }
                if end > start {
                    tree(&inner[start..end], &whole, add);
                }
                start = end + 1;
            }
        }
        Some(Token::Symbol('*')) => add(whole, "*".to_owned()),
        _ => {
            if !before.is_empty() && names == ["self"] {
                whole.pop();
            }
            let alias = rest
                .get(1)
                .filter(|_| rest[0].is_name("as"))
                .and_then(Token::name);
            let name = alias
                .or(whole.last().map(String::as_str))
                .unwrap_or_default()
                .to_owned();
            add(whole, name);
        }
    }
}

#[cfg(test)]
fn read(text: &str) -> Contents {
    contents(&super::tokens(text))
}

#[test]
fn uses_are_read_leaf_by_leaf() {
    let contents = read("pub use a::{self, b as c, d::*, e::{F, g}}; use crate::h;");
    let uses = contents
        .uses
        .iter()
        .map(|one| format!("{} {} {}", one.name, one.path.join("::"), one.is_public));
    let uses: Vec<String> = uses.collect();
    let expected = [
        "a a true",
        "c a::b true",
        "* a::d true",
        "F a::e::F true",
        "g a::e::g true",
        "h crate::h false",
    ];
    assert_eq!(uses, expected);
}

#[test]
fn code_for_tests_is_left_out() {
    let text = "mod a; #[cfg(test)] mod b { use crate::c; } #[cfg(test)] use crate::{d, e};
        #[cfg(all(test, unix))] fn f() -> [u8; 2] { crate::g() }
        #[cfg(not(test))] fn h() { crate::i::j::<crate::k::L>(super::m) }
        mod n { pub(in crate::o) struct P(self::q::R); }";
    let contents = read(text);
    assert_eq!(contents.files, ["a"]);
    assert_eq!(contents.uses, []);
    assert_eq!(contents.items, ["h"]);
    let paths: Vec<String> = contents.paths.iter().map(|path| path.join("::")).collect();
    assert_eq!(paths, ["crate::i::j", "crate::k::L", "super::m"]);
    let (name, inner) = &contents.inline[0];
    assert_eq!((&**name, &inner.items[..]), ("n", &["P".to_owned()][..]));
    assert_eq!(inner.paths, [["self", "q", "R"]]);
}
