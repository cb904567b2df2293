//! The longest chain of crates that must be compiled one after the other.

use std::collections::BTreeMap;

use super::unit::Unit;

/// Longest chain that ends with a given unit.
#[derive(Clone, Debug, Default)]
pub struct Chain<'a> {
    /// Processor time of all its units, in seconds.
    pub processor_s: f64,
    /// Units in the order of compilation.
    pub units: Vec<&'a Unit>,
}

/// Returns the chain with the most processor time. Cargo starts a crate as soon as the crates it uses have been
/// checked, before they are optimised, so a build can take less wall time than this.
pub fn longest(units: &[Unit]) -> Chain<'_> {
    let mut found = BTreeMap::new();
    let chains = (0..units.len()).map(|index| ending_with(units, index, &mut found));
    chains
        .max_by(|one, other| one.processor_s.total_cmp(&other.processor_s))
        .unwrap_or_default()
}

fn ending_with<'a>(
    units: &'a [Unit],
    index: usize,
    found: &mut BTreeMap<usize, Chain<'a>>,
) -> Chain<'a> {
    if let Some(chain) = found.get(&index) {
        return chain.clone();
    }
    let unit = &units[index];
    let is_before = |other: &Unit| {
        let is_script =
            unit.needs_build_script && other.is_build_script && other.package == unit.package;
        unit.uses.contains(&other.name) || is_script
    };
    let before = (0..units.len()).filter(|other| is_before(&units[*other]));
    let before: Vec<usize> = before.collect();
    let chains = before
        .into_iter()
        .map(|other| ending_with(units, other, found));
    let mut chain = chains
        .max_by(|one, other| one.processor_s.total_cmp(&other.processor_s))
        .unwrap_or_default();
    chain.processor_s += unit.processor_s;
    chain.units.push(unit);
    found.insert(index, chain.clone());
    chain
}

#[cfg(test)]
mod tests {
    use super::{Unit, longest};

    #[test]
    fn the_chain_follows_crates_and_build_scripts() {
        let unit = |name: &str, uses: &[&str], processor_s| Unit {
            package: name.split('-').next().unwrap_or_default().into(),
            name: name.into(),
            uses: uses.iter().map(|name| (*name).to_owned()).collect(),
            processor_s,
            ..Unit::default()
        };
        let mut units = [
            unit("program-1", &["wide-1", "log-1"], 5.0),
            unit("log-1", &[], 6.0),
            unit("wide-1", &["bytes-1"], 2.0),
            unit("bytes-1", &[], 3.0),
            unit("wide-2", &[], 4.5),
        ];
        let names = |units: &[Unit]| {
            let chain = longest(units);
            let names = chain.units.iter().map(|unit| unit.name.clone());
            (chain.processor_s, names.collect::<Vec<_>>().join(" "))
        };
        assert_eq!(names(&units), (11.0, "log-1 program-1".into()));
        units[2].needs_build_script = true;
        units[4].is_build_script = true;
        assert_eq!(names(&units), (11.5, "wide-2 wide-1 program-1".into()));
        assert_eq!(names(&[]), (0.0, String::new()));
    }
}
