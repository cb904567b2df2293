//! Compares a damper in C without a library with the core. Both implement docs/numerics.md, so a change of only one of
//! them fails here.

use std::path::Path;
use std::process::Command;

use dashpot::accuracy::DAMPERS;
use dashpot::controller::{WARNINGS, succeed};
use dashpot::golden::{MOTIONS, STEP_S, TICKS};
use dashpot::memory::{self, PlainData};
use dashpot::random_damper::{self, Random};
use dashpot::standalone::{Exported, Request, assert_same, driver, expected, export};
use dashpot::{damper, document};
use dashpot_core::{Damper, DamperParameters, DamperState};
use fastrand::Rng;
use xtask::tools::{ARM_GCC, CLANG, GCC, GXX, Tool, have};

/// Options that must not change the bits of the forces. Each enables or disables fused multiply-add if the processor
/// has it.
const OPTIONS: [&[&str]; 6] = [
    &["-std=c99", "-O2"],
    &["-std=gnu11", "-O3", "-march=native", "-ffp-contract=fast"],
    &["-std=c11", "-O0"],
    &["-std=gnu17", "-O3", "-march=native"],
    &["-std=c99", "-Os"],
    &["-std=gnu99", "-O1", "-flto"],
];

/// The available compilers with their options. clang's `-flto` is left out, because its linking needs a plug-in.
fn compilers() -> Vec<(Tool, &'static [&'static str])> {
    let there = |tool: &Tool| have(&[*tool], "C without a library beside the core");
    let tools = [GCC, CLANG].into_iter().filter(there);
    let all = tools.flat_map(|tool| OPTIONS.map(|options| (tool, options)));
    all.filter(|(tool, options)| *tool == GCC || !options.contains(&"-flto"))
        .collect()
}

/// A compiler whose warnings are errors.
pub fn compiler(tool: Tool, options: &[&str]) -> Command {
    let mut command = Command::new(tool.program);
    command.args(options).args(WARNINGS);
    command
}

fn assert_same_by<T: Exported>(
    damper: &Damper<T>,
    (tool, options): (Tool, &[&str]),
    requests: &[Request<T>],
    what: &str,
) where
    DamperState<T>: PlainData,
{
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = driver(damper, &mut compiler(tool, options), folder.path());
    assert_same(
        damper,
        &program,
        requests,
        &format!("{what}, {} {options:?}", tool.program),
    );
}

/// Every golden motion from rest.
fn golden<T: Exported>() -> Vec<Request<T>> {
    let motion = |motion: fn(f64) -> f64| {
        let at = move |tick: u32| T::from_f64(motion(STEP_S * f64::from(tick)));
        std::iter::once(Request::AtRest(at(0)))
            .chain((0..=TICKS).map(move |tick| Request::Step(at(tick))))
    };
    MOTIONS
        .iter()
        .flat_map(|(_, displacement)| motion(*displacement))
        .collect()
}

#[test]
fn golden_motions_have_the_cores_bits() {
    fn of<T: Exported>(parameters: &DamperParameters, compiler: (Tool, &[&str]), name: &str)
    where
        DamperState<T>: PlainData,
    {
        let damper = parameters.build(STEP_S).expect("a valid damper");
        assert_same_by::<T>(&damper, compiler, &golden(), name);
    }
    let compilers = compilers();
    let mut next = compilers.iter().cycle();
    for (name, preset, overrides) in DAMPERS {
        let parameters = damper(preset, overrides);
        // Each scalar is compiled in three ways; the next damper uses different ones.
        for (single, double) in next.by_ref().copied().take(3).zip(compilers.iter().rev()) {
            of::<f32>(&parameters, single, name);
            of::<f64>(&parameters, *double, name);
        }
    }
}

/// Random bytes, half of the time with those of a plausible state.
fn damaged(random: &mut Rng, real: usize) -> Vec<u8> {
    let mut bytes: Vec<u8> = std::iter::repeat_with(|| random.u8(..))
        .take(4 * real + 8)
        .collect();
    if random.bool() {
        // A valid mark, and numbers of either sign that are all small, or all huge or not finite.
        bytes[4 * real + 4..4 * real + 6].copy_from_slice(&0x3940_u16.to_ne_bytes());
        let end = if random.bool() { 0x3a } else { 0x7f };
        for number in bytes[..4 * real].chunks_mut(real) {
            number[real - 1] = end | random.u8(..) & 0x80;
        }
    }
    bytes
}

