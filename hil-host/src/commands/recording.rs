//! Options for reading the channels of a recording.

use encoding_rs::Encoding;

use dashpot_recording::{Channel, Channels, DecimalMark, Quantity, Separator, TextOptions, Unit};

/// Options of commands that read a motion.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct MotionArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    displacement: DisplacementArguments,
    #[command(flatten)]
    file: FileArguments,
}

/// Options of commands that read a force.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct ForceHistoryArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    force: ForceArguments,
    #[command(flatten)]
    file: FileArguments,
}

/// Options of commands that read a motion and its measured force.
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

/// Options of commands that list the channels of a file.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct ListingArguments {
    #[command(flatten)]
    time: TimeArguments,
    #[command(flatten)]
    file: FileArguments,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
struct TimeArguments {
    /// Name or number (from 1) of the time channel [default: time_s; for MDF4 the time of the group].
    #[arg(long = "time", value_name = "CHANNEL")]
    time: Option<String>,
    /// Unit of the time (s, ms, us, ns, min); overrides the file.
    #[arg(long, value_name = "UNIT", value_parser = time_unit)]
    time_unit: Option<Unit>,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
struct DisplacementArguments {
    /// Name or number of the displacement channel [default: displacement_m].
    #[arg(long, value_name = "CHANNEL")]
    displacement: Option<String>,
    /// Unit of the displacement (m, cm, mm, um, in); overrides the file.
    #[arg(long, value_name = "UNIT", value_parser = length_unit)]
    displacement_unit: Option<Unit>,
    /// The displacement is positive in compression.
    #[arg(long)]
    reverse_displacement: bool,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
struct ForceArguments {
    /// Name or number of the force channel [default: force_n].
    #[arg(long, value_name = "CHANNEL")]
    force: Option<String>,
    /// Unit of the force (N, daN, kN, MN, lbf); overrides the file.
    #[arg(long, value_name = "UNIT", value_parser = force_unit)]
    force_unit: Option<Unit>,
    /// The force is positive in compression.
    #[arg(long)]
    reverse_force: bool,
}

#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
struct FileArguments {
    /// Name or number (from 1) of the MDF4 group that contains the channels.
    #[arg(long, value_name = "GROUP")]
    group: Option<String>,
    /// Skip rows with a missing value: an empty cell, a null or a sample marked invalid.
    #[arg(long)]
    skip_invalid: bool,
    /// Separator of cells in text [default: detected].
    #[arg(long, value_parser = super::named_values::separator())]
    separator: Option<Separator>,
    /// Decimal mark in text [default: detected].
    #[arg(long, value_parser = super::named_values::decimal_mark(), value_name = "MARK")]
    decimal_mark: Option<DecimalMark>,
    /// Treat the first row of text as a header with column names, or not [default: detected].
    #[arg(long, value_name = "yes|no", value_parser = yes_or_no)]
    header: Option<bool>,
    /// Encoding of text, such as utf-16le or windows-1252 [default: detected].
    #[arg(long, value_name = "NAME", value_parser = encoding)]
    encoding: Option<&'static Encoding>,
    /// Number of lines to skip before the header or first row, not counting lines that start with #.
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    skip_lines: u64,
}

impl MotionArguments {
    /// Returns the channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.displacement = self.displacement.channel();
        channels
    }
}

impl ForceHistoryArguments {
    /// Returns the channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.force = self.force.channel();
        channels
    }
}

impl MeasurementArguments {
    /// True if an option about the force is given.
    pub fn has_force(&self) -> bool {
        self.force != ForceArguments::default()
    }

    /// Returns the channels.
    pub fn channels(&self) -> Channels {
        let mut channels = self.file.channels();
        channels.time = self.time.channel();
        channels.displacement = self.displacement.channel();
        channels.force = self.force.channel();
        channels
    }
}

impl ListingArguments {
    /// Returns the options that another command needs too, to read the same rows.
    pub fn repeated(&self) -> String {
        let file = &self.file;
        let mut options = String::new();
        if file.skip_lines > 0 {
            options += &format!(" --skip-lines {}", file.skip_lines);
        }
        if let Some(header) = file.header {
            options += if header {
                " --header yes"
            } else {
                " --header no"
            };
        }
        if let Some(encoding) = file.encoding {
            options += &format!(" --encoding {}", encoding.name());
        }
        if file.skip_invalid {
            options += " --skip-invalid";
        }
        options
    }

    /// Returns the channels.
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
