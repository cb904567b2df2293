//! What a user of the command can do about an error, in the words of its options.

use dashpot_recording::Quantity;
use dashpot_recording::Remedy;

/// The message of an error with its remedy, where it has one.
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
            format!("name it: {} with {}", unit(quantity), quantity.unit_names())
        }
        Remedy::OverrideUnit(quantity) => format!("{} overrides it", unit(quantity)),
        Remedy::NameGroup => "choose one with --group".into(),
        Remedy::SayWhetherHeader => "say which: --header yes or --header no".into(),
        Remedy::GiveDecimalMark => "say which holds: --decimal-mark point or comma".into(),
        Remedy::SkipInvalid => "--skip-invalid leaves out rows that lack a value".into(),
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

/// The option whose name is that of a key of a file: `speed_km_h` is given by `--speed-km-h`.
pub fn option_of(key: &str) -> String {
    let words: Vec<&str> = key.split('_').collect();
    format!("--{}", words.join("-"))
}
