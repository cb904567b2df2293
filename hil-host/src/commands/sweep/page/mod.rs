//! HTML page of a study.

mod dampers;
mod heat;
mod index;
mod indices;
mod response;
mod signal;
mod words;

use maud::{Markup, html};

use super::report::Report;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::progress;
use dashpot_files::did_you_mean;
use dashpot_files::study::{Figure, FigureContent, Sweep};
use dashpot_report::page::{document, footer, tiles};
use dashpot_study::sweep::curves::{Curve, CurveKey, Curves};
use dashpot_study::sweep::rows::Rows;
use dashpot_study::sweep::{Finished, Observed, Shared, Study, VERSION};

/// Height of a panel (pixels).
const HEIGHT: u32 = 260;

/// A study with its rows and curves.
struct Drawn<'a> {
    study: &'a Study,
    rows: &'a Rows,
    curves: &'a Curves,
}

/// Checks the signals and dampers of a study's figures, so that errors appear before hours of runs.
///
/// # Errors
/// A signal or damper does not exist, or a value is invalid.
pub(super) fn check(study: &Study, shared: &Shared) -> Outcome<()> {
    for figure in &study.parameters.figures {
        for name in figure.content.sweeps() {
            let Some(sweep) = study.parameters.sweep(name) else {
                continue;
            };
            let names = match &figure.content {
                FigureContent::Indices { .. } => continue,
                FigureContent::Dampers { dampers, .. } => {
                    let keys = dampers
                        .iter()
                        .flat_map(|name| study.damper_keys(sweep, name));
                    keys.map(|key| key.signal).collect()
                }
                FigureContent::Signal { signal, .. } => vec![signal.clone()],
                FigureContent::Response { damper, .. } => {
                    let case = study.case_with(sweep, None, None)?;
                    if case.damper(damper).is_none() {
                        let names = case.vehicle.dampers().map(|element| element.name.as_str());
                        let hint = did_you_mean(damper, names);
                        return Err(Failure::new(format!(
                            "figure of sweep {name}: no damper `{damper}`{hint}"
                        )));
                    }
                    continue;
                }
            };
            study.check_signals(sweep, &names, shared)?;
        }
    }
    Ok(())
}

/// Returns the study as HTML; draws its figures on a pool of `threads` threads.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(
    study: &Study,
    finished: &Finished,
    report: &Report,
    threads: usize,
) -> Outcome<String> {
    let drawn = Drawn {
        study,
        rows: &finished.rows,
        curves: &finished.curves,
    };
    let figures = &study.parameters.figures;
    let bar = progress::bar(figures.len() as u64, "figures");
    let mut parts: Vec<Markup> = figures.iter().map(|_| html! {}).collect();
    let draw = |figure: &Figure, _: &dyn Fn() -> bool| drawn.part(figure);
    dashpot_workers::in_parallel(figures, threads, draw, |number, part| -> Outcome<()> {
        parts[number] = part?;
        bar.inc(1);
        Ok(())
    })?;
    bar.finish_and_clear();
    let body = html! {
        h1 { (study.parameters.name) }
        @if study.parameters.sweeps.iter().any(|sweep| sweep.seeds.len() > 1) {
            p.lead {
                "Points are means over seeds of the track irregularity, bars are 95 % confidence intervals, and pale "
                "lines are individual seeds. All points use the same seeds, so differences between points are more "
                "certain than the bars suggest."
            }
        }
        (headline(study))
        @for note in &report.warnings {
            div.note { p { (note) } }
        }
        @if let Some(note) = report.not_completed() {
            div.note { p { (note) } }
        }
        @for (figure, part) in figures.iter().zip(&parts) {
            h2 { (figure.title) }
            (part)
        }
        h2 { "Cases" }
        (cases(study))
        (footer(&html! {
            "Study " (study.digest()) ", version " (VERSION) ", physics " (report.physics) ". "
            "rows.csv contains every case with its seed and the raw names of parameters and indices; the column "
            "`ending` gives the reason for its end."
        }))
    };
    Ok(document(
        &format!("Dashpot: {}", study.parameters.name),
        &body,
    ))
}