/// Requests of every kind: motions at any speed, failed readings, other clearances, damaged memory, and states that are
/// saved, damaged and restored.
fn requests<T: Exported>(damper: &Damper<T>, random: &mut Rng) -> Vec<Request<T>>
where
    DamperState<T>: PlainData,
{
    let number = T::from_f64;
    let (mut shadow, mut state) = (*damper, damper.at_rest(T::ZERO));
    let (mut displacement, mut speed) = (0.0, 1e-4);
    let mut all = Vec::new();
    for _ in 0..6000 {
        displacement += speed * (2.0 * random.f64() - 1.0);
        let request = match random.u32(..400) {
            0 => Request::AtRest(number(displacement)),
            1 => Request::AtRest(number(f64::NAN)),
            2 => Request::Step(number(
                [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.usize(..3)],
            )),
            3 => Request::Step(number(
                [1e30, -1e30, 1e4, 0.51, -0.5, -0.0, 1e-320][random.usize(..7)],
            )),
            4 | 5 => Request::SetClearance(number(0.005 * random.f64())),
            6 => Request::SetClearance(number(
                [f64::NAN, -1e-9, 0.11, 0.1, -0.0][random.usize(..5)],
            )),
            7 => Request::Adopt,
            8 => Request::Overwrite(damaged(random, size_of::<T>())),
            9 => Request::ClearStatus,
            10 | 11 => Request::Restore(T::state_bytes(&state)),
            12 => {
                let mut bytes = T::state_bytes(&state);
                let offset = random.usize(..bytes.len());
                bytes[offset] ^= 1 << random.u32(..8);
                Request::Restore(bytes)
            }
            13 => {
                speed = 10_f64.powf(-6.0 * random.f64()) * 5e-3;
                Request::ClearStatus
            }
            14 => {
                displacement = 0.0;
                Request::Step(number(0.0))
            }
            // Flips a bit of a running state while its displacement is known.
            15..20 => {
                let mut flipped = state;
                let bytes = memory::bytes(&mut flipped);
                let offset = random.usize(..bytes.len());
                bytes[offset] ^= 1 << random.u32(..8);
                Request::Overwrite(bytes.to_vec())
            }
            20 => {
                displacement = 0.2 * (2.0 * random.f64() - 1.0);
                Request::AtRest(number(displacement))
            }
            21 => {
                displacement += 0.1 * (2.0 * random.f64() - 1.0);
                Request::Step(number(displacement))
            }
            _ => Request::Step(number(displacement)),
        };
        // This copy of the state, stepped without damaged memory, is the one that may be saved.
        match &request {
            Request::AtRest(x) => state = shadow.at_rest(*x),
            Request::Step(x) => _ = shadow.step(&mut state, *x),
            Request::SetClearance(clearance) => _ = shadow.set_clearance_m(*clearance),
            _ => {}
        }
        all.push(request);
    }
    all
}

/// The random requests make the comparison meaningful: they cause every refusal and every status bit.
#[test]
fn random_requests_meet_everything() {
    let (mut codes, mut status) = ([false; 4], 0);
    for seed in 0..16 {
        let parameters = random_damper::damper(&mut Random(seed));
        let damper: Damper<f32> = parameters.build(STEP_S).expect("a valid damper");
        let requests = requests(&damper, &mut Rng::with_seed(seed));
        for answer in expected(&damper, &requests) {
            codes[usize::from(answer.code)] = true;
            let [_, [_, _, _, _, bits, ..]] = answer.rest;
            status |= bits;
        }
    }
    assert_eq!((codes, status), ([true; 4], 0x3f));
}

fn random_requests_by<T: Exported>(
    parameters: &DamperParameters,
    seed: u64,
    compiler: (Tool, &[&str]),
) where
    DamperState<T>: PlainData,
{
    let damper: Damper<T> = parameters.build(STEP_S).expect("a valid damper");
    let requests = requests(&damper, &mut Rng::with_seed(seed));
    assert_same_by(
        &damper,
        compiler,
        &requests,
        &format!("random damper {seed}"),
    );
}

