//! The serial port.

use embassy_executor::{SpawnError, Spawner};

use crate::board::Line;
use crate::server::BankServer;

/// Starts the task of the link.
///
/// # Errors
/// It runs already.
pub fn start(spawner: Spawner, server: BankServer, line: Line) -> Result<(), SpawnError> {
    spawner.spawn(serve(server, line)?);
    Ok(())
}

/// Serves the link for ever.
#[embassy_executor::task]
async fn serve(mut server: BankServer, line: Line) {
    let (mut sender, mut receiver) = line;
    loop {
        let kind = server.serve(&mut receiver, &mut sender).await;
        // The host sends again what a disturbance destroyed.
        log::warn!("link: {kind:?}");
    }
}
