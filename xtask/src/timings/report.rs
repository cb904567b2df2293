//! The table of `cargo xtask timings`.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::chain::longest;
use super::unit::Unit;

/// Packages below this processor time are summed in one row, in seconds.
const MIN_LISTED_S: f64 = 0.5;

/// Processor time of all crates of a package.
#[derive(Clone, Copy, Default)]
struct PackageTime {
    processor_s: f64,
    is_ours: bool,
}

/// Returns the table with the packages in descending order and the sums. `total_s` is the processor time of the whole
/// build.
pub fn report(units: &[Unit], total_s: f64, wall_s: f64) -> String {
    let mut packages: BTreeMap<&str, PackageTime> = BTreeMap::new();
    for unit in units {
        let package = packages.entry(&unit.package).or_default();
        package.processor_s += unit.processor_s;
        package.is_ours = unit.is_ours;
    }
    let mut rows: Vec<(&str, PackageTime)> = packages.into_iter().collect();
    rows.sort_by(|(_, one), (_, other)| other.processor_s.total_cmp(&one.processor_s));

    let mut text = String::from("processor time, s   package\n");
    let (listed, small): (Vec<_>, Vec<_>) = rows
        .iter()
        .partition(|(_, package)| package.processor_s >= MIN_LISTED_S);
    for (name, package) in listed {
        let owner = if package.is_ours { "  (ours)" } else { "" };
        let _ = writeln!(text, "{:17.1}   {name}{owner}", package.processor_s);
    }
    if !small.is_empty() {
        let small_s: f64 = small.iter().map(|(_, package)| package.processor_s).sum();
        let _ = writeln!(
            text,
            "{small_s:17.1}   {} packages below {MIN_LISTED_S} s each",
            small.len()
        );
    }

    let sum = |is_ours: bool| {
        let own = rows
            .iter()
            .filter(|(_, package)| package.is_ours == is_ours);
        own.fold((0, 0.0), |(count, sum), (_, package)| {
            (count + 1, sum + package.processor_s)
        })
    };
    let ((our_count, our_s), (foreign_count, foreign_s)) = (sum(true), sum(false));
    let other_s = total_s - our_s - foreign_s;
    let chain = longest(units);
    let names: Vec<&str> = chain.units.iter().map(|unit| &*unit.package).collect();
    let _ = write!(
        text,
        "\npackages        {} ({our_count} ours, {foreign_count} foreign)\n\
         processor time  {total_s:.1} s ({our_s:.1} s ours, {foreign_s:.1} s foreign, {other_s:.1} s cargo and \
         build scripts)\n\
         longest chain   {:.1} s of processor time: {}\n\
         wall time       {wall_s:.1} s, for information: it depends on the machine and its load",
        our_count + foreign_count,
        chain.processor_s,
        names.join(", ")
    );
    text
}

#[cfg(test)]
mod tests {
    use super::{Unit, report};

    #[test]
    fn packages_are_in_falling_order_and_summed() {
        let unit = |package: &str, is_ours, processor_s, uses: &[&str]| Unit {
            package: package.into(),
            is_ours,
            name: package.into(),
            uses: uses.iter().map(|name| (*name).to_owned()).collect(),
            processor_s,
            ..Unit::default()
        };
        let units = [
            unit("log 1.0.0", false, 0.25, &[]),
            unit("wide 1.7.1", false, 7.0, &[]),
            unit("ours 0.1.0", true, 2.0, &["wide 1.7.1"]),
            unit("ours 0.1.0", true, 20.5, &[]),
        ];
        let expected = "\
processor time, s   package
             22.5   ours 0.1.0  (ours)
              7.0   wide 1.7.1
              0.2   1 packages below 0.5 s each

packages        3 (1 ours, 2 foreign)
processor time  31.0 s (22.5 s ours, 7.2 s foreign, 1.2 s cargo and build scripts)
longest chain   20.5 s of processor time: ours 0.1.0
wall time       17.0 s, for information: it depends on the machine and its load";
        assert_eq!(report(&units, 31.0, 17.0), expected);
    }
}