#[test]
fn random_dampers_answer_random_requests_as_the_core() {
    let compilers = compilers();
    for (seed, compiler) in (0..16).zip(compilers.iter().cycle()) {
        let parameters = random_damper::damper(&mut Random(seed));
        random_requests_by::<f32>(&parameters, seed, *compiler);
        random_requests_by::<f64>(&parameters, seed + 1, *compiler);
    }
}

#[test]
fn no_request_is_undefined() {
    if !have(&[GCC], "C without a library under sanitizers") {
        return;
    }
    let options = [
        "-std=c99",
        "-O1",
        "-g",
        "-fsanitize=address,undefined,float-cast-overflow",
        "-fno-sanitize-recover=all",
    ];
    for seed in 20..23 {
        let parameters = random_damper::damper(&mut Random(seed));
        random_requests_by::<f32>(&parameters, seed, (GCC, &options));
        random_requests_by::<f64>(&parameters, seed, (GCC, &options));
    }
}

/// Writes two dampers, one per scalar type, and a program that reports whether the compiler kept their bits.
pub fn two_dampers(folder: &Path) {
    let parameters = damper("in-service", &[]);
    let single: Damper<f32> = parameters.build(STEP_S).expect("a preset");
    let double: Damper<f64> = parameters.build(STEP_S).expect("a preset");
    export(folder, "front", &single);
    export(folder, "rear", &double);
    let main = "#include \"front.h\"\n#include \"rear.h\"\n#include \"front.h\"\n\n\
         int main(void)\n{\n    return front_digest(&front_as_built) == FRONT_DIGEST \
         && rear_digest(&rear_as_built) == REAR_DIGEST ? 0 : 1;\n}\n";
    std::fs::write(folder.join("main.c"), main).expect("a writable folder");
    std::fs::write(folder.join("main.cpp"), main).expect("a writable folder");
    let one = "#include \"front.c\"\n#include \"rear.c\"\n#include \"main.c\"\n";
    std::fs::write(folder.join("one.c"), one).expect("a writable folder");
}

#[test]
fn two_dampers_are_in_one_program_of_c_or_cpp() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    two_dampers(folder);
    let program = folder.join("program");
    for (tool, options) in compilers() {
        for sources in [&["front.c", "rear.c", "main.c"][..], &["one.c"]] {
            let mut compiler = compiler(tool, options);
            succeed(
                compiler
                    .args(sources)
                    .arg("-o")
                    .arg(&program)
                    .current_dir(folder),
            );
            succeed(&mut Command::new(&program));
        }
    }
    if !have(&[GCC, GXX], "C without a library in a program of C++") {
        return;
    }
    succeed(
        compiler(GCC, &["-std=c99", "-O2", "-c"])
            .args(["front.c", "rear.c"])
            .current_dir(folder),
    );
    for standard in ["-std=c++11", "-std=c++20"] {
        let mut compiler = compiler(GXX, &[standard, "-O2"]);
        compiler
            .args(["main.cpp", "front.o", "rear.o", "-o"])
            .arg(&program);
        succeed(compiler.current_dir(folder));
        succeed(&mut Command::new(&program));
    }
}

/// Checks the digest itself: it detects a compiler that uses fused multiply-add.
#[test]
#[cfg(target_arch = "x86_64")]
fn a_fused_product_changes_the_digest() {
    if !have(&[GCC], "fused products found out") || !is_x86_feature_detected!("fma") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    two_dampers(folder);
    let program = folder.join("program");
    let fused = |name: &str| {
        let file = folder.join(name);
        let text = std::fs::read_to_string(&file).expect("it was exported");
        let without = text.replace("#pragma GCC optimize(\"fp-contract=off\")\n", "");
        assert_ne!(text, without, "the line is there");
        std::fs::write(&file, without).expect("a writable folder");
    };
    let run = || {
        let mut compiler = compiler(GCC, &["-std=gnu11", "-O2", "-mfma"]);
        succeed(
            compiler
                .args(["front.c", "rear.c", "main.c", "-o"])
                .arg(&program)
                .current_dir(folder),
        );
        Command::new(&program).status().expect("it starts").code()
    };
    assert_eq!(run(), Some(0));
    for name in ["front.c", "rear.c"] {
        two_dampers(folder);
        fused(name);
        assert_eq!(run(), Some(1), "{name}");
    }
}

