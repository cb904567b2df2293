//! The server of the bank.

use dashpot_device::Server;

use crate::bank::DAMPERS;
use crate::outputs::SerialOutputs;

/// The device with its outputs.
pub type BankServer = Server<'static, DAMPERS, DAMPERS, SerialOutputs>;