impl Drawn<'_> {
    fn part(&self, figure: &Figure) -> Outcome<Markup> {
        let sweep = |name: &String| -> Outcome<&Sweep> {
            let sweep = self.study.parameters.sweep(name);
            sweep.ok_or_else(|| Failure::new(format!("no sweep `{name}`")))
        };
        let caption = &figure.caption;
        match &figure.content {
            FigureContent::Indices {
                sweeps,
                observed,
                factors,
                changes,
            } => {
                let sweeps: Outcome<Vec<&Sweep>> = sweeps.iter().map(sweep).collect();
                let index = |(at, name): (usize, &String)| {
                    Some(index::Index {
                        number: self.number(name)?,
                        factor: factors.get(at).copied(),
                    })
                };
                let observed: Vec<_> = observed.iter().enumerate().filter_map(index).collect();
                indices::part(self, &sweeps?, &observed, *changes, caption)
            }
            FigureContent::Dampers {
                sweep: name,
                dampers,
            } => dampers::part(self, sweep(name)?, dampers, caption),
            FigureContent::Signal {
                sweep: name,
                values,
                signal,
            } => signal::part(self, sweep(name)?, values, signal, caption),
            FigureContent::Response {
                sweep: name,
                values,
                damper,
                amplitude_m,
            } => response::part(self, sweep(name)?, values, (damper, *amplitude_m), caption),
        }
    }

    /// Returns a curve.
    fn curve(&self, key: &CurveKey) -> Outcome<&Curve> {
        let CurveKey { case, signal, .. } = key;
        let curve = self.curves.get(key);
        curve.ok_or_else(|| Failure::new(format!("case {case}: no curve of `{signal}`")))
    }

    /// Returns the position of an observed index.
    fn number(&self, name: &str) -> Option<usize> {
        let observed = self.study.observed.iter();
        observed
            .enumerate()
            .find_map(|(number, index): (usize, &Observed)| (index.name == name).then_some(number))
    }

    /// Returns the observed values of an index at a point of a sweep, one per seed.
    fn seed_values(&self, sweep: &Sweep, point: u64, index: usize) -> Vec<Option<f64>> {
        let numbers = self.study.numbers(sweep, point);
        let observed = |number| self.rows.get(&number)?.observed.get(index).copied()?;
        numbers.map(observed).collect()
    }
}

fn headline(study: &Study) -> Markup {
    let seeds = study
        .parameters
        .sweeps
        .iter()
        .map(|sweep| sweep.seeds.len());
    let mut facts = vec![
        (html! { (study.cases()) }, "cases".to_owned()),
        (
            html! { (study.parameters.sweeps.len()) },
            match study.parameters.sweeps.len() {
                1 => "parameter sweep".to_owned(),
                _ => "parameter sweeps".to_owned(),
            },
        ),
    ];
    if let Some(max) = seeds.max().filter(|max| *max > 0) {
        facts.push((html! { (max) }, "seeds of the irregularity".to_owned()));
    }
    tiles(&facts)
}

/// Tabulates the cases.
fn cases(study: &Study) -> Markup {
    html! {
        div.wide.worded { table {
            tr { th { "sweep" } th.text { "case" } th.text { "varied" } th.text { "values" } th { "seeds" } }
            @for sweep in &study.parameters.sweeps {
                tr {
                    td { (sweep.name) }
                    td.text {
                        @match &sweep.case.name {
                            Some(name) => (name),
                            None => { (sweep.case.vehicle) " on " (sweep.case.track) }
                        }
                    }
                    td.text { @for axis in &sweep.axes { (words::of_axis(axis)) br; } }
                    td.text {
                        @for axis in &sweep.axes {
                            @let values = axis.values.iter().map(|value| words::in_unit(axis, value));
                            (values.collect::<Vec<_>>().join(", ")) br;
                        }
                    }
                    td { (sweep.seeds.len()) }
                }
            }
        } }
    }
}
