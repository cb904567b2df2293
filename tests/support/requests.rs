//! One request of every kind.

use dashpot_core::link::{LossOfLink, PROTOCOL, Parameter, Reals, Request};

/// Every request to damper 0, in the order of request numbers; hello is the first.
pub fn every_request<'a>(
    image: &'a [u8],
    model: &'a [u8],
    states: &'a [u8],
    displacements_m: &Reals,
) -> [Request<'a>; 20] {
    let displacements_m = || displacements_m.clone();
    [
        Request::Hello { protocol: PROTOCOL },
        Request::Load { damper: 0, image },
        Request::Set {
            damper: 0,
            parameter: Parameter::ClearanceM,
            value: 1e-3,
        },
        Request::LossOfLink(LossOfLink::default()),
        Request::Reset {
            displacements_m: displacements_m(),
        },
        Request::Step {
            tick: 1,
            displacements_m: displacements_m(),
        },
        Request::Run {
            displacements_m: displacements_m(),
        },
        Request::Displace {
            displacements_m: displacements_m(),
        },
        Request::Stop,
        Request::Save,
        Request::Restore { tick: 0, states },
        Request::Telemetry { damper: 0 },
        Request::Counters,
        Request::Outputs,
        Request::Status,
        Request::ClearStatus,
        Request::LoadHealth {
            damper: 0,
            image: model,
        },
        Request::Measure {
            damper: 0,
            samples: states,
        },
        Request::Health { damper: 0 },
        Request::ClearHealth { damper: 0 },
    ]
}
