//! Follows docs/labview.md literally: its C code, built by its command and called as LabVIEW calls a library, gives the
//! bits of the core.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Command;

use dashpot_core::{Damper, Status};
use dashpot_files::damper;
use dashpot_testbench::excitation::Excitation;
use libloading::{Library, Symbol};
use xtask::run::repository;
use xtask::tools::{CLANG, GCC, have};

use crate::common::dashpot;
use crate::common::page::blocks;

type AtRest = unsafe extern "C" fn(*mut u8, f32);
type Step = unsafe extern "C" fn(*mut u8, f32, *mut f32, *mut u32) -> i32;
type BitsAreRight = unsafe extern "C" fn() -> i32;

#[test]
fn the_library_of_the_page_has_the_bits_of_the_core() {
    if !have(&[GCC, CLANG], "the page about LabVIEW") {
        return;
    }
    let page = fs::read_to_string(repository().join("docs/labview.md")).unwrap();
    let lines = page.lines().filter_map(|line| line.strip_prefix("    "));
    let shell: Vec<&str> = lines.filter(|line| line.starts_with("gcc ")).collect();
    let [line] = shell[..] else {
        panic!("one command of gcc: {shell:?}");
    };
    let blocks = blocks(&page);
    let [block] = &blocks[..] else {
        panic!("one block: {}", blocks.len());
    };
    for compiler in ["gcc", "clang"] {
        let folder = tempfile::tempdir().unwrap();
        let export =
            "export --damper in-service --lang c --standalone --step-us 1000 --output in_service.c";
        assert!(page.contains(&format!("    dashpot {export}\n")));
        dashpot(&export.split(' ').collect::<Vec<_>>(), folder.path()).success();
        fs::write(folder.path().join(block.file.unwrap()), &block.content).unwrap();
        let mut words = line.split(' ');
        let mut build = Command::new(words.next().map(|_| compiler).unwrap());
        let output = build
            .args(words)
            .arg("-Werror")
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        compare(&folder.path().join("libin_service.so"));
    }
}

fn compare(library: &Path) {
    let damper: Damper<f32> = damper::load("in-service", &[])
        .unwrap()
        .build(1e-3)
        .unwrap();
    let mut motion = Excitation::Ride.displacements_m(1e-3);
    motion.extend([f64::NAN, 3.0, -3.0, 0.0]);
    // SAFETY: the library was just built, its functions have the types given on the page, and each gets as many bytes
    // as a state has.
    unsafe {
        let library = Library::new(library).unwrap();
        let at_rest: Symbol<'_, AtRest> = library.get(b"labview_at_rest").unwrap();
        let step: Symbol<'_, Step> = library.get(b"labview_step").unwrap();
        let bits_are_right: Symbol<'_, BitsAreRight> =
            library.get(b"labview_bits_are_right").unwrap();
        assert_eq!(bits_are_right(), 1);
        let mut bytes = [0; 24];
        let (mut force_n, mut status) = (7.0, 7);
        assert_eq!(step(bytes.as_mut_ptr(), 0.0, &mut force_n, &mut status), 2);
        assert_eq!((bytes, force_n, status), ([0; 24], 7.0, 7));
        at_rest(bytes.as_mut_ptr(), 0.0);
        let mut state = damper.at_rest(0.0);
        for (tick, x) in motion.iter().map(|x| *x as f32).enumerate() {
            assert_eq!(step(bytes.as_mut_ptr(), x, &mut force_n, &mut status), 0);
            let expected = damper.step(&mut state, x);
            assert_eq!(force_n.to_bits(), expected.to_bits(), "tick {tick}");
            assert_eq!(status, u32::from(state.status().bits()), "tick {tick}");
        }
        assert!(
            state
                .status()
                .contains(Status::INPUT_HELD | Status::INPUT_LIMITED)
        );
    }
}
