//! The A2L file, read by another library.

use a2lfile::A2lObjectName;

use crate::master::description;

/// Reads a file strictly, with its interface parts by its own language.
fn loaded(text: &str) -> a2lfile::A2lFile {
    let (file, log) = a2lfile::load_from_string(text, None, true).unwrap();
    assert!(log.is_empty(), "{log:?}");
    let found = file.check();
    assert!(found.is_empty(), "{found:?}");
    file
}

#[test]
fn every_value_is_described() {
    let slave = description(8);
    let file = loaded(&dashpot_host_link::a2l::write(&slave));
    let module = &file.project.module[0];
    assert_eq!(module.get_name(), "test_vehicle");
    assert_eq!(module.measurement.len(), 8);
    for (number, measured) in module.measurement.iter().enumerate() {
        assert_eq!(measured.get_name(), slave.measurements[number].name);
        assert_eq!(
            measured.long_identifier,
            slave.measurements[number].description
        );
        let address = measured.ecu_address.as_ref().unwrap().address;
        assert_eq!(address, 0x1000_0000 + 8 * number as u32);
        let method = module
            .compu_method
            .iter()
            .find(|method| method.get_name() == measured.conversion);
        assert_eq!(method.unwrap().unit, "m/s2");
        assert_eq!(measured.if_data.len(), 1);
        assert!(measured.if_data[0].ifdata_valid);
    }
    assert_eq!(module.characteristic.len(), 3);
    let clearance = &module.characteristic[0];
    assert_eq!(clearance.get_name(), "damper_1.mount.clearance_m");
    assert_eq!(
        (
            clearance.address,
            clearance.lower_limit,
            clearance.upper_limit
        ),
        (0x2000_0000, 0.0, 1e9)
    );
    let parameters = module.mod_par.as_ref().unwrap();
    assert_eq!(parameters.epk.as_ref().unwrap().identifier, slave.epk());
    let segment = &parameters.memory_segment[0];
    assert_eq!((segment.address, segment.size), (0x2000_0000, 24));
    assert!(segment.if_data[0].ifdata_valid);
    assert!(module.if_data[0].ifdata_valid);
}

#[test]
fn the_interface_names_address_and_limits() {
    let mut slave = description(1);
    for (address, expected) in [
        ("192.0.2.7:5555", "5555 ADDRESS \"192.0.2.7\""),
        ("[::1]:77", "77 IPV6 \"::1\""),
    ] {
        slave.address = address.parse().unwrap();
        let text = dashpot_host_link::a2l::write(&slave);
        assert!(loaded(&text).project.module[0].if_data[0].ifdata_valid);
        assert_eq!(text.matches(expected).count(), 2, "TCP and UDP");
    }
    let text = dashpot_host_link::a2l::write(&slave);
    assert!(text.contains("OPTIONAL_CMD WRITE_DAQ_MULTIPLE\n"));
    assert!(text.contains("OPTIONAL_CMD GET_PAG_PROCESSOR_INFO\n"));
    // Commands that every slave has are not optional.
    assert!(!text.contains("OPTIONAL_CMD CONNECT"));
    assert!(text.is_ascii());
}

#[test]
fn a_slave_without_parameters_has_no_segment() {
    let mut slave = description(2);
    slave.parameters.clear();
    slave.pages.clear();
    slave.name = "7 \"wagons\" à 4 µm\\".into();
    let file = loaded(&dashpot_host_link::a2l::write(&slave));
    let module = &file.project.module[0];
    assert_eq!(module.get_name(), "_7__wagons____4__m_");
    assert!(module.mod_par.as_ref().unwrap().memory_segment.is_empty());
    assert!(module.if_data[0].ifdata_valid);
}
