//! Finds the channels of a recording among those of a file, and their units.

use super::channels::Channels;
use super::error::RecordingError;
use super::unit::{Quantity, Unit};

/// A channel of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ChannelInfo {
    /// Name without the unit; empty if the channel has no name.
    pub(super) name: String,
    /// Name as written in the file, possibly with the unit.
    pub(super) whole: String,
    /// Unit stated in the file; an ending of the name such as `_mm` does not count.
    pub(super) unit: Option<String>,
    /// Index of the channel's group, from 0.
    pub(super) group: usize,
    /// True if the channel contains the times of its group.
    pub(super) is_master: bool,
    /// Type of the values in the file.
    pub(super) kind: String,
    /// True if the values are times with dates, which are read as seconds from the first, whatever unit is chosen.
    pub(super) is_instant: bool,
    /// True if the values can be read as numbers.
    pub(super) is_number: bool,
    /// Reason why the numbers cannot be read: an unsupported width or bit position; `None` if they can be read.
    pub(super) unread: Option<Unread>,
    /// Number of rows, if it is known before reading.
    pub(super) rows: Option<u64>,
}

/// Numbers in an unsupported format.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unread {
    /// Format of the numbers.
    pub(super) held: String,
    /// Supported formats.
    pub(super) allowed: &'static str,
}

/// Channel selected for a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SelectedChannel {
    /// Index among the channels of the file.
    pub(super) index: usize,
    pub(super) unit: Unit,
    pub(super) reversed: bool,
}

impl SelectedChannel {
    /// Converts a number of the file to SI, positive in extension.
    #[inline]
    pub(super) fn in_si(&self, number: f64) -> f64 {
        let value = self.unit.to_si(number);
        if self.reversed { -value } else { value }
    }
}

