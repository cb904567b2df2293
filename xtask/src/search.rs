//! `cargo xtask search`: searches for the worst case of the accuracy promise.

use crate::run::{Outcome, cargo, repository};

/// Default number of motions; the search takes some minutes on two cores.
const EVALUATIONS: usize = 4_000;
const SEED: u64 = 1;

/// Options of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Motions to try.
    pub evaluations: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Options {
    /// Reads the options of the command line.
    ///
    /// # Errors
    /// An option is unknown, or a number is out of range.
    pub fn parse(words: &[&str]) -> Result<Self, String> {
        let mut options = Self {
            evaluations: EVALUATIONS,
            seed: SEED,
        };
        for pair in words.chunks(2) {
            match pair {
                ["--evaluations", text] => match text.parse() {
                    Ok(number @ 1..=1_000_000_000) => options.evaluations = number,
                    _ => return Err(format!("--evaluations {text}: must be 1 to 1000000000")),
                },
                ["--seed", text] => match text.parse() {
                    Ok(seed) => options.seed = seed,
                    Err(_) => return Err(format!("--seed {text}: must be a whole number")),
                },
                _ => {
                    return Err(format!(
                        "search takes --evaluations N and --seed S, not `{}`",
                        pair.join(" ")
                    ));
                }
            }
        }
        Ok(options)
    }
}

/// Runs the search, prints each case that is worse than all before it, and writes the worst case to target/search.
///
/// # Errors
/// A case breaks the promise. It is written to the folder too.
pub fn search(options: Options) -> Outcome {
    let folder = repository().join("target/search");
    cargo(&[
        "run",
        "--quiet",
        "--package",
        "dashpot",
        "--example",
        "search",
        "--",
        &options.evaluations.to_string(),
        &options.seed.to_string(),
        &folder.to_string_lossy(),
    ])
}

#[cfg(test)]
mod tests {
    use super::Options;

    #[test]
    fn options_are_read() {
        let options = Options::parse(&["--seed", "7", "--evaluations", "300"]);
        assert_eq!(
            options,
            Ok(Options {
                evaluations: 300,
                seed: 7
            })
        );
        assert_eq!(Options::parse(&[]).map(|options| options.seed), Ok(1));
        for wrong in [
            &["--seed"][..],
            &["--seed", "x"],
            &["--evaluations", "0"],
            &["--depth", "1"],
        ] {
            assert!(Options::parse(wrong).is_err(), "{wrong:?}");
        }
    }
}
