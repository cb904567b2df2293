//! Trends of fleets: fits against certified numbers, coverage of the intervals, and fleets with known wear.

mod fit;
mod fleet;
mod forecast;
mod limits;
mod recordings;
