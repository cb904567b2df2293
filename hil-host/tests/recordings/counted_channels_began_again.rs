//! Regression: virtual MDF4 channels, which store no bytes and count the rows, restarted at 0 after every 16 384 rows.
//! Such a time was rejected as going backwards; any other value was silently wrong.

use dashpot_recording::{Channel, Channels, Recording};

use crate::mdf4::{self, Channel as Field};

#[test]
fn counted_channels_count_all_rows() {
    const ROWS: usize = 40_000;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("counted.mf4");
    let time = Field {
        kind: 3,
        linear: Some([0.0, 1e-3]),
        bits: 0,
        number: 0,
        ..Field::time()
    };
    let counted = Field {
        kind: 6,
        linear: Some([1.0, 2.0]),
        ..Field::value("counted", 0, [0, 0, 0])
    };
    let value = Field::value("value", 0, [0, 0, 32]);
    let records: Vec<Vec<u8>> = (0..ROWS as u32)
        .map(|row| (7 * row).to_le_bytes().to_vec())
        .collect();
    mdf4::write(&path, &[time, counted, value], &records);
    for (name, expected) in [("counted", [1.0, 2.0]), ("value", [0.0, 7.0])] {
        let channels = Channels {
            displacement: Channel {
                name: Some(name.into()),
                ..Channel::default()
            },
            ..Channels::default()
        };
        let mut recording = Recording::open_with(&path, &channels).unwrap();
        let rows = recording.read_all().unwrap();
        assert_eq!(rows.len(), ROWS);
        for (row, sample) in rows.iter().enumerate() {
            let [offset, factor] = expected;
            assert_eq!(sample.time_s, 1e-3 * row as f64);
            assert_eq!(sample.displacement_m, offset + factor * row as f64);
        }
    }
}
