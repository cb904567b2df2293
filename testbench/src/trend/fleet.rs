//! Trends of all dampers of a fleet, the most urgent first.

use super::axis::Axis;
use super::exchange::steps_back;
use super::fit::{Line, Point};
use super::forecast::{Forecast, Limit};
use super::limits::Limits;
use super::parameter::Parameter;
use super::reading::{Recorded, Refusal};
use super::series::Series;

/// Trend of one parameter.
#[derive(Clone, Debug)]
pub struct Trend {
    /// The parameter.
    pub parameter: Parameter,
    /// Usable readings of the fitted quantity, in order.
    pub points: Vec<Point>,
    /// The line; `None` with too few readings.
    pub line: Option<Line>,
    /// The limit of the fitted quantity.
    pub limit: Option<Limit>,
    /// When the line reaches the limit.
    pub forecast: Option<Forecast>,
    /// Abscissa from which on the readings look like those of a new damper, if there is one.
    pub exchange: Option<f64>,
}

/// Trends of one damper.
#[derive(Clone, Debug)]
pub struct DamperTrends {
    /// What each recording says; not empty.
    pub recorded: Vec<Recorded>,
    /// True if the damper is still installed.
    pub is_installed: bool,
    /// Trends of damping, stiffness and clearance.
    pub trends: [Trend; 3],
    /// Number of recordings after the last trusted one whose readings are in doubt.
    pub doubtful_at_the_end: usize,
}

/// Trends of a fleet.
#[derive(Clone, Debug)]
pub struct Fleet {
    /// What the trends are over.
    pub axis: Axis,
    /// Dampers: installed ones first, the most urgent of these first.
    pub dampers: Vec<DamperTrends>,
    /// Recordings that have no place on the axis.
    pub unplaced: Vec<Recorded>,
}

/// How soon a damper should be looked at; smaller is sooner.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Urgency {
    /// Beyond a limit; the number is the limit over the value, so smaller is further beyond.
    Beyond(f64),
    /// Reaches a limit at this abscissa, within the horizon.
    Reaches(f64),
    /// The last readings are in doubt.
    InDoubt,
    /// No wear seen, or a limit beyond the horizon; the abscissa is the first at which a limit may be reached.
    NotInSight(f64),
    /// Too few readings for a line, or no limit.
    NoTrend,
}

impl Trend {
    fn new(parameter: Parameter, axis: Axis, recorded: &[Recorded], limits: &Limits) -> Self {
        let used = recorded
            .iter()
            .filter(|recorded| recorded.refusal.is_none());
        let points = used.filter_map(|recorded| {
            let (reading, model) = recorded.reading.as_ref()?;
            let estimate = parameter.fitted(reading, model)?;
            Some(Point {
                x: axis.of(&recorded.listed)?,
                y: estimate.value.into(),
                sd: estimate.sd.into(),
            })
        });
        let points: Vec<Point> = points.collect();
        let line = Line::fit(&points);
        let limit = parameter.limit(limits);
        let last = points.last().map(|point| point.x);
        let mut forecast = match (&line, limit, last) {
            (Some(line), Some(limit), Some(last)) => Some(Forecast::new(line, limit, last)),
            _ => None,
        };
        // Before the first reading nobody knows when the limit was crossed.
        let first = points.first().map(|point| point.x);
        if let Some(Forecast::Beyond { since, .. }) = &mut forecast {
            *since = since.filter(|since| first.is_some_and(|first| *since >= first));
        }
        Self {
            exchange: limit.and_then(|limit| steps_back(&points, limit)),
            parameter,
            points,
            line,
            limit,
            forecast,
        }
    }

    /// Returns the abscissa of the last usable reading.
    pub fn last(&self) -> Option<f64> {
        self.points.last().map(|point| point.x)
    }

    /// Returns how urgent the trend is.
    pub fn urgency(&self, axis: Axis) -> Urgency {
        let (Some(forecast), Some(line), Some(limit), Some(last)) =
            (self.forecast, &self.line, self.limit, self.last())
        else {
            return Urgency::NoTrend;
        };
        let horizon = last + axis.horizon().0;
        match forecast {
            Forecast::Beyond { .. } => {
                let over = limit.value / line.at(last).value;
                Urgency::Beyond(if limit.is_upper { over } else { 1.0 / over })
            }
            Forecast::Reached { at, .. } if at <= horizon => Urgency::Reaches(at),
            Forecast::Reached { earliest, .. } => Urgency::NotInSight(earliest),
            Forecast::NotInSight { earliest } => {
                Urgency::NotInSight(earliest.unwrap_or(f64::INFINITY))
            }
        }
    }
}

