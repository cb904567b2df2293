//! Histogram of a run by microseconds, in the layout of `cyclictest --histogram`.

use super::Run;
use crate::timing::Distribution;

/// Returns the histogram of a run as text. After a comment that names the columns, line n begins with n in six digits
/// and has the number of spans of n to n + 1 microseconds for each series. Then follow the total of the counted spans,
/// minimum, mean and maximum (us), and the number of spans of 10 ms and more, which are in no line. A program that
/// reads the output of cyclictest reads it too: a series takes the place of a thread.
///
/// ```
/// use dashpot_realtime::budget::{Run, histogram};
/// use dashpot_realtime::options::RealtimeOptions;
/// use dashpot_realtime::pacing::Pacer;
/// let mut pacer = Pacer::new(1e-4, &RealtimeOptions::default())?;
/// let timing = pacer.wait(0);
/// pacer.finish(timing);
/// let text = histogram(&Run::from(pacer.into_report()));
/// assert!(text.starts_with("# Histogram\n# Columns: us work lateness response\n000000 "));
/// # Ok::<(), dashpot_realtime::RealtimeError>(())
/// ```
pub fn histogram(run: &Run) -> String {
    let column = |number: &dyn Fn(&Distribution) -> u64, digits: usize| {
        let numbers = run.series.iter().map(|series| number(&series.spans));
        let texts: Vec<String> = numbers.map(|number| format!("{number:0digits$}")).collect();
        texts.join("\t")
    };
    let names: Vec<&str> = run.series.iter().map(|series| series.name).collect();
    let lengths = run
        .series
        .iter()
        .map(|series| series.spans.microseconds().counts().len());
    let mut text = format!("# Histogram\n# Columns: us {}\n", names.join(" "));
    for bin in 0..lengths.max().unwrap_or(0) {
        let counts = column(
            &|spans| spans.microseconds().counts().get(bin).copied().unwrap_or(0),
            6,
        );
        text += &format!("{bin:06} {counts}\n");
    }
    let whole_us = |ns: f64| (ns * 1e-3) as u64;
    text += &format!(
        "# Total: {}\n",
        column(&|spans| spans.microseconds().counts().iter().sum(), 9)
    );
    text += &format!(
        "# Min Latencies: {}\n",
        column(&|spans| whole_us(spans.figures().min_ns), 5)
    );
    text += &format!(
        "# Avg Latencies: {}\n",
        column(&|spans| whole_us(spans.figures().mean_ns), 5)
    );
    text += &format!(
        "# Max Latencies: {}\n",
        column(&|spans| whole_us(spans.figures().worst_ns), 5)
    );
    text += &format!(
        "# Histogram Overflows: {}\n",
        column(&|spans| spans.microseconds().beyond(), 5)
    );
    text
}
