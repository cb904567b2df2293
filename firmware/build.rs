//! Sets the linker options of the images: the memory map of the board and the start-up code of cortex-m-rt.

fn main() {
    let here = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    let target = std::env::var("TARGET").expect("cargo sets it");
    println!("cargo::rustc-check-cfg=cfg(mps2_an505)");
    let is_nucleo = std::env::var_os("CARGO_FEATURE_NUCLEO_H753ZI").is_some();
    let (folder, end_of_memory) = if is_nucleo {
        // No measuring image is for this board.
        ("nucleo-h753zi", "0")
    } else if target.starts_with("thumbv8m.main") {
        println!("cargo::rustc-cfg=mps2_an505");
        ("mps2-an505", "0x81000000")
    } else {
        ("..", "0x20400000")
    };
    // The measuring images have dampers or long frames on their stack, and the host puts data behind their own data; a
    // network stack needs more than 4 KiB. So their stack starts at the end of the memory.
    let mut images = vec!["step-cost", "health-cost", "link-cost", "xcp-cost"];
    if std::env::var_os("CARGO_FEATURE_TCP").is_some() {
        images.extend(["tcp-cost", "tcp-served"]);
    }
    for image in images {
        println!("cargo::rustc-link-arg-bin={image}=--defsym=_stack_start={end_of_memory}");
    }
    println!("cargo::rustc-link-search={here}/{folder}");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rerun-if-changed={folder}/memory.x");
}