/// Selects the channels of `quantities` from those `found` in `groups`. The first quantity is the time.
///
/// # Errors
/// Returns an error if a channel is missing or ambiguous, if its unit is unknown, or if the time is in a different
/// group from the values.
pub(super) fn select<const N: usize>(
    found: &[ChannelInfo],
    groups: &[String],
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<[SelectedChannel; N], RecordingError> {
    let wanted = channels
        .group
        .as_deref()
        .map(|group| group_number(group, groups))
        .transpose()?;
    select_in(found, groups, wanted, channels, quantities)
}

/// Same as [`select`], but with the index of the group if it is known.
pub(super) fn select_in<const N: usize>(
    found: &[ChannelInfo],
    groups: &[String],
    mut group: Option<usize>,
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<[SelectedChannel; N], RecordingError> {
    let mut indices = [0; N];
    let mut order: Vec<usize> = (0..N).collect();
    if groups.len() > 1 {
        // Start with the values: the time channel must be in their group.
        order.reverse();
    }
    for position in order {
        let index = find(found, groups, group, channels, quantities[position])?;
        let own = found[index].group;
        indices[position] = index;
        group = Some(own);
    }
    let mut chosen = [SelectedChannel {
        index: 0,
        unit: Quantity::Time.units()[0],
        reversed: false,
    }; N];
    for (position, chosen) in chosen.iter_mut().enumerate() {
        let (quantity, index) = (quantities[position], indices[position]);
        if let Some(other) = indices[..position].iter().position(|other| *other == index) {
            return Err(RecordingError::SameChannel {
                channel: label(found, index),
                first: quantities[other],
                second: quantity,
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
        *chosen = SelectedChannel {
            index,
            unit: unit(&found[index], label(found, index), channels, quantity)?,
            reversed: channels.channel(quantity).reversed,
        };
    }
    Ok(chosen)
}

/// Returns the name of a channel for messages, or its number if it has no name.
pub(super) fn label(found: &[ChannelInfo], index: usize) -> String {
    match found.get(index) {
        Some(found) if !found.name.is_empty() => found.name.clone(),
        _ => (index + 1).to_string(),
    }
}

/// Returns the index of the group with this name or number.
pub(super) fn group_number(group: &str, groups: &[String]) -> Result<usize, RecordingError> {
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

/// Returns the index of the channel of a quantity, in `group` if it is known.
pub(super) fn find(
    found: &[ChannelInfo],
    groups: &[String],
    group: Option<usize>,
    channels: &Channels,
    quantity: Quantity,
) -> Result<usize, RecordingError> {
    let all = || (0..found.len()).filter(|&index| group.is_none_or(|g| found[index].group == g));
    let option = channels.channel(quantity).name.as_deref();
    let name = option.unwrap_or(quantity.column());
    let is_named = |index: &usize| found[*index].name == name || found[*index].whole == name;
    let mut candidates: Vec<usize> = all().filter(is_named).collect();
    if candidates.is_empty() && option.is_none() {
        if quantity == Quantity::Time {
            candidates = all().filter(|&index| found[index].is_master).collect();
        }
        if candidates.is_empty() {
            candidates = all()
                .filter(|&index| has_standard_name(&found[index].name, quantity))
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
                group: group_label(groups, found[index].group),
                expected: group_label(groups, group),
            }),
            _ => Ok(index),
        };
    }
    match candidates[..] {
        [index] => Ok(index),
        [] => {
            let elsewhere = (0..found.len()).find(is_named);
            Err(match (elsewhere, group) {
                (Some(index), Some(group)) => RecordingError::OtherGroup {
                    quantity,
                    channel: label(found, index),
                    group: group_label(groups, found[index].group),
                    expected: group_label(groups, group),
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

/// Returns the index of a channel number such as `2` or `#2`.
fn by_number(text: &str, count: usize) -> Option<usize> {
    let number: usize = text.strip_prefix('#').unwrap_or(text).parse().ok()?;
    number.checked_sub(1).filter(|index| *index < count)
}

/// Returns the number of a group, from 1, and its name for messages.
pub(super) fn group_label(groups: &[String], number: usize) -> String {
    match groups.get(number).map(String::as_str) {
        None | Some("") => (number + 1).to_string(),
        Some(name) => format!("{} ({name})", number + 1),
    }
}

/// True if a channel name consists of the name of the quantity and, optionally, a unit.
fn has_standard_name(name: &str, quantity: Quantity) -> bool {
    let lower = name.to_ascii_lowercase();
    lower == quantity.name()
        || lower
            .strip_prefix(quantity.name())
            .is_some_and(|rest| rest.starts_with('_') && rest.rfind('_') == Some(0))
            && quantity.unit_in_name(name).is_some()
}

fn missing(found: &[ChannelInfo], quantity: Quantity, name: &str) -> RecordingError {
    RecordingError::MissingChannel {
        quantity,
        name: name.to_owned(),
        numbered: found.iter().all(|found| found.name.is_empty()),
        found: found.iter().map(|found| found.whole.clone()).collect(),
    }
}

fn unit(
    found: &ChannelInfo,
    channel: String,
    channels: &Channels,
    quantity: Quantity,
) -> Result<Unit, RecordingError> {
    if found.is_instant && quantity == Quantity::Time {
        return Ok(quantity.units()[0]);
    }
    if let Some(unit) = channels.channel(quantity).unit {
        return Ok(unit);
    }
    let in_name = quantity.unit_in_name(&found.name);
    let stated = found.unit.as_deref().map(bare).filter(|t| !t.is_empty());
    match (stated, in_name) {
        (None, Some(unit)) => Ok(unit),
        (None, None) => Err(RecordingError::NoUnit { quantity, channel }),
        (Some(stated), in_name) => match (quantity.unit(stated), in_name) {
            (Some(unit), Some(in_name)) if unit != in_name => Err(RecordingError::TwoUnits {
                quantity,
                channel,
                unit: stated.to_owned(),
            }),
            (Some(unit), _) => Ok(unit),
            (None, _) => Err(RecordingError::UnknownUnit {
                quantity,
                channel,
                unit: stated.to_owned(),
            }),
        },
    }
}

/// Removes brackets around a unit.
pub(super) fn bare(text: &str) -> &str {
    let text = text.trim();
    let pairs = [('[', ']'), ('(', ')')];
    let inner = pairs
        .into_iter()
        .find_map(|(open, close)| text.strip_prefix(open)?.strip_suffix(close));
    inner.unwrap_or(text).trim()
}
