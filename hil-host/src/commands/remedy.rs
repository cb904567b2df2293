//! Remedies for errors, expressed as command-line options.

use dashpot_recording::Quantity;
use dashpot_recording::Remedy;

/// Appends the remedy to an error message, if there is one.
pub fn with_remedy(message: String, remedy: Option<Remedy>) -> String {
    match remedy {
        Some(remedy) => format!("{message}; {}", in_options(remedy)),
        None => message,
    }
}

fn in_options(remedy: Remedy) -> String {
    match remedy {
        Remedy::NameChannel(quantity) => {
            format!("choose one with {} NAME or its number", channel(quantity))
        }
        Remedy::NumberChannel { quantity, count } => format!(
            "choose one of 1 to {count} with {}, and its unit with {}",
            channel(quantity),
            unit(quantity)
        ),
        Remedy::GiveUnit(quantity) => {
            format!("give it with {}: {}", unit(quantity), quantity.unit_names())
        }
        Remedy::OverrideUnit(quantity) => format!("{} overrides it", unit(quantity)),
        Remedy::NameGroup => "choose one with --group".into(),
        Remedy::SayWhetherHeader => "use --header yes or --header no".into(),
        Remedy::GiveDecimalMark => "use --decimal-mark point or --decimal-mark comma".into(),
        Remedy::SkipLines => {
            "if the file begins with a title, skip its lines with --skip-lines N".into()
        }
        Remedy::SkipTitle { lines } => {
            format!("skip the lines before it with --skip-lines {lines}")
        }
        Remedy::SkipInvalid => "use --skip-invalid to skip rows with a missing value".into(),
    }
}

fn channel(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Time => "--time",
        Quantity::Displacement => "--displacement",
        Quantity::Force => "--force",
    }
}

fn unit(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Time => "--time-unit",
        Quantity::Displacement => "--displacement-unit",
        Quantity::Force => "--force-unit",
    }
}

/// Returns the option for a key of a file: `--speed-km-h` for `speed_km_h`.
pub fn option_of(key: &str) -> String {
    let words: Vec<&str> = key.split('_').collect();
    format!("--{}", words.join("-"))
}
