//! Histories of a run: read from ORVD's results, or computed by Dashpot at the same instants.

use dashpot::document;
use dashpot_files::case::Case;
use dashpot_vehicle_run::Run;

use crate::FOLDER;

/// Wheelsets of the coach.
pub const WHEELSETS: usize = 4;
/// Bodies before the wheelsets: the body and two bogies.
const BODIES: usize = 3;
/// Position of the first wheelset in the vehicle, m.
const FIRST_WHEELSET_M: f64 = 9.1;
/// Ticks of 1 ms between two rows.
const TICKS_PER_ROW: usize = 20;

/// Histories of one run.
pub struct Histories {
    /// Time of each row, s.
    pub time_s: Vec<f64>,
    /// Lateral displacement of each wheelset, to the right, mm.
    pub lateral_mm: [Vec<f64>; WHEELSETS],
    /// Yaw of each wheelset, to the right, mrad.
    pub yaw_mrad: [Vec<f64>; WHEELSETS],
    /// Lateral displacement of the body at the height of the rails, to the right, mm.
    pub body_lateral_mm: Vec<f64>,
    /// Vertical load of the first wheelset's right wheel, kN.
    pub load_kn: Vec<f64>,
    /// Lateral displacement of the first wheelset from the middle of the rails under it, mm; empty for ORVD's results.
    pub shift_mm: Vec<f64>,
}

impl Histories {
    fn new() -> Self {
        Self {
            time_s: Vec::new(),
            lateral_mm: Default::default(),
            yaw_mrad: Default::default(),
            body_lateral_mm: Vec::new(),
            load_kn: Vec::new(),
            shift_mm: Vec::new(),
        }
    }

    /// Reads ORVD's results.
    pub fn of_orvd(speed_km_h: u32) -> Self {
        let path = format!("{FOLDER}/gz18-straight-{speed_km_h}.csv");
        let text = document::read(&path);
        let mut histories = Self::new();
        for (line, row) in text.lines().skip(1).enumerate() {
            let number = |text: &str| {
                text.parse()
                    .unwrap_or_else(|error| panic!("{path}: row {line}: {error}"))
            };
            let numbers: Vec<f64> = row.split(',').map(number).collect();
            assert_eq!(numbers.len(), 3 + 2 * WHEELSETS, "{path}: row {line}");
            histories.time_s.push(numbers[0]);
            for wheelset in 0..WHEELSETS {
                histories.lateral_mm[wheelset].push(numbers[1 + 2 * wheelset]);
                histories.yaw_mrad[wheelset].push(numbers[2 + 2 * wheelset]);
            }
            histories.body_lateral_mm.push(numbers[9]);
            histories.load_kn.push(numbers[10]);
        }
        histories
    }

    /// Runs the same case in Dashpot.
    pub fn of_dashpot(speed_km_h: u32) -> Self {
        let path = document::in_repository(&format!("{FOLDER}/straight-{speed_km_h}.toml"));
        let case = Case::load(&path.to_string_lossy()).unwrap();
        let height_m = case.vehicle.bodies[0].height_m;
        let mut run = Run::new(&case).unwrap();
        let mut histories = Self::new();
        histories.push(&run, height_m);
        while !run.is_over() {
            for _ in 0..TICKS_PER_ROW {
                let ending = run.step().unwrap();
                assert!(ending.is_none() || run.is_over(), "{ending:?}");
            }
            histories.push(&run, height_m);
        }
        histories
    }

    fn push(&mut self, run: &Run, height_m: f64) {
        let state = run.state();
        self.time_s.push(run.time_s());
        for wheelset in 0..WHEELSETS {
            let [lateral_m, _, _, _, yaw_rad] = state.coordinates()[BODIES + wheelset];
            self.lateral_mm[wheelset].push(1e3 * lateral_m);
            self.yaw_mrad[wheelset].push(1e3 * yaw_rad);
        }
        // ORVD states the motion of the point of the body that is at the height of the rails.
        let [lateral_m, _, roll_rad, ..] = state.coordinates()[0];
        self.body_lateral_mm
            .push(1e3 * (lateral_m - height_m * roll_rad));
        self.load_kn
            .push(1e-3 * state.contacts()[0].wheels[1].load_n());
        let [rails, _] =
            (run.track().irregularity()).channels(state.distance_m() + FIRST_WHEELSET_M);
        let shift_m = state.coordinates()[BODIES][0] - rails.lateral;
        self.shift_mm.push(1e3 * shift_m);
    }
}
