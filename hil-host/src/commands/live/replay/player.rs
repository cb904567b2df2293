//! Plays the rows of a recording: time passes, is turned, and is cut into frames.

use dashpot_live::{Frame, FrameHead, MAX_STEPS};
use dashpot_recording::Signals;

use crate::commands::live::pace::FRAME_S;

/// What a page shows before the time that it is turned to: this long, s, in frames of this time, s. The curves of the
/// last seconds are as smooth as while it runs.
const WINDOW: [(f64, f64); 2] = [(20.0, 0.02), (3.0, FRAME_S)];

/// A recording and the time on it.
pub(super) struct Player {
    signals: Signals,
    /// Number of the signal that is the distance.
    distance: Option<usize>,
    frame: Frame,
    row: Vec<f32>,
    /// First row that has not been shown.
    next: usize,
    time_s: f64,
    factor: f64,
}

impl Player {
    /// A recording at its start, at the pace of real time; `names` are those of its signals, without the time.
    pub fn new(signals: Signals, names: &[String]) -> Self {
        Self {
            time_s: signals.times_s()[0],
            signals,
            distance: names.iter().position(|name| name == "distance_m"),
            // The first signal of a frame is the time.
            frame: Frame::new(1 + names.len()),
            row: Vec::new(),
            next: 0,
            factor: 1.0,
        }
    }

    /// Times of the first and the last row, s.
    pub fn ends_s(&self) -> [f64; 2] {
        let times_s = self.signals.times_s();
        [times_s[0], times_s[times_s.len() - 1]]
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.signals.times_s().len()
    }

    /// Time that is shown, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Factor of real time; 0 while paused.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Lets time pass at this factor.
    pub fn set_factor(&mut self, factor: f64) {
        self.factor = factor;
    }

    /// True if every row has been shown.
    pub fn is_at_end(&self) -> bool {
        self.next >= self.rows()
    }

    /// Turns to a time, and makes the frames before it.
    pub fn seek(&mut self, time_s: f64, frames: &mut Vec<Vec<u8>>) {
        let [start_s, end_s] = self.ends_s();
        self.time_s = time_s.clamp(start_s, end_s);
        let begin_s = self.time_s - WINDOW[0].0;
        self.next = self
            .signals
            .times_s()
            .partition_point(|row_s| *row_s < begin_s);
        self.frame = Frame::new(self.frame.last().len());
        for (place, (_, frame_s)) in WINDOW.iter().enumerate() {
            let later_s = WINDOW.get(place + 1).map_or(0.0, |(later_s, _)| *later_s);
            self.show(self.time_s - later_s, *frame_s, frames);
        }
    }

    /// Lets some time pass, s, and makes its frames. Pauses at the end.
    pub fn advance(&mut self, elapsed_s: f64, frames: &mut Vec<Vec<u8>>) {
        if self.factor == 0.0 {
            return;
        }
        self.time_s = (self.time_s + elapsed_s * self.factor).min(self.ends_s()[1]);
        // Faster than real time, a frame grows with the speed.
        self.show(self.time_s, FRAME_S * self.factor.max(1.0), frames);
        if self.is_at_end() {
            self.factor = 0.0;
        }
    }

    /// Shows the next rows, while paused.
    pub fn step(&mut self, rows: u32, frames: &mut Vec<Vec<u8>>) {
        let last = self.next.saturating_add(rows.clamp(1, MAX_STEPS) as usize) - 1;
        let times_s = self.signals.times_s();
        self.time_s = times_s[last.min(times_s.len() - 1)];
        self.show(self.time_s, FRAME_S, frames);
    }

    /// Makes frames of about this time from all rows up to another.
    fn show(&mut self, until_s: f64, frame_s: f64, frames: &mut Vec<Vec<u8>>) {
        let mut begin_s = f64::NAN;
        while let Some(&row_s) = self.signals.times_s().get(self.next)
            && row_s <= until_s
        {
            if self.frame.ticks() == 0 {
                begin_s = row_s;
            }
            self.signals.row(self.next, &mut self.row);
            let values = std::iter::once(row_s as f32).chain(self.row.iter().copied());
            self.frame.add(values);
            self.next += 1;
            let next_s = self.signals.times_s().get(self.next);
            if next_s.is_none_or(|next_s| *next_s > until_s || next_s - begin_s >= frame_s) {
                frames.push(self.written(row_s));
            }
        }
    }

    fn written(&mut self, time_s: f64) -> Vec<u8> {
        let distance_m = self.distance.map_or(f32::NAN, |number| self.row[number]);
        let head = FrameHead {
            time_s,
            distance_m: f64::from(distance_m),
            ticks: self.next as u64,
            ..FrameHead::default()
        };
        let mut bytes = Vec::new();
        self.frame.write(&head, &mut bytes);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use dashpot_recording::Signals;

    use super::Player;

    /// A recording of one second at 1 kHz, whose distance is ten times its time.
    fn player() -> Player {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let rows = (0..=1000).map(|row| format!("{},{}\n", row as f64 / 1e3, row as f64 / 1e2));
        fs::write(
            &path,
            "time_s,distance_m\n".to_owned() + &rows.collect::<String>(),
        )
        .unwrap();
        let signals = Signals::read(&path, &[("distance_m", "m")]).unwrap();
        Player::new(signals, &["distance_m".into()])
    }

    fn number(frame: &[u8], at: usize) -> f64 {
        f64::from_le_bytes(frame[at..at + 8].try_into().unwrap())
    }

    fn ticks(frames: &[Vec<u8>]) -> u32 {
        let of = |frame: &Vec<u8>| u32::from_le_bytes(frame[40..44].try_into().unwrap());
        frames.iter().map(of).sum()
    }

    #[test]
    fn every_row_is_in_one_frame() {
        let mut player = player();
        let mut frames = Vec::new();
        player.set_factor(0.0);
        player.advance(1.0, &mut frames);
        assert!(frames.is_empty(), "it is paused");
        player.set_factor(0.5);
        for _ in 0..300 {
            player.advance(1.0 / 60.0, &mut frames);
        }
        assert_eq!(ticks(&frames), 1001);
        assert!(player.is_at_end() && player.factor() == 0.0);
        let last = &frames[frames.len() - 1];
        assert_eq!([number(last, 8), number(last, 16)], [1.0, 10.0]);
    }

    #[test]
    fn a_time_is_shown_with_what_was_before_it() {
        let mut player = player();
        let mut frames = Vec::new();
        player.seek(0.5, &mut frames);
        assert_eq!(ticks(&frames), 501);
        assert_eq!(number(&frames[frames.len() - 1], 8), 0.5);
        frames.clear();
        player.step(2, &mut frames);
        assert_eq!((ticks(&frames), player.time_s()), (2, 0.502));
        for wild_s in [f64::INFINITY, f64::NEG_INFINITY, -1.0, 7.0] {
            player.seek(wild_s, &mut frames);
            player.step(u32::MAX, &mut frames);
        }
        assert!(player.is_at_end());
        player.step(0, &mut frames);
    }
}
