//! The network: TCP at [`board::PORT`].

use dashpot_device::FewFrames;
use embassy_executor::{SpawnError, Spawner};
use embassy_net::tcp::TcpSocket;
use embassy_net::{Runner, Stack, StackResources};
use static_cell::ConstStaticCell;

use crate::board::{self, Line, NetworkCard};
use crate::server::BankServer;

/// Sockets of the stack: the link and DHCP.
const SOCKETS: usize = 2;

static RESOURCES: ConstStaticCell<StackResources<SOCKETS>> =
    ConstStaticCell::new(StackResources::new());

/// Requests that wait. The longest one, a damper, arrives in several parts.
static REQUESTS: ConstStaticCell<[u8; 4096]> = ConstStaticCell::new([0; 4096]);

/// Answers that the host has not acknowledged.
static ANSWERS: ConstStaticCell<[u8; 4096]> = ConstStaticCell::new([0; 4096]);

/// Starts the tasks of the network stack and of the link.
///
/// # Errors
/// They run already.
pub fn start(spawner: Spawner, server: BankServer, (card, seed): Line) -> Result<(), SpawnError> {
    let card = FewFrames::new(card);
    let (stack, runner) = embassy_net::new(card, board::address(), RESOURCES.take(), seed);
    spawner.spawn(run(runner)?);
    spawner.spawn(log_address(stack)?);
    spawner.spawn(serve(server, stack)?);
    Ok(())
}

/// Runs the network stack.
#[embassy_executor::task]
async fn run(mut runner: Runner<'static, FewFrames<NetworkCard>>) {
    runner.run().await;
}

/// Logs each address that the board gets.
#[embassy_executor::task]
async fn log_address(stack: Stack<'static>) {
    loop {
        stack.wait_config_up().await;
        if let Some(config) = stack.config_v4() {
            log::info!("link: port {} of {}", board::PORT, config.address);
        }
        stack.wait_config_down().await;
    }
}

/// Serves the link for ever, one host after the other.
#[embassy_executor::task]
async fn serve(mut server: BankServer, stack: Stack<'static>) {
    let mut socket = TcpSocket::new(stack, REQUESTS.take(), ANSWERS.take());
    loop {
        let kind = server.serve_tcp(&mut socket, board::PORT).await;
        log::info!("link: {kind:?}");
    }
}
