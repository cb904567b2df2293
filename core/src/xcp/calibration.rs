//! Commands of the calibration segment and its pages.

use super::packet::{Parameters, Response};
use super::protocol::Command;
use super::{ErrorCode, Memory, Page, Segment};

/// Bits of SET_CAL_PAGE.
const MODEL: u8 = 0x01;
const MASTER: u8 = 0x02;
const ALL_SEGMENTS: u8 = 0x80;

/// Page properties: model and master read and write it, whether the other uses it or not.
const PAGE_PROPERTIES: u8 = 0x3F;

pub(super) fn execute(
    command: Command,
    mut parameters: Parameters,
    memory: &mut impl Memory,
) -> Result<Response, ErrorCode> {
    let segment = memory.segment();
    match command {
        Command::GetPagProcessorInfo => {
            let segments = u8::from(segment.is_some());
            Ok(Response::with(&[&[segments, 0]]))
        }
        Command::GetSegmentInfo => segment_info(parameters, segment),
        Command::GetPageInfo => {
            parameters.skip(1)?;
            let number = parameters.byte()?;
            check_page(segment, number, parameters.byte()?)?;
            Ok(Response::with(&[&[PAGE_PROPERTIES, 0]]))
        }
        Command::GetCalPage => {
            let mode = parameters.byte()?;
            checked(segment, parameters.byte()?)?;
            let of = match mode {
                MODEL => Page::Model,
                MASTER => Page::Master,
                _ => return Err(ErrorCode::ModeNotValid),
            };
            Ok(Response::with(&[&[0, 0, memory.page(of)]]))
        }
        Command::SetCalPage => {
            let mode = parameters.byte()?;
            let number = match parameters.byte()? {
                _ if mode & ALL_SEGMENTS != 0 => 0,
                number => number,
            };
            let page = parameters.byte()?;
            check_page(segment, number, page)?;
            if mode & (MODEL | MASTER) == 0 || mode & !(MODEL | MASTER | ALL_SEGMENTS) != 0 {
                return Err(ErrorCode::ModeNotValid);
            }
            if mode & MODEL != 0 {
                memory.set_page(Page::Model, page)?;
            }
            if mode & MASTER != 0 {
                memory.set_page(Page::Master, page)?;
            }
            Ok(Response::positive())
        }
        Command::CopyCalPage => {
            let [source, from] = [parameters.byte()?, parameters.byte()?];
            let [destination, to] = [parameters.byte()?, parameters.byte()?];
            check_page(segment, source, from)?;
            check_page(segment, destination, to)?;
            memory.copy_page(from, to)?;
            Ok(Response::positive())
        }
        _ => Err(ErrorCode::UnknownCommand),
    }
}

fn segment_info(
    mut parameters: Parameters,
    segment: Option<Segment>,
) -> Result<Response, ErrorCode> {
    let mode = parameters.byte()?;
    let segment = checked(segment, parameters.byte()?)?;
    match (mode, parameters.byte()?) {
        (0, 0) => Ok(Response::with(&[&[0; 3], &segment.address.to_le_bytes()])),
        (0, 1) => Ok(Response::with(&[&[0; 3], &segment.length.to_le_bytes()])),
        // Address extension, mappings, compression and encryption: none.
        (1, _) => Ok(Response::with(&[&[segment.pages, 0, 0, 0, 0]])),
        _ => Err(ErrorCode::OutOfRange),
    }
}

/// Returns the only segment, which has number 0.
fn checked(segment: Option<Segment>, number: u8) -> Result<Segment, ErrorCode> {
    segment
        .filter(|_| number == 0)
        .ok_or(ErrorCode::SegmentNotValid)
}

fn check_page(segment: Option<Segment>, number: u8, page: u8) -> Result<(), ErrorCode> {
    match page < checked(segment, number)?.pages {
        true => Ok(()),
        false => Err(ErrorCode::PageNotValid),
    }
}
