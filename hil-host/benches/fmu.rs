//! Time of a step through the interface of an FMU, in a library built for this platform, compared with the step alone
//! in the same run.
//!
//! One element is the work of an importer at a communication point: set the displacement, step, get the force.

use std::f64::consts::TAU;
use std::ffi::{CString, c_char, c_int, c_void};
use std::hint::black_box;
use std::ptr;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dashpot_core::Damper;
use dashpot_export::fmu::{Fmu, Interface, NamedDamper, compile};
use dashpot_files::damper;
use libloading::{Library, Symbol};

const STEP_S: f64 = 1e-3;
const DISPLACEMENT: u32 = 1;
const FORCE: u32 = 3;

type Instance = *mut c_void;
type Instantiate = unsafe extern "C" fn(
    *const c_char,
    *const c_char,
    *const c_char,
    bool,
    bool,
    bool,
    bool,
    *const u32,
    usize,
    *mut c_void,
    *const c_void,
    *const c_void,
) -> Instance;
type Begin = unsafe extern "C" fn(Instance, bool, f64, f64, bool, f64) -> c_int;
type Plain = unsafe extern "C" fn(Instance) -> c_int;
type Set = unsafe extern "C" fn(Instance, *const u32, usize, *const f64, usize) -> c_int;
type Get = unsafe extern "C" fn(Instance, *const u32, usize, *mut f64, usize) -> c_int;
type DoStep = unsafe extern "C" fn(
    Instance,
    f64,
    f64,
    bool,
    *mut bool,
    *mut bool,
    *mut bool,
    *mut f64,
) -> c_int;

const TICKS: u32 = 10_000;

/// A whole number of periods, so that the motion can be repeated without a jump.
fn displacement(tick: u32) -> f64 {
    5e-3 * (16.0 * TAU * f64::from(tick) / f64::from(TICKS)).sin()
}

fn fmu(criterion: &mut Criterion) {
    let parameters = damper::load("in-service", &[]).expect("a preset");
    let damper: Damper<f32> = parameters.build(STEP_S).expect("a step");
    let displacements: Vec<f64> = (0..TICKS).map(displacement).collect();
    let mut group = criterion.benchmark_group("fmu");
    group.throughput(Throughput::Elements(displacements.len() as u64));
    group.bench_function("step alone", |bencher| {
        let mut state = damper.at_rest(0.0);
        bencher.iter(|| {
            for x in &displacements {
                black_box(damper.step(&mut state, black_box(*x as f32)));
            }
        });
    });

    let named = NamedDamper {
        name: "in-service".into(),
        damper,
        clearance_m: parameters.mount.clearance_m,
    };
    let fmu = Fmu::of_dampers(Interface::Three, "it", &[named], STEP_S, false).expect("a name");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("it.so");
    std::fs::write(&path, compile(&fmu).expect("a C compiler").content).expect("a temporary file");
    let token = CString::new(fmu.token()).expect("a token");
    // SAFETY: the library was just built, its functions have the types of fmi3FunctionTypes.h, and each gets its own
    // instance with pointers to the stated number of elements.
    unsafe {
        let library = Library::new(&path).expect("the library just made");
        let instantiate: Symbol<'_, Instantiate> = library
            .get(b"fmi3InstantiateCoSimulation")
            .expect("a function");
        let begin: Symbol<'_, Begin> = library
            .get(b"fmi3EnterInitializationMode")
            .expect("a function");
        let initialized: Symbol<'_, Plain> = library
            .get(b"fmi3ExitInitializationMode")
            .expect("a function");
        let set: Symbol<'_, Set> = library.get(b"fmi3SetFloat64").expect("a function");
        let get: Symbol<'_, Get> = library.get(b"fmi3GetFloat64").expect("a function");
        let step: Symbol<'_, DoStep> = library.get(b"fmi3DoStep").expect("a function");
        let name = c"it".as_ptr();
        let instance = instantiate(
            name,
            token.as_ptr(),
            c"".as_ptr(),
            false,
            false,
            false,
            false,
            ptr::null(),
            0,
            ptr::null_mut(),
            ptr::null(),
            ptr::null(),
        );
        assert!(!instance.is_null());
        assert_eq!(begin(instance, false, 0.0, 0.0, false, 0.0), 0);
        assert_eq!(initialized(instance), 0);
        let mut tick = 0_u64;
        group.bench_function("set, step and get by FMI 3", |bencher| {
            bencher.iter(|| {
                for x in &displacements {
                    let (mut event, mut end, mut early) = (false, false, false);
                    let (mut reached_s, mut force_n) = (0.0, 0.0);
                    let at_s = tick as f64 * STEP_S;
                    let ended = set(instance, &DISPLACEMENT, 1, x, 1)
                        | step(
                            instance,
                            at_s,
                            STEP_S,
                            false,
                            &mut event,
                            &mut end,
                            &mut early,
                            &mut reached_s,
                        )
                        | get(instance, &FORCE, 1, &mut force_n, 1);
                    tick += 1;
                    assert_eq!(ended, 0);
                    black_box(force_n);
                }
            });
        });
        let free: Symbol<'_, unsafe extern "C" fn(Instance)> =
            library.get(b"fmi3FreeInstance").expect("a function");
        free(instance);
    }
    group.finish();
}

criterion_group!(benches, fmu);
criterion_main!(benches);
