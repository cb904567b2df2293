//! `dashpot hybrid`: tests in which an actuator moves a real damper and the rest is simulated.

mod benchmark;
mod export;
mod plan;
mod record;
mod rig;

use super::failure::Outcome;

/// Move a real damper under a simulated vehicle: plan of a test, virtual rig, published benchmark.
#[derive(Debug, Clone, clap::Args)]
pub struct HybridArguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Clone, clap::Subcommand)]
enum Action {
    Benchmark(benchmark::BenchmarkArguments),
    Rig(rig::RigArguments),
    Export(export::ExportArguments),
    Plan(Box<plan::PlanArguments>),
}

/// Runs the command.
///
/// # Errors
/// An argument or a file is invalid.
pub fn run(arguments: &HybridArguments) -> Outcome<()> {
    match &arguments.action {
        Action::Benchmark(arguments) => benchmark::run(arguments),
        Action::Rig(arguments) => rig::run(arguments),
        Action::Export(arguments) => export::run(arguments),
        Action::Plan(arguments) => plan::run(arguments),
    }
}
