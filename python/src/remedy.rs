//! Remedies for errors, expressed as arguments of the package.

use dashpot_recording::Quantity;
use dashpot_recording::Remedy;

/// Error message with its remedy, if any.
pub fn with_remedy(message: String, remedy: Option<Remedy>) -> String {
    match remedy {
        Some(remedy) => format!("{message}; {}", in_arguments(remedy)),
        None => message,
    }
}

fn in_arguments(remedy: Remedy) -> String {
    match remedy {
        Remedy::NameChannel(quantity) => {
            format!("choose one with {}=NAME or its number", channel(quantity))
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
        Remedy::NameGroup => "choose one with group=NAME or its number".into(),
        Remedy::SayWhetherHeader => "use header=True or header=False".into(),
        Remedy::GiveDecimalMark => "use decimal_mark=\"point\" or \"comma\"".into(),
        Remedy::SkipLines => "if the file begins with a title, remove its lines".into(),
        Remedy::SkipTitle { lines } => format!("remove the {lines} lines before it"),
        Remedy::SkipInvalid => "use skip_invalid=True to skip rows with a missing value".into(),
    }
}

fn channel(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Time => "time",
        Quantity::Displacement => "displacement",
        Quantity::Force => "force",
    }
}

fn unit(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Time => "time_unit",
        Quantity::Displacement => "displacement_unit",
        Quantity::Force => "force_unit",
    }
}