#[test]
fn options_that_would_change_the_bits_are_errors() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    two_dampers(folder.path());
    let refused = |tool: Tool, options: &[&str]| {
        let mut compiler = compiler(tool, &["-std=c99", "-ffreestanding", "-c", "-o", "front.o"]);
        let output = compiler
            .args(options)
            .arg("front.c")
            .current_dir(folder.path())
            .output();
        let output = output.expect("it starts");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        !output.status.success() && message.contains("would not be those of the model")
    };
    for tool in [GCC, CLANG] {
        if !have(&[tool], "options refused by C without a library") {
            continue;
        }
        assert!(!refused(tool, &["-O2"]), "{tool:?}");
        for option in ["-ffast-math", "-ffinite-math-only"] {
            assert!(refused(tool, &[option]), "{tool:?} {option}");
        }
    }
    #[cfg(target_arch = "x86_64")]
    if have(&[GCC], "32-bit code without SSE, refused") {
        assert!(refused(GCC, &["-m32", "-mfpmath=387"]));
        assert!(!refused(GCC, &["-m32", "-msse2", "-mfpmath=sse"]));
    }
}

/// Names that the object file of an exported source leaves undefined.
pub fn left_to_others(compiler: &mut Command, source: &str, folder: &Path) -> Vec<String> {
    use object::{Object, ObjectSymbol};
    let object = folder.join("object.o");
    compiler
        .args(["-std=c99", "-ffreestanding", "-c", source, "-o"])
        .arg(&object);
    succeed(compiler.current_dir(folder));
    let bytes = std::fs::read(&object).expect("an object");
    let object = object::File::parse(&*bytes).expect("an object");
    let needed = object.symbols().filter(|symbol| symbol.is_undefined());
    let named = needed.filter_map(|symbol| symbol.name().ok().map(str::to_owned));
    named.filter(|name| !name.is_empty()).collect()
}

#[test]
fn it_needs_no_library() {
    if !have(&[GCC, ARM_GCC], "what C without a library needs") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    two_dampers(folder);
    for optimisation in ["-O0", "-O2", "-Os"] {
        for source in ["front.c", "rear.c"] {
            let left = left_to_others(&mut compiler(GCC, &[optimisation]), source, folder);
            assert!(left.is_empty(), "{source} {optimisation}: {left:?}");
            for processor in ["-mcpu=cortex-m0", "-mcpu=cortex-m4"] {
                let mut compiler = compiler(ARM_GCC, &[optimisation, processor, "-mthumb"]);
                let mut left = left_to_others(&mut compiler, source, folder);
                // The compiler itself supplies arithmetic that the processor lacks.
                left.retain(|name| {
                    !name.starts_with("__aeabi_") && !name.starts_with("__gnu_thumb1_case")
                });
                assert!(
                    left.is_empty(),
                    "{source} {processor} {optimisation}: {left:?}"
                );
            }
        }
    }
}

/// Text of the first code block (between lines of three backquotes) that follows `after` in a document.
pub fn block<'a>(document: &'a str, after: &str) -> &'a str {
    let (_, rest) = document.split_once(after).expect("what is before");
    let (_, rest) = rest.split_once("\n```").expect("a block");
    let (_, rest) = rest.split_once('\n').expect("a block");
    rest.split_once("```").expect("its end").0
}

#[test]
fn the_documents_example_prints_what_it_says() {
    let text = document::read("docs/portable-c.md");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let parameters = damper("in-service", &[]);
    export::<f32>(
        folder,
        "in_service",
        &parameters.build(STEP_S).expect("a preset"),
    );
    std::fs::write(folder.join("main.c"), block(&text, "`main.c`:")).expect("a writable folder");
    for (tool, options) in compilers() {
        let mut compiler = compiler(tool, options);
        succeed(
            compiler
                .args(["main.c", "in_service.c", "-o", "main"])
                .current_dir(folder),
        );
        let output = succeed(&mut Command::new(folder.join("main")));
        let printed = String::from_utf8_lossy(&output.stdout);
        assert_eq!(
            printed,
            block(&text, "prints"),
            "{} {options:?}",
            tool.program
        );
    }
}
