//! `dashpot link load`: loads dampers and images into slots.

use dashpot_core::Damper;
use dashpot_files::damper;
use serde_json::json;

use crate::link_common::Rig;
use crate::pil_common::built;

#[test]
fn a_damper_is_loaded_into_slots_that_lack_it() {
    let rig = Rig::new();
    let load = ["load", "--damper", "in-service"];
    let revision = built("in-service").revision();
    // The second slot has the damper from the start.
    let reported = rig.text(&load);
    assert_eq!(
        reported,
        format!(
            "in-service, revision {revision:#010x}\nloaded into slots 0, 2\nskipped slot 1: already loaded\n"
        )
    );
    let again = rig.json(&load);
    let all =
        json!({"damper": "in-service", "revision": revision, "loaded": [], "skipped": [0, 1, 2]});
    assert_eq!(again, all);
    let other = [
        "--set",
        "mount.clearance_m=2e-3",
        "--place",
        "2",
        "--place",
        "0",
        "--place",
        "2",
    ];
    let reported = rig.json(&[&load[..], &other].concat());
    assert_eq!(reported["loaded"], json!([0, 2]));
    let revisions = &rig.json(&["hello"])["revisions"];
    assert_eq!(revisions[1], json!(revision));
    assert_eq!(revisions[0], reported["revision"]);
    assert_eq!(revisions[2], reported["revision"]);
}

#[test]
fn a_damper_is_loaded_while_the_tick_runs() {
    let rig = Rig::new();
    rig.text(&["run", "--displacement-m", "0"]);
    rig.text(&["load", "--damper", "paper", "--place", "0"]);
    assert_eq!(
        rig.json(&["hello"])["revisions"][0],
        json!(built("paper").revision())
    );
    let status = rig.json(&["status"]);
    assert_eq!(status["places"][0]["status"], json!(["damper_swapped"]));
}

#[test]
fn an_image_is_loaded_when_it_fits() {
    let rig = Rig::new();
    let paper = built("paper");
    rig.write("paper.bin", paper.to_image());
    let reported = rig.json(&["load", "--image", "paper.bin", "--place", "2"]);
    let report =
        json!({"damper": "paper.bin", "revision": paper.revision(), "loaded": [2], "skipped": []});
    assert_eq!(reported, report);

    let parameters = damper::load("paper", &[]).unwrap();
    let half: Damper<f32> = parameters.build(5e-4).unwrap();
    let double: Damper<f64> = parameters.build(1e-3).unwrap();
    let mut damaged = paper.to_image();
    damaged[100] ^= 1;
    for (image, part) in [
        (
            &half.to_image()[..],
            "x.bin: built for a step of 500 us, but the target's step is 1000 us; export it for that step",
        ),
        (&double.to_image()[..], "x.bin: "),
        (&damaged[..], "x.bin: CRC-32 does not match"),
        (
            b"DASH",
            "x.bin: 4 bytes, but a damper has 6728; allowed: a file written by `dashpot export --lang bin`",
        ),
        (b"", "x.bin: 0 bytes"),
    ] {
        rig.write("x.bin", image);
        let error = rig.error(&["load", "--image", "x.bin"], 1);
        assert!(error.contains(part), "{error}");
    }
    let error = rig.error(&["load", "--image", "none.bin"], 1);
    assert!(error.contains("none.bin: cannot read"), "{error}");
    let revisions = &rig.json(&["hello"])["revisions"];
    assert_eq!(revisions[0], json!(built("reduced-vertical").revision()));
}

#[test]
fn an_unknown_slot_is_wrong_use() {
    let rig = Rig::new();
    let load = ["load", "--damper", "paper", "--place", "0", "--place", "7"];
    let error = rig.error(&load, 2);
    assert!(error.contains("--place 7: the target has 3 dampers; allowed: 0 to 2"));
    // The valid slot is not changed either.
    let revisions = &rig.json(&["hello"])["revisions"];
    assert_eq!(revisions[0], json!(built("reduced-vertical").revision()));
}
