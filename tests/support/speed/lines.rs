//! Lines of the table of speeds.

/// A figure beside its yardstick.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// What is measured.
    pub what: &'static str,
    /// Our figure.
    pub ours: Source,
    /// What it is compared with.
    pub yardstick: Yardstick,
    /// Goal; `None` for a line that only informs.
    pub goal: Option<Goal>,
}

/// A figure that ours is divided by.
#[derive(Clone, Copy, Debug)]
pub struct Yardstick {
    /// Its name.
    pub name: &'static str,
    /// Its figure.
    pub source: Source,
}

/// Where a figure comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Median time of an element of a criterion bench, s.
    Time {
        /// Group of the bench.
        group: &'static str,
        /// Function of the group.
        function: &'static str,
    },
    /// Instructions on an emulated processor, from `cargo xtask target`.
    Target {
        /// Column of `tests/support/target_budget.csv`.
        processor: &'static str,
        /// Row of that file.
        figure: &'static str,
    },
    /// Instructions of one of the thousand steps that Valgrind counts in a function of `benches/instructions.rs`.
    Counted(&'static str),
    /// Instructions counted in an earlier version, which no longer runs.
    Instructions(f64),
    /// A time that is given, s.
    Seconds(f64),
}

/// A goal, reached by figures up to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Ours divided by the yardstick.
    Ratio(f64),
    /// Ours, in s or instructions.
    Figure(f64),
}

const fn time(group: &'static str, function: &'static str) -> Source {
    Source::Time { group, function }
}

const fn step_on(processor: &'static str) -> Source {
    let figure = "physical_most_instructions";
    Source::Target { processor, figure }
}

const fn portable_c_on(processor: &'static str) -> Yardstick {
    let figure = "standalone_most_instructions";
    Yardstick {
        name: "portable C",
        source: Source::Target { processor, figure },
    }
}

/// A step of the paper's damper, the yardstick of figures on the same machine.
const STEP: Source = time("step", "paper f32");
const A_STEP: Yardstick = Yardstick {
    name: "a step",
    source: STEP,
};

/// Lines of the table, in the order of docs/performance.md.
pub const LINES: [Line; 15] = [
    Line {
        what: "step of a damper, f32",
        ours: STEP,
        yardstick: Yardstick {
            name: "plain Newton step",
            source: time("step", "yardstick: plain Newton f32"),
        },
        goal: Some(Goal::Ratio(0.37)),
    },
    Line {
        what: "bank of 16, f32, AVX2, a damper",
        ours: time("step", "paper f32, bank of 16, AVX2"),
        yardstick: A_STEP,
        goal: Some(Goal::Ratio(0.13)),
    },
    Line {
        what: "bank of 16, f32, SSE2, a damper",
        ours: time("step", "paper f32, bank of 16, SSE2"),
        yardstick: A_STEP,
        goal: Some(Goal::Ratio(0.15)),
    },
    Line {
        what: "step on a Cortex-M7",
        ours: step_on("cortex_m7"),
        yardstick: portable_c_on("cortex_m7"),
        goal: Some(Goal::Figure(140.0)),
    },
    Line {
        what: "step on a Cortex-M33",
        ours: step_on("cortex_m33"),
        yardstick: portable_c_on("cortex_m33"),
        goal: Some(Goal::Figure(155.0)),
    },
    Line {
        what: "step on a Cortex-M4F",
        ours: step_on("cortex_m4f"),
        yardstick: portable_c_on("cortex_m4f"),
        goal: Some(Goal::Figure(180.0)),
    },
    Line {
        what: "tick of the locomotive, straight of class 6",
        ours: Source::Counted("locomotive.straight_of_class_6"),
        yardstick: earlier_tick(294_800.0),
        goal: Some(Goal::Ratio(0.5)),
    },
    Line {
        what: "tick of the locomotive, curve of 600 m",
        ours: Source::Counted("locomotive.curve_of_600_m"),
        yardstick: earlier_tick(307_200.0),
        goal: Some(Goal::Ratio(0.5)),
    },
    Line {
        what: "tick of the locomotive, curve of 300 m",
        ours: time("vehicle", "curve of 300 m"),
        yardstick: Yardstick {
            name: "real time",
            source: Source::Seconds(1e-3),
        },
        goal: None,
    },
    Line {
        what: "contact of six wheelsets",
        ours: time("vehicle", "contact"),
        yardstick: Yardstick {
            name: "a tick",
            source: time("vehicle", "curve of 300 m"),
        },
        goal: None,
    },
    Line {
        what: "tick of a case of Fig. 12, with its indices",
        ours: time("figures", "case of Fig. 12a"),
        yardstick: Yardstick {
            name: "real time",
            source: Source::Seconds(1e-3),
        },
        goal: None,
    },
    Line {
        what: "constants of a damper, one chamber",
        ours: time("build", "paper f32"),
        yardstick: A_STEP,
        goal: Some(Goal::Figure(0.1e-3)),
    },
    Line {
        what: "constants of a damper, in service",
        ours: time("build", "in-service f32"),
        yardstick: A_STEP,
        goal: Some(Goal::Figure(0.1e-3)),
    },
    Line {
        what: "constants of a damper, two chambers",
        ours: time("build", "in-service, two chambers f32"),
        yardstick: A_STEP,
        goal: Some(Goal::Figure(1e-3)),
    },
    Line {
        what: "row of CSV, read",
        ours: time("replay, a row", "CSV: read"),
        yardstick: Yardstick {
            name: "a step",
            source: time("replay, a row", "step alone"),
        },
        goal: Some(Goal::Ratio(0.75)),
    },
];

/// A tick on elastic rails before the locomotive was made faster.
const fn earlier_tick(instructions: f64) -> Yardstick {
    Yardstick {
        name: "a tick before",
        source: Source::Instructions(instructions),
    }
}
