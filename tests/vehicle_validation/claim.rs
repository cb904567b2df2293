//! Claims of the paper about an index, and verdicts on them from our rows.

use dashpot_study::sweep::Estimate;

use crate::rows::interval;

/// A claim about an index as a function of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Claim {
    /// It rises by more than [`NONE_PERCENT`].
    Rises,
    /// It rises, however little.
    RisesSlightly,
    /// It falls, however little.
    FallsSlightly,
    /// It changes by this amount (%): in this direction, and by at least [`SIZE`] of it.
    By(f64),
    /// It does not change.
    Keeps,
    /// It is flat above a value: the magnitude of its slope there is less than a quarter of the slope below.
    Flat,
    /// It changes in either direction.
    Changes,
    /// It fluctuates within limits.
    Limited,
}

/// Verdict on a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Holds,
    /// The confidence interval includes both signs.
    NotShown,
    DoesNotHold,
}

/// Share of a published amount that a change must reach.
pub const SIZE: f64 = 0.25;

/// Maximum ratio of the slope of a flat part to the slope before it.
pub const FLAT: f64 = 0.25;

/// Verdict on flatness from the slopes before and after a point, and half the confidence interval of the latter.
pub fn flat(before: f64, after: f64, half: f64) -> Verdict {
    let bound = FLAT * before.abs();
    if after.abs() + half < bound {
        Verdict::Holds
    } else if after.abs() - half > bound {
        Verdict::DoesNotHold
    } else {
        Verdict::NotShown
    }
}

/// Maximum change that counts as no change (%).
pub const NONE_PERCENT: f64 = 1.0;
/// Maximum range of a limited fluctuation, relative to the mean (%).
pub const LIMITED_PERCENT: f64 = 5.0;

impl Claim {
    /// Parses the claims of a cell of `vehicle_trends.csv`, separated by `and`.
    pub fn parse(words: &str) -> Vec<Self> {
        words.split(" and ").map(Self::one).collect()
    }

    fn one(words: &str) -> Self {
        if let Some(percent) = words.strip_suffix(" %") {
            return Self::By(percent.parse().expect("a percentage"));
        }
        let starts = |known: &[&str]| known.iter().any(|known| words.starts_with(known));
        if starts(&["rises slightly"]) {
            Self::RisesSlightly
        } else if starts(&["rises"]) {
            Self::Rises
        } else if starts(&["slightly falls"]) {
            Self::FallsSlightly
        } else if starts(&["is flat", "hardly changes above"]) {
            Self::Flat
        } else if starts(&["hardly changes", "no obvious", "almost no"]) {
            Self::Keeps
        } else if starts(&["is influenced"]) {
            Self::Changes
        } else if starts(&["limited fluctuation"]) {
            Self::Limited
        } else {
            panic!("unknown claim: `{words}`")
        }
    }

    /// Returns the verdict for a change in percent.
    pub fn verdict(self, change: &Estimate) -> Verdict {
        let [low, high] = interval(change);
        let signed = |sign: f64| {
            let [low, high] = if sign > 0.0 {
                [low, high]
            } else {
                [-high, -low]
            };
            match (low > 0.0, high < 0.0) {
                (true, _) => Verdict::Holds,
                (_, true) => Verdict::DoesNotHold,
                _ => Verdict::NotShown,
            }
        };
        let is_none = low > -NONE_PERCENT && high < NONE_PERCENT;
        match self {
            Self::Rises | Self::Changes if is_none => Verdict::DoesNotHold,
            Self::Rises | Self::RisesSlightly => signed(1.0),
            Self::FallsSlightly => signed(-1.0),
            Self::By(percent) if (SIZE * percent.abs()) > high.max(-low) => Verdict::DoesNotHold,
            Self::By(percent) => signed(percent),
            Self::Keeps if is_none => Verdict::Holds,
            Self::Keeps if low > NONE_PERCENT || high < -NONE_PERCENT => Verdict::DoesNotHold,
            Self::Changes if low > 0.0 || high < 0.0 => Verdict::Holds,
            Self::Limited if low > -LIMITED_PERCENT && high < LIMITED_PERCENT => Verdict::Holds,
            Self::Limited => Verdict::DoesNotHold,
            Self::Keeps | Self::Changes => Verdict::NotShown,
            Self::Flat => panic!("a slope is compared with another"),
        }
    }
}

impl Verdict {
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::NotShown => "not shown",
            Self::DoesNotHold => "**does not hold**",
        }
    }
}

#[test]
fn verdicts_follow_the_interval() {
    let change = |mean: f64, half: f64| Estimate {
        mean,
        confidence: Some(half),
        count: 8,
    };
    for (words, of, expected) in [
        ("rises with C", change(2.0, 1.0), Verdict::Holds),
        ("rises with C", change(1.0, 2.0), Verdict::NotShown),
        ("rises with C", change(-2.0, 1.0), Verdict::DoesNotHold),
        ("-2.94 %", change(-5.0, 1.0), Verdict::Holds),
        ("-2.94 %", change(5.0, 1.0), Verdict::DoesNotHold),
        ("-2.94 %", change(-0.3, 0.2), Verdict::DoesNotHold),
        ("-2.94 %", change(-0.5, 0.4), Verdict::Holds),
        ("hardly changes", change(0.2, 0.5), Verdict::Holds),
        ("hardly changes", change(0.2, 0.9), Verdict::NotShown),
        ("hardly changes", change(3.0, 0.9), Verdict::DoesNotHold),
        ("slightly falls", change(-3.0, 0.9), Verdict::Holds),
        ("is influenced", change(0.1, 0.2), Verdict::DoesNotHold),
        ("is influenced", change(0.5, 0.8), Verdict::NotShown),
        ("rises remarkably", change(0.4, 0.3), Verdict::DoesNotHold),
        ("rises slightly", change(0.4, 0.3), Verdict::Holds),
        ("limited fluctuation", change(4.0, 0.2), Verdict::Holds),
        (
            "limited fluctuation",
            change(6.0, 0.2),
            Verdict::DoesNotHold,
        ),
    ] {
        let [claim] = Claim::parse(words)[..] else {
            panic!("one claim: {words}");
        };
        assert_eq!(claim.verdict(&of), expected, "{words}");
    }
    let both = Claim::parse("rises with Vr and is flat above 0.05 m/s");
    assert_eq!(both, [Claim::Rises, Claim::Flat]);
}

#[test]
fn flat_means_at_most_a_quarter_of_the_slope_before() {
    assert_eq!(flat(-8.0, 1.0, 0.5), Verdict::Holds);
    assert_eq!(flat(-8.0, 1.8, 0.5), Verdict::NotShown);
    assert_eq!(flat(8.0, 3.0, 0.5), Verdict::DoesNotHold);
}
