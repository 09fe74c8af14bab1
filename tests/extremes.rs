//! Extremes (theory 6.11): every case ends with all audits green, or with the physical reason that is named for it.

#[path = "extremes/bench.rs"]
mod bench;
#[path = "extremes/contrast.rs"]
mod contrast;
#[path = "extremes/meeting.rs"]
mod meeting;
#[path = "extremes/numbers.rs"]
mod numbers;
#[path = "extremes/projection.rs"]
mod projection;
#[path = "extremes/rates.rs"]
mod rates;
#[path = "extremes/steep.rs"]
mod steep;
