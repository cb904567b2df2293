//! The locomotive that ships, by its reference solution.

use std::sync::Arc;

use dashpot_hil::files::vehicle;
use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::track::Track;
use dashpot_reference::vehicle::VehicleReference;

/// On ideal straight track nothing moves but the spin, from that of the heaviest patches to that without a moment.
#[test]
fn the_locomotive_keeps_its_standing_position() {
    let locomotive = vehicle::load("locomotive", &[]).unwrap();
    let pair = Pair::standard(Installation::default()).unwrap();
    let geometry = ContactGeometry::new(pair, Steel::default(), 101e3).unwrap();
    let mut grid = Grid::default();
    grid.roll_rad.cells = [1, 2, 1];
    grid.yaw_squared_rad2.cells = [0, 1, 1];
    let tables = Arc::new(Tables::new(geometry, grid).unwrap());
    let contact = WheelsetContact::new(tables, KalkerBook::new(), Friction::default()).unwrap();
    let track = Track::default();
    let mut reference = VehicleReference::new(&locomotive, &contact, &track, 30.0, 0.0).unwrap();
    let samples = reference.run(&[0.0, 0.5, 1.0], 1e-8).unwrap();
    let bodies = locomotive.bodies.len();
    for sample in samples {
        for (body, (q, v)) in sample
            .coordinates
            .iter()
            .zip(&sample.velocities)
            .enumerate()
        {
            for k in 0..5 {
                let allowed = if body >= bodies && k == 3 { 1e-5 } else { 1e-9 };
                let most = q[k].abs().max(v[k].abs());
                assert!(most < allowed, "{body} {k}: {most} at {} s", sample.time_s);
            }
        }
        assert!(sample.damper_forces_n.iter().all(|force| *force == 0.0));
    }
}
