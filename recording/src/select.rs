//! Which of the channels that a file has are those of a recording, and in which units.

use super::channels::Channels;
use super::error::RecordingError;
use super::unit::{Quantity, Unit};

/// A channel that a file has.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Its name, without the unit; empty where the file has none.
    pub(super) name: String,
    /// Name and unit as the file has them in one text, else the name.
    pub(super) whole: String,
    /// Its unit, where the file tells it outside of the name.
    pub(super) unit: Option<String>,
    /// Number of its group, from 0.
    pub(super) group: usize,
    /// Whether the time of its group.
    pub(super) is_master: bool,
    /// What its values are in the file.
    pub(super) kind: String,
    /// Whether they can be read as numbers.
    pub(super) is_number: bool,
    /// Why they are not, where they are numbers of another width or at another place than is read.
    pub(super) unread: Option<Unread>,
    /// Rows, where the file tells before they are read.
    pub(super) rows: Option<u64>,
}

/// Numbers that are not read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unread {
    /// What they are.
    pub(super) held: String,
    /// What is read instead.
    pub(super) allowed: &'static str,
}

/// A channel that was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chosen {
    /// Which of those found.
    pub(super) index: usize,
    pub(super) unit: Unit,
    pub(super) reversed: bool,
}

impl Chosen {
    /// A number of the file in SI, positive in extension.
    #[inline]
    pub(super) fn in_si(&self, number: f64) -> f64 {
        let value = self.unit.to_si(number);
        if self.reversed { -value } else { value }
    }
}

