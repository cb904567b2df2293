//! Headings in the help of commands with many options. Options without a heading come first: those that most users
//! need.

use clap::{Arg, Command};

/// Options, by their long names, under a heading in the help of some commands.
struct Heading {
    text: &'static str,
    /// Names of the commands; all commands if empty.
    commands: &'static [&'static str],
    /// Separated by spaces.
    options: &'static str,
}

const VEHICLES: &[&str] = &["vehicle", "live", "plan"];
const ALL: &[&str] = &[];

const HEADINGS: [Heading; 27] = [
    Heading {
        text: "Run",
        commands: VEHICLES,
        options: "start-m friction normal-damping-s-per-m step-us push-m wear-law contact-tables",
    },
    Heading {
        text: "Wheels and rails",
        commands: &["vehicle", "live", "plan", "modes"],
        options: "wheel rail left-rail right-rail rail-inclination gauge-m",
    },
    Heading {
        text: "External dampers",
        commands: &["vehicle", "live"],
        options: "outside hold-ticks timeout-ms tries baud",
    },
    Heading {
        text: "External dampers on a simulated rig",
        commands: &["vehicle", "live"],
        options: "actuator compensate without-guard without-margin rig-seed",
    },
    Heading {
        text: "A target or a recording instead of a vehicle",
        commands: &["live"],
        options: "link slot-damper recording",
    },
    Heading {
        text: "Real time",
        commands: &["vehicle", "live", "replay", "budget", "rig", "pil"],
        options: "realtime paced histogram stop-above-ns fail-on-miss fifo lock-memory core no-deep-sleep",
    },
    Heading {
        text: "Measurement and calibration",
        commands: &["vehicle", "pil"],
        options: "xcp a2l",
    },
    Heading {
        text: "Output",
        commands: &["vehicle", "sweep", "contact", "shims", "calibrate"],
        options: "no-page parquet plots no-plots page format",
    },
    Heading {
        text: "Reading the recording",
        commands: ALL,
        options: "time time-unit displacement displacement-unit reverse-displacement force force-unit reverse-force \
                  group skip-invalid separator decimal-mark header encoding skip-lines",
    },
    Heading {
        text: "Health estimate from the measured force",
        commands: &["replay"],
        options: "health health-baseline",
    },
    Heading {
        text: "Settings of the health estimate",
        commands: ALL,
        options: "displacement-noise-m force-noise-n memory-s law-deviation lag-s lag-sd-s",
    },
    Heading {
        text: "FMU",
        commands: &["export"],
        options: "fmi also loadable platform sources-only",
    },
    Heading {
        text: "FMU of a vehicle",
        commands: &["export"],
        options: "case outside ssp library",
    },
    Heading {
        text: "Fit",
        commands: &["calibrate"],
        options: "indices vary-each temperature-c validate plan prior no-priors no-skew hold \
                  temperature-uncertainty-k density-uncertainty-kg-per-m3 max-misfit-percent starts step-us",
    },
    Heading {
        text: "Shards",
        commands: &["sweep"],
        options: "shard shards",
    },
    Heading {
        text: "Existing results",
        commands: &["sweep"],
        options: "reuse anew",
    },
    Heading {
        text: "This machine",
        commands: &["sweep"],
        options: "threads contact-tables",
    },
    Heading {
        text: "Link",
        commands: &["pil"],
        options: "timeout-ms tries baud",
    },
    Heading {
        text: "Faults of the link",
        commands: &["pil"],
        options: "faults seed",
    },
    Heading {
        text: "Motions without a recording",
        commands: &["verify"],
        options: "rate-hz top-speed-m-per-s",
    },
    Heading {
        text: "Profiles",
        commands: &["contact"],
        options: "wheel-format rail-format wheel-mirror rail-mirror left-wheel left-rail left-wheel-format \
                  left-rail-format left-wheel-mirror left-rail-mirror smoothing-m",
    },
    Heading {
        text: "Wheelset and track",
        commands: &["contact"],
        options: "gauge-m gauge-depth-m back-to-back-m back-to-datum-m wheel-radius-m inclination",
    },
    Heading {
        text: "Under load",
        commands: &["contact"],
        options: "load-kn lateral-mm yaw-mrad speed-km-h friction",
    },
    Heading {
        text: "Frequencies",
        commands: &["response"],
        options: "from-hz to-hz points swept octaves-per-minute",
    },
    Heading {
        text: "Frame",
        commands: &["benchmark"],
        options: "plants beta1-per-s beta2-per-s2 a3-per-s stiffness-n-per-m",
    },
    Heading {
        text: "Ground",
        commands: &["benchmark"],
        options: "record scale chirp",
    },
    Heading {
        text: "Shims as plates (--fe)",
        commands: &["shims"],
        options: "fe bonded pressure-pa allowable-stress-pa valve loaded-radii-m decay-radii-m decay-exponent bosses \
                  boss-share boss-radius-m hole-radius-m pitch-radius-m",
    },
];

/// Puts the options of a command and of those below it under their headings.
pub fn with_headings(command: Command) -> Command {
    let name = command.get_name().to_owned();
    let command = command.mut_args(|arg| match heading(&name, &arg) {
        Some(text) => arg.help_heading(text),
        None => arg,
    });
    let below: Vec<String> = command
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    below.into_iter().fold(command, |command, name| {
        command.mut_subcommand(name, with_headings)
    })
}

impl Heading {
    fn has(&self, option: &str) -> bool {
        self.options.split(' ').any(|own| own == option)
    }
}

fn heading(command: &str, arg: &Arg) -> Option<&'static str> {
    let option = arg.get_long()?;
    let found = HEADINGS.iter().find(|heading| {
        (heading.commands.is_empty() || heading.commands.contains(&command)) && heading.has(option)
    });
    Some(found?.text)
}

#[cfg(test)]
mod tests {
    use clap::Command;

    use super::HEADINGS;

    /// Names of commands and long names of their options, with those of the commands below.
    fn options(command: &Command, all: &mut Vec<(String, String)>) {
        let longs = command.get_arguments().filter_map(clap::Arg::get_long);
        let name = command.get_name();
        all.extend(longs.map(|long| (name.to_owned(), long.to_owned())));
        for below in command.get_subcommands() {
            options(below, all);
        }
    }

    #[test]
    fn every_option_under_a_heading_exists() {
        let mut all = Vec::new();
        options(&crate::cli::command(), &mut all);
        for heading in HEADINGS {
            for option in heading.options.split(' ') {
                let is_known = |(command, long): &(String, String)| {
                    let of_command =
                        heading.commands.is_empty() || heading.commands.contains(&command.as_str());
                    of_command && long == option
                };
                assert!(all.iter().any(is_known), "{}: --{option}", heading.text);
            }
            for command in heading.commands {
                let is_known =
                    |(name, long): &(String, String)| name == command && heading.has(long);
                assert!(all.iter().any(is_known), "{}: {command}", heading.text);
            }
        }
    }
}
