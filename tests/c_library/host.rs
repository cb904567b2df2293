//! Compares the example controller in C with the same run in Rust on Linux: under sanitizers and Valgrind, through
//! pkg-config and CMake, and on a 64-bit Arm processor. Also checks the exports of the shared library.

use std::path::{Path, PathBuf};
use std::process::Command;

use dashpot::controller::{
    assert_same_run, compile, compile_with_archive, expected, export, succeed, tree_of,
};
use xtask::c_library::{self, Platform};
use xtask::processor::AARCH64;
use xtask::tools::{
    AARCH64_GCC, AARCH64_LIBC, CMAKE, GCC, MAKE, PKG_CONFIG, QEMU_AARCH64, VALGRIND, have,
    have_library,
};

/// The install tree of this machine; `None` on an unsupported platform.
fn host_tree(folder: &Path) -> Option<PathBuf> {
    let host = Platform::ALL.into_iter().find(Platform::is_host)?;
    Some(tree_of(&host, folder))
}

#[test]
fn the_run_covers_failed_readings_and_changes() {
    let text = expected();
    let line = |part: &str| text.lines().any(|line| line.contains(part));
    // In this run, twenty failed readings are held, the jump is limited, and the clearance changes.
    assert!(
        line("damper 00000001 status 00000005 rejected 00000014"),
        "{text}"
    );
    assert!(
        line("damper 00000002 status 00000002 rejected 00000002"),
        "{text}"
    );
    assert!(
        line("tick 00001f40 damper 00000003 status 0000000c"),
        "{text}"
    );
}

#[test]
fn the_static_library_on_the_host_prints_what_rust_does() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC], "the C library on the host") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    let compiler = || compile_with_archive(GCC.program, "host", folder, &tree, "libdashpot.a");
    let sanitized = folder.join("sanitized");
    succeed(
        compiler()
            .args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all"])
            .arg("-o")
            .arg(&sanitized),
    );
    assert_same_run(&succeed(&mut Command::new(&sanitized)), "under sanitizers");

    if !have(&[VALGRIND], "the C library under Valgrind") {
        return;
    }
    let plain = folder.join("plain");
    succeed(compiler().arg("-o").arg(&plain));
    let mut valgrind = Command::new(VALGRIND.program);
    valgrind.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]);
    valgrind.args(["--show-leak-kinds=all", "--errors-for-leak-kinds=all"]);
    assert_same_run(&succeed(valgrind.arg(&plain)), "under Valgrind");
}

#[test]
fn the_shared_library_is_found_by_pkg_config() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC, PKG_CONFIG], "the C library through pkg-config") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    let ask = |arguments: &[&str]| {
        let mut pkg_config = Command::new(PKG_CONFIG.program);
        pkg_config.env("PKG_CONFIG_PATH", tree.join("lib/pkgconfig"));
        let output = succeed(pkg_config.args(arguments).arg("dashpot"));
        String::from_utf8(output.stdout).expect("text")
    };
    assert_eq!(ask(&["--modversion"]).trim(), env!("CARGO_PKG_VERSION"));
    let flags = ask(&["--cflags", "--libs"]);
    // A backslash escapes a space in a folder name, as for a shell.
    let flags = flags.trim().replace("\\ ", "\0");
    let flags = flags.split(' ').map(|flag| flag.replace('\0', " "));
    let program = folder.join("controller");
    succeed(
        compile(GCC.program, "host", folder)
            .args(flags)
            .arg("-o")
            .arg(&program),
    );
    let mut run = Command::new(&program);
    assert_same_run(
        &succeed(run.env("LD_LIBRARY_PATH", tree.join("lib"))),
        "with the shared library",
    );
    let without = Command::new(&program).output().expect("a program");
    assert!(
        !without.status.success(),
        "it runs without the shared library"
    );
}

#[test]
fn both_libraries_are_found_by_cmake() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC, CMAKE, MAKE], "the C library through CMake") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    export(folder);
    let build = folder.join("build");
    let mut configure = Command::new(CMAKE.program);
    configure
        .arg("-S")
        .arg(c_library::folder().join("examples/host"));
    configure
        .arg("-B")
        .arg(&build)
        .args(["-G", "Unix Makefiles"]);
    for (name, value) in [("CMAKE_PREFIX_PATH", &*tree), ("DAMPERS", folder)] {
        configure.arg(format!("-D{name}={}", value.display()));
    }
    succeed(&mut configure);
    succeed(Command::new(CMAKE.program).arg("--build").arg(&build));
    for program in ["controller-dashpot", "controller-dashpot-static"] {
        assert_same_run(&succeed(&mut Command::new(build.join(program))), program);
    }
    // Another minor version has another interface.
    std::fs::write(
        folder.join("CMakeLists.txt"),
        "cmake_minimum_required(VERSION 3.16)\nproject(later C)\nfind_package(Dashpot ${WANTED} REQUIRED)\n",
    )
    .expect("a writable folder");
    for (wanted, found) in [
        (env!("CARGO_PKG_VERSION"), true),
        ("0.2.1", false),
        ("0.1", false),
        ("0.3", false),
        ("1.0", false),
    ] {
        let mut configure = Command::new(CMAKE.program);
        configure
            .arg("-S")
            .arg(folder)
            .arg("-B")
            .arg(folder.join(wanted));
        configure.arg(format!("-DCMAKE_PREFIX_PATH={}", tree.display()));
        configure.arg(format!("-DWANTED={wanted}"));
        let output = configure.output().expect("CMake starts");
        assert_eq!(output.status.success(), found, "{wanted}: {output:?}");
    }
}

#[test]
fn the_shared_library_exports_its_functions_only() {
    use object::{Object, ObjectSymbol};
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(tree) = host_tree(folder.path()) else {
        return;
    };
    let bytes = std::fs::read(tree.join("lib/libdashpot.so")).expect("a link to the library");
    let library = object::File::parse(&*bytes).expect("a shared library");
    let exported: Vec<&str> = library
        .dynamic_symbols()
        .filter(|symbol| symbol.is_definition())
        .filter_map(|symbol| symbol.name().ok())
        .collect();
    assert!(exported.contains(&"dashpot_step"), "{exported:?}");
    let others: Vec<&&str> = exported
        .iter()
        .filter(|name| !name.starts_with("dashpot_"))
        .collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn the_controller_on_64_bit_arm_prints_what_rust_does() {
    let what = "the C library on a 64-bit Arm processor";
    let tools = [AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64];
    if !have(&tools, what) || !have_library(AARCH64, what) {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let platform = Platform::Linux("aarch64");
    let tree = tree_of(&platform, folder);
    let library = format!("lib{}", platform.library());
    for end in ["a", "so"] {
        let program = folder.join(end);
        let name = format!("{library}.{end}");
        let gcc = AARCH64_GCC.program;
        let mut compiler = compile_with_archive(gcc, "host", folder, &tree, &name);
        compiler.arg(format!("-Wl,-rpath,{}", tree.join("lib").display()));
        succeed(compiler.arg("-o").arg(&program));
        assert_same_run(&succeed(&mut xtask::aarch64::program(&program)), &name);
    }
}