/// The channels of `quantities`, which begin with the time, among those `found` in `groups`.
///
/// # Errors
/// One is missing, there are several, or its unit is not known; a time in another group than the values.
pub(super) fn select<const N: usize>(
    found: &[Found],
    groups: &[String],
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<[Chosen; N], RecordingError> {
    let wanted = channels
        .group
        .as_deref()
        .map(|group| group_number(group, groups))
        .transpose()?;
    select_in(found, groups, wanted, channels, quantities)
}

/// As [`select`], in a group.
pub(super) fn select_in<const N: usize>(
    found: &[Found],
    groups: &[String],
    mut group: Option<usize>,
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<[Chosen; N], RecordingError> {
    let mut indices = [0; N];
    let mut order: Vec<usize> = (0..N).collect();
    if groups.len() > 1 {
        // The time is that of the values' group.
        order.reverse();
    }
    for place in order {
        let index = find(found, groups, group, channels, quantities[place])?;
        let own = found[index].group;
        indices[place] = index;
        group = Some(own);
    }
    let mut chosen = [Chosen {
        index: 0,
        unit: Quantity::Time.units()[0],
        reversed: false,
    }; N];
    for (place, chosen) in chosen.iter_mut().enumerate() {
        let (quantity, index) = (quantities[place], indices[place]);
        if let Some(other) = indices[..place].iter().position(|other| *other == index) {
            return Err(RecordingError::SameChannel {
                channel: label(found, index),
                quantities: [quantities[other], quantity],
            });
        }
        if let Some(Unread { held, allowed }) = &found[index].unread {
            return Err(RecordingError::Width {
                quantity,
                channel: label(found, index),
                held: held.clone(),
                allowed,
            });
        }
        if !found[index].is_number {
            return Err(RecordingError::NoNumbers {
                quantity,
                channel: label(found, index),
                kind: found[index].kind.clone(),
            });
        }
        *chosen = Chosen {
            index,
            unit: unit(&found[index], label(found, index), channels, quantity)?,
            reversed: channels.of(quantity).reversed,
        };
    }
    Ok(chosen)
}

/// What messages call the channel of an index.
pub(super) fn label(found: &[Found], index: usize) -> String {
    match found.get(index) {
        Some(found) if !found.name.is_empty() => found.name.clone(),
        _ => (index + 1).to_string(),
    }
}

fn group_number(group: &str, groups: &[String]) -> Result<usize, RecordingError> {
    let mut named = (0..groups.len()).filter(|number| groups[*number] == group);
    if let (Some(number), None) = (named.next(), named.next()) {
        return Ok(number);
    }
    match group.parse::<usize>() {
        Ok(number) if (1..=groups.len()).contains(&number) => Ok(number - 1),
        _ => Err(RecordingError::Group {
            group: group.to_owned(),
            groups: groups.to_vec(),
        }),
    }
}

fn find(
    found: &[Found],
    groups: &[String],
    group: Option<usize>,
    channels: &Channels,
    quantity: Quantity,
) -> Result<usize, RecordingError> {
    let all = || (0..found.len()).filter(|&index| group.is_none_or(|g| found[index].group == g));
    let option = channels.of(quantity).name.as_deref();
    let name = option.unwrap_or(quantity.column());
    let mut candidates: Vec<usize> = all()
        .filter(|&index| found[index].name == name || found[index].whole == name)
        .collect();
    if candidates.is_empty() && option.is_none() {
        if quantity == Quantity::Time {
            candidates = all().filter(|&index| found[index].is_master).collect();
        }
        if candidates.is_empty() {
            candidates = all()
                .filter(|&index| is_called(&found[index].name, quantity))
                .collect();
        }
    }
    let numbered = option.and_then(|option| by_number(option, found.len()));
    if let (Some(index), Some(option)) = (numbered, option)
        && !option.starts_with('#')
        && !candidates.is_empty()
        && candidates != [index]
    {
        return Err(RecordingError::NameOrNumber {
            quantity,
            text: option.to_owned(),
            named: candidates[0] + 1,
        });
    }
    if let Some(index) = numbered {
        return match group {
            Some(group) if group != found[index].group => Err(RecordingError::OtherGroup {
                quantity,
                channel: label(found, index),
                groups: [found[index].group, group].map(|g| group_label(groups, g)),
            }),
            _ => Ok(index),
        };
    }
    match candidates[..] {
        [index] => Ok(index),
        [] => {
            let elsewhere =
                (0..found.len()).find(|&i| found[i].name == name || found[i].whole == name);
            Err(match (elsewhere, group) {
                (Some(index), Some(group)) => RecordingError::OtherGroup {
                    quantity,
                    channel: label(found, index),
                    groups: [found[index].group, group].map(|g| group_label(groups, g)),
                },
                _ => missing(found, quantity, name),
            })
        }
        [first, ..] => {
            let same_group = candidates
                .iter()
                .all(|index| found[*index].group == found[first].group);
            let same_name = candidates
                .iter()
                .all(|index| found[*index].whole == found[first].whole);
            Err(if !same_group {
                RecordingError::SeveralGroups {
                    channel: label(found, first),
                    groups: candidates
                        .iter()
                        .map(|index| group_label(groups, found[*index].group))
                        .collect(),
                }
            } else if same_name {
                RecordingError::RepeatedColumn {
                    column: label(found, first),
                    times: candidates.len(),
                }
            } else {
                RecordingError::SeveralChannels {
                    quantity,
                    channels: candidates
                        .iter()
                        .map(|index| found[*index].whole.clone())
                        .collect(),
                }
            })
        }
    }
}

/// The index that `2` or `#2` is the number of.
fn by_number(text: &str, count: usize) -> Option<usize> {
    let number: usize = text.strip_prefix('#').unwrap_or(text).parse().ok()?;
    number.checked_sub(1).filter(|index| *index < count)
}

fn group_label(groups: &[String], number: usize) -> String {
    match groups.get(number).map(String::as_str) {
        None | Some("") => (number + 1).to_string(),
        Some(name) => format!("{} ({name})", number + 1),
    }
}

/// Whether a name tells the quantity, and no more than its unit beside it.
fn is_called(name: &str, quantity: Quantity) -> bool {
    let lower = name.to_ascii_lowercase();
    lower == quantity.name()
        || lower
            .strip_prefix(quantity.name())
            .is_some_and(|rest| rest.starts_with('_') && rest.rfind('_') == Some(0))
            && quantity.unit_in_name(name).is_some()
}

fn missing(found: &[Found], quantity: Quantity, name: &str) -> RecordingError {
    RecordingError::MissingChannel {
        quantity,
        name: name.to_owned(),
        numbered: found.iter().all(|found| found.name.is_empty()),
        found: found.iter().map(|found| found.whole.clone()).collect(),
    }
}

fn unit(
    found: &Found,
    channel: String,
    channels: &Channels,
    quantity: Quantity,
) -> Result<Unit, RecordingError> {
    if let Some(unit) = channels.of(quantity).unit {
        return Ok(unit);
    }
    let in_name = quantity.unit_in_name(&found.name);
    let told = found.unit.as_deref().map(bare).filter(|t| !t.is_empty());
    match (told, in_name) {
        (None, Some(unit)) => Ok(unit),
        (None, None) => Err(RecordingError::NoUnit { quantity, channel }),
        (Some(told), in_name) => match (quantity.unit(told), in_name) {
            (Some(unit), Some(in_name)) if unit != in_name => Err(RecordingError::TwoUnits {
                quantity,
                channel,
                unit: told.to_owned(),
            }),
            (Some(unit), _) => Ok(unit),
            (None, _) => Err(RecordingError::UnknownUnit {
                quantity,
                channel,
                unit: told.to_owned(),
            }),
        },
    }
}

/// The unit without brackets.
pub(super) fn bare(text: &str) -> &str {
    let text = text.trim();
    let pairs = [('[', ']'), ('(', ')')];
    let inner = pairs
        .into_iter()
        .find_map(|(open, close)| text.strip_prefix(open)?.strip_suffix(close));
    inner.unwrap_or(text).trim()
}
