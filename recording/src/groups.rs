//! Selection of a displacement and a force that are in different groups of a file, each with its own times.

use super::channels::Channels;
use super::error::RecordingError;
use super::select::{ChannelInfo, SelectedChannel, find, group_number, select, select_in};
use super::unit::Quantity;

/// Selected channels. All are in one group, except that the force may be in another.
pub(super) struct Selection<const N: usize> {
    pub(super) chosen: [SelectedChannel; N],
    /// Time of the force and the position of the force in `chosen`, if it is in another group.
    pub(super) apart: Option<(SelectedChannel, usize)>,
}

/// Selects the channels of `quantities`, the first of which is the time. The group is that of the displacement; the
/// force may be in another group if this group does not have it.
///
/// # Errors
/// Same errors as [`select`].
pub(super) fn select_groups<const N: usize>(
    found: &[ChannelInfo],
    groups: &[String],
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<Selection<N>, RecordingError> {
    let error = match select(found, groups, channels, quantities) {
        Ok(chosen) => {
            return Ok(Selection {
                chosen,
                apart: None,
            });
        }
        Err(error) => error,
    };
    let position = |quantity| quantities.iter().position(|other| *other == quantity);
    let (Some(displacement), Some(force)) =
        (position(Quantity::Displacement), position(Quantity::Force))
    else {
        return Err(error);
    };
    let Some([group, force_group]) = two_groups(found, groups, channels) else {
        return Err(error);
    };
    let own = [Quantity::Time, Quantity::Displacement];
    let [time, shift] = select_in(found, groups, Some(group), channels, own)?;
    let other = [Quantity::Time, Quantity::Force];
    let channels = with_time_of(found, groups, force_group, channels);
    let [force_time, load] = select_in(found, groups, Some(force_group), &channels, other)?;
    let mut chosen = [time; N];
    chosen[displacement] = shift;
    chosen[force] = load;
    Ok(Selection {
        chosen,
        apart: Some((force_time, force)),
    })
}

/// Returns the groups of the displacement and of the force if they differ and each is the only possible one.
fn two_groups(found: &[ChannelInfo], groups: &[String], channels: &Channels) -> Option<[usize; 2]> {
    let wanted = channels.group.as_deref();
    let wanted = wanted
        .map(|group| group_number(group, groups))
        .transpose()
        .ok()?;
    let displacement = find(found, groups, wanted, channels, Quantity::Displacement).ok()?;
    let force = find(found, groups, None, channels, Quantity::Force).ok()?;
    let [group, force_group] = [displacement, force].map(|index| found[index].group);
    // A time that was chosen must be that of the displacement.
    find(found, groups, Some(group), channels, Quantity::Time).ok()?;
    (group != force_group).then_some([group, force_group])
}

/// Returns `channels` with the time of another group: the channel of the chosen name, or else the one by default.
fn with_time_of(
    found: &[ChannelInfo],
    groups: &[String],
    group: usize,
    channels: &Channels,
) -> Channels {
    let mut channels = channels.clone();
    if find(found, groups, Some(group), &channels, Quantity::Time).is_err() {
        channels.time.name = None;
    }
    channels
}
