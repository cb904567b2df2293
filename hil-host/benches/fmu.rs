//! Time of a step through the interface of an FMU, in a library built for this platform, compared with the step alone
//! in the same run.
//!
//! One element is the work of an importer at a communication point for one damper: set the displacement, step, get the
//! force.

use std::f64::consts::TAU;
use std::ffi::{CString, c_char, c_int, c_void};
use std::hint::black_box;
use std::ptr;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use dashpot_core::Damper;
use dashpot_export::fmu::{Fmu, Interface, NamedDamper, Target, compile};
use dashpot_files::damper;
use libloading::{Library, Symbol};

const STEP_S: f64 = 1e-3;
/// Numbers of the first damper's variables, and from one damper to the next.
const DISPLACEMENT: u32 = 1;
const FORCE: u32 = 3;
const VARIABLES: u32 = 6;

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
    let clearance_m = parameters.mount.clearance_m;
    let displacements: Vec<f64> = (0..TICKS).map(displacement).collect();
    let mut group = criterion.benchmark_group("fmu");
    group.throughput(Throughput::Elements(u64::from(TICKS)));
    group.bench_function("step alone", |bencher| {
        let mut state = damper.at_rest(0.0);
        bencher.iter(|| {
            for x in &displacements {
                black_box(damper.step(&mut state, black_box(*x as f32)));
            }
        });
    });

    for count in [1, 16] {
        let named = NamedDamper {
            name: "in-service".into(),
            damper,
            clearance_m,
        };
        bench_fmu(&mut group, &vec![named; count], &displacements);
    }
    group.finish();
}

/// Measures an FMU with these dampers.
fn bench_fmu(
    group: &mut BenchmarkGroup<'_, WallTime>,
    dampers: &[NamedDamper<f32>],
    displacements: &[f64],
) {
    let count = dampers.len();
    let numbers = |first| (0..count as u32).map(move |damper| first + VARIABLES * damper);
    let inputs: Vec<u32> = numbers(DISPLACEMENT).collect();
    let outputs: Vec<u32> = numbers(FORCE).collect();
    let fmu = Fmu::of_dampers(Interface::Three, "it", dampers, STEP_S, false).expect("a name");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("it.so");
    std::fs::write(
        &path,
        compile(&fmu, &Target::here())
            .expect("a C compiler")
            .content,
    )
    .expect("a temporary file");
    let token = CString::new(fmu.token()).expect("a token");
    let (mut displacements_m, mut forces_n) = (vec![0.0; count], vec![0.0; count]);
    group.throughput(Throughput::Elements(u64::from(TICKS) * count as u64));
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
        group.bench_function(
            format!("set, step and get by FMI 3, {count} dampers"),
            |bencher| {
                bencher.iter(|| {
                    for x in displacements {
                        let (mut event, mut end, mut early) = (false, false, false);
                        let mut reached_s = 0.0;
                        let at_s = tick as f64 * STEP_S;
                        displacements_m.fill(*x);
                        let ended = set(
                            instance,
                            inputs.as_ptr(),
                            count,
                            displacements_m.as_ptr(),
                            count,
                        ) | step(
                            instance,
                            at_s,
                            STEP_S,
                            false,
                            &mut event,
                            &mut end,
                            &mut early,
                            &mut reached_s,
                        ) | get(
                            instance,
                            outputs.as_ptr(),
                            count,
                            forces_n.as_mut_ptr(),
                            count,
                        );
                        tick += 1;
                        assert_eq!(ended, 0);
                        black_box(&forces_n);
                    }
                });
            },
        );
        let free: Symbol<'_, unsafe extern "C" fn(Instance)> =
            library.get(b"fmi3FreeInstance").expect("a function");
        free(instance);
    }
}

criterion_group!(benches, fmu);
criterion_main!(benches);
