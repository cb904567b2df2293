//! Shows the library a finished file whose blocks do not divide records.
//!
//! The library drops a record that two blocks share if the records of several groups are in one stream. It does not
//! compare the numbers of records with that of the only group, and it trusts the lengths and links of an unfinished
//! file. So the records of such groups get new blocks behind the file, which consist of parts of the file.

use std::fs::File;
use std::io;

use super::blocks::{CYCLE_COUNT, DataGroup, HEADER};
use super::chain::Chain;
use super::records::{Stream, Walk};
use super::stored::Stored;
use super::unfinished::Unfinished;
use super::view::View;
use crate::error::RecordingError;
use crate::notes::UnfinishedEnd;

/// A file as the library sees it, and the end of the records if the file is unfinished.
pub(super) struct Finished {
    pub(super) view: View,
    pub(super) unfinished: Option<UnfinishedEnd>,
}

/// New data of a group.
struct NewData {
    /// Parts of each block.
    blocks: Vec<Vec<(Stored, u64, u64)>>,
    /// Numbers of rows to set, one for each channel group.
    counts: Option<Vec<u64>>,
    left_bytes: u64,
}

impl Finished {
    /// # Errors
    /// The file cannot be read. The inner error says why an unfinished file is refused.
    pub(super) fn new(file: File) -> io::Result<Result<Self, RecordingError>> {
        let mut view = View::new(file)?;
        let unfinished = match Unfinished::of(&view)? {
            Some(Err(error)) => return Ok(Err(error)),
            Some(Ok(unfinished)) => Some(unfinished),
            None => None,
        };
        let mut left_bytes = 0;
        for group in view.data_groups()? {
            if group.data == 0 || !group.has_numbers() && unfinished.is_none() {
                continue;
            }
            let Some(chain) = view.chain(group.data, unfinished.as_ref())? else {
                if unfinished.is_some() {
                    return Ok(Err(RecordingError::Unfinished {
                        reason: "its records are in lists of a kind that cannot be completed"
                            .into(),
                    }));
                }
                continue;
            };
            let Some(data) = NewData::new(&view, &group, &chain, unfinished.as_ref())? else {
                continue;
            };
            left_bytes += data.left_bytes;
            data.add_to(&mut view, &group);
        }
        if unfinished.is_some() {
            Unfinished::hide(&mut view)?;
        }
        Ok(Ok(Self {
            view,
            unfinished: unfinished.map(|_| UnfinishedEnd { left_bytes }),
        }))
    }
}

impl NewData {
    /// Returns the new data of a group; `None` if the library can read the group as it is.
    fn new(
        view: &View,
        group: &DataGroup,
        chain: &Chain,
        unfinished: Option<&Unfinished>,
    ) -> io::Result<Option<Self>> {
        let mut stream = Stream::new(view, &chain.blocks);
        let walk = match (group.has_numbers(), &group.channel_groups[..]) {
            (true, _) => match stream.walk(group) {
                Ok(walk) => walk,
                // The library reports a damaged block.
                Err(_) if unfinished.is_none() => return Ok(None),
                Err(error) => return Err(error),
            },
            (false, [only]) if !only.is_variable_length => {
                let record_bytes = only.record_bytes + u64::from(group.number_bytes);
                match stream.length().checked_div(record_bytes) {
                    Some(rows) => Walk {
                        counts: vec![rows],
                        ends: vec![rows * record_bytes],
                    },
                    None => return Ok(None),
                }
            }
            (false, _) => return Ok(None),
        };
        let mut start = 0;
        let mut blocks = Vec::new();
        for end in &walk.ends {
            blocks.push(stream.parts(start, *end));
            start = *end;
        }
        let has_open_counts = unfinished.is_some_and(Unfinished::has_open_counts);
        Ok(Some(Self {
            blocks,
            left_bytes: chain.left_bytes + (stream.length() - start),
            counts: has_open_counts.then_some(walk.counts),
        }))
    }

    /// Adds the data behind the file and links them to the group.
    fn add_to(self, view: &mut View, group: &DataGroup) {
        let mut links = vec![0];
        for parts in &self.blocks {
            let length: u64 = parts.iter().map(|(.., length)| length).sum();
            links.push(view.add(header(b"##DT", HEADER + length, 0)));
            for (block, from, length) in parts {
                view.add_part(*block, *from, *length);
            }
        }
        // A list of blocks of equal length: the library ignores the length.
        let mut contents = vec![1, 0, 0, 0];
        contents.extend((self.blocks.len() as u32).to_le_bytes());
        contents.extend([0; 8]);
        let length = HEADER + 8 * links.len() as u64 + contents.len() as u64;
        let mut list = header(b"##DL", length, links.len() as u64);
        list.extend(links.iter().flat_map(|link| link.to_le_bytes()));
        list.extend(contents);
        let list = match self.blocks.is_empty() {
            true => 0,
            false => view.add(list),
        };
        view.replace(group.data_link(), list.to_le_bytes());
        for (group, count) in group
            .channel_groups
            .iter()
            .zip(self.counts.iter().flatten())
        {
            view.replace(group.at + CYCLE_COUNT, count.to_le_bytes());
        }
    }
}

fn header(mark: &[u8; 4], length: u64, links: u64) -> Vec<u8> {
    let mut bytes = mark.to_vec();
    bytes.extend([0; 4]);
    bytes.extend(length.to_le_bytes());
    bytes.extend(links.to_le_bytes());
    bytes
}