impl DamperTrends {
    fn new(series: &Series, recorded: Vec<Recorded>, axis: Axis, given: &Limits) -> Option<Self> {
        let kind = series.recordings.first()?.kind;
        let limits = given.or(kind.limits());
        let trends =
            Parameter::ALL.map(|parameter| Trend::new(parameter, axis, &recorded, &limits));
        let from_the_end = recorded.iter().rev();
        let unused = from_the_end.take_while(|recorded| recorded.refusal.is_some());
        let is_doubtful =
            |recorded: &&Recorded| matches!(recorded.refusal, Some(Refusal::Doubtful(_)));
        Some(Self {
            doubtful_at_the_end: unused.filter(is_doubtful).count(),
            recorded,
            is_installed: series.is_installed,
            trends,
        })
    }

    /// Returns how urgent the damper is: as its most urgent trend.
    pub fn urgency(&self, axis: Axis) -> Urgency {
        let own = self.worst(axis).urgency(axis);
        let is_in_doubt = self.doubtful_at_the_end > 0;
        if is_in_doubt && own > Urgency::InDoubt {
            Urgency::InDoubt
        } else {
            own
        }
    }

    /// Returns the most urgent trend.
    pub fn worst(&self, axis: Axis) -> &Trend {
        let [first, others @ ..] = &self.trends;
        let is_sooner = |a: &Trend, b: &Trend| a.urgency(axis) < b.urgency(axis);
        others.iter().fold(first, |worst, other| {
            if is_sooner(other, worst) {
                other
            } else {
                worst
            }
        })
    }

    /// Number of recordings whose reading is used.
    pub fn used(&self) -> usize {
        self.recorded
            .iter()
            .filter(|recorded| recorded.refusal.is_none())
            .count()
    }

    /// Returns the vehicle, the position and the serial number.
    pub fn name(&self) -> [&str; 3] {
        let listed = self.recorded.first().map(|recorded| &recorded.listed);
        listed.map_or([""; 3], |listed| {
            [&*listed.vehicle, &*listed.damper, &*listed.serial_number]
        })
    }

    /// Returns the kind of the damper.
    pub fn kind(&self) -> super::limits::Kind {
        self.recorded
            .first()
            .map(|recorded| recorded.listed.kind)
            .unwrap_or_default()
    }
}

impl Fleet {
    /// Fits the trends of all series and sorts them; `limits` has those that replace the limits of each kind.
    pub fn assess(
        axis: Axis,
        series: &[Series],
        recorded: Vec<Vec<Recorded>>,
        unplaced: Vec<Recorded>,
        limits: &Limits,
    ) -> Self {
        let dampers = series.iter().zip(recorded);
        let dampers = dampers
            .filter_map(|(series, recorded)| DamperTrends::new(series, recorded, axis, limits));
        let mut dampers: Vec<DamperTrends> = dampers.collect();
        dampers.sort_by(|a, b| {
            let by_urgency = a.urgency(axis).partial_cmp(&b.urgency(axis));
            b.is_installed
                .cmp(&a.is_installed)
                .then(by_urgency.unwrap_or(std::cmp::Ordering::Equal))
        });
        Self {
            axis,
            dampers,
            unplaced,
        }
    }

    /// Returns all recordings, damper by damper.
    pub fn recorded(&self) -> impl Iterator<Item = &Recorded> {
        let of_dampers = self.dampers.iter().flat_map(|damper| &damper.recorded);
        of_dampers.chain(&self.unplaced)
    }

    /// Returns the recordings that are not used, each with its reason.
    pub fn refused(&self) -> impl Iterator<Item = (&Recorded, &Refusal)> {
        self.recorded()
            .filter_map(|recorded| Some((recorded, recorded.refusal.as_ref()?)))
    }

    /// Number of files that cannot be read.
    pub fn unreadable(&self) -> usize {
        let unreadable =
            |(_, refusal): &(&Recorded, &Refusal)| matches!(refusal, Refusal::Unreadable(_));
        self.refused().filter(unreadable).count()
    }
}
