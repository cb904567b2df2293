//! Options that say which channels of a recording are read, and as what.

use encoding_rs::Encoding;

use dashpot_recording::{Channel, Channels, DecimalMark, Quantity, Separator, TextOptions, Unit};

/// Heading of the options in the help.
const HEADING: &str = "How the recording is read";

/// What commands that read a motion have.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct MotionArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    displacement: DisplacementArguments,
    #[command(flatten)]
    file: FileArguments,
}

/// What commands that read a force have.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct ForceHistoryArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    force: ForceArguments,
    #[command(flatten)]
    file: FileArguments,
}

/// What commands that read a motion and the force measured on it have.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct MeasurementArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    displacement: DisplacementArguments,
    #[command(flatten)]
    force: ForceArguments,
    #[command(flatten)]
    file: FileArguments,
}

/// What commands that look at a file have.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct ListingArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    file: FileArguments,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
struct TimeArguments {
    /// Name or number, from 1, of the channel of the time; by default time_s, of MDF4 the group's own time.
    #[arg(long = "time", value_name = "CHANNEL")]
    time: Option<String>,
    /// Its unit (s, ms, us, ns, min), whatever the file tells.
    #[arg(long, value_name = "UNIT", value_parser = time_unit)]
    time_unit: Option<Unit>,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
struct DisplacementArguments {
    /// Name or number of the channel of the displacement; by default displacement_m.
    #[arg(long, value_name = "CHANNEL")]
    displacement: Option<String>,
    /// Its unit (m, cm, mm, um, in), whatever the file tells.
    #[arg(long, value_name = "UNIT", value_parser = length_unit)]
    displacement_unit: Option<Unit>,
    /// The displacement is positive in compression.
    #[arg(long)]
    reverse_displacement: bool,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
struct ForceArguments {
    /// Name or number of the channel of the force; by default force_n.
    #[arg(long, value_name = "CHANNEL")]
    force: Option<String>,
    /// Its unit (N, daN, kN, MN, lbf), whatever the file tells.
    #[arg(long, value_name = "UNIT", value_parser = force_unit)]
    force_unit: Option<Unit>,
    /// The force is positive in compression.
    #[arg(long)]
    reverse_force: bool,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
#[command(next_help_heading = HEADING)]
struct FileArguments {
    /// Name or number, from 1, of the group of an MDF4 file that the channels are in.
    #[arg(long, value_name = "GROUP")]
    group: Option<String>,
    /// Leave out rows that lack a value: an empty cell, a null, a sample marked invalid.
    #[arg(long)]
    skip_invalid: bool,
    /// What separates the cells of text; found where not given.
    #[arg(long, value_parser = super::named_values::separator())]
    separator: Option<Separator>,
    /// The mark before the decimals of text; found where not given.
    #[arg(long, value_parser = super::named_values::decimal_mark(), value_name = "MARK")]
    decimal_mark: Option<DecimalMark>,
    /// Whether the first row of text has the names of the columns; found where not given.
    #[arg(long, value_name = "yes|no", value_parser = yes_or_no)]
    header: Option<bool>,
    /// Encoding of text, such as utf-16le or windows-1252; found where not given.
    #[arg(long, value_name = "NAME", value_parser = encoding)]
    encoding: Option<&'static Encoding>,
    /// Lines of text before the header or the first row, beside those that start with #.
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    skip_lines: u64,
}

impl MotionArguments {
    /// The channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.displacement = self.displacement.channel();
        channels
    }
}

impl ForceHistoryArguments {
    /// The channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.force = self.force.channel();
        channels
    }
}

impl MeasurementArguments {
    /// The channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.displacement = self.displacement.channel();
        channels.force = self.force.channel();
        channels
    }
}

impl ListingArguments {
    /// The channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels
    }
}

impl TimeArguments {
    fn channel(&self) -> Channel {
        Channel {
            name: self.time.clone(),
            unit: self.time_unit,
            reversed: false,
        }
    }
}

impl DisplacementArguments {
    fn channel(&self) -> Channel {
        Channel {
            name: self.displacement.clone(),
            unit: self.displacement_unit,
            reversed: self.reverse_displacement,
        }
    }
}

impl ForceArguments {
    fn channel(&self) -> Channel {
        Channel {
            name: self.force.clone(),
            unit: self.force_unit,
            reversed: self.reverse_force,
        }
    }
}

impl FileArguments {
    fn channels(&self) -> Channels {
        Channels {
            group: self.group.clone(),
            skip_invalid: self.skip_invalid,
            text: TextOptions {
                separator: self.separator,
                decimal_mark: self.decimal_mark,
                header: self.header,
                encoding: self.encoding,
                skip_lines: self.skip_lines,
            },
            ..Channels::default()
        }
    }
}

fn time_unit(text: &str) -> Result<Unit, String> {
    unit(Quantity::Time, text)
}

fn length_unit(text: &str) -> Result<Unit, String> {
    unit(Quantity::Displacement, text)
}

fn force_unit(text: &str) -> Result<Unit, String> {
    unit(Quantity::Force, text)
}

fn unit(quantity: Quantity, text: &str) -> Result<Unit, String> {
    quantity
        .unit(text)
        .ok_or_else(|| format!("allowed: {}", quantity.unit_names()))
}

fn yes_or_no(text: &str) -> Result<bool, String> {
    match text {
        "yes" => Ok(true),
        "no" => Ok(false),
        _ => Err("allowed: yes, no".into()),
    }
}

fn encoding(text: &str) -> Result<&'static Encoding, String> {
    Encoding::for_label(text.as_bytes()).ok_or_else(|| {
        "allowed: a name of the Encoding Standard, such as utf-8, utf-16le, utf-16be, windows-1252"
            .into()
    })
}
