//! What is asked for, from what was typed.

use super::{Arguments, Follow};
use crate::fit::screw::Request;
use crate::fit::screw::groups::Joint;
use crate::fit::screw::in_motion::Demand;
use crate::ground::problem::{Outcome, Problem};

pub(super) fn request(arguments: &Arguments) -> Outcome<Request> {
    let limit = arguments.residual_um;
    if !(limit > 0.0 && limit < 1e6) {
        return Err(Problem::new(
            format!("is {limit}"),
            "give the largest residual in µm, such as 3",
        )
        .in_column("--residual-um"));
    }
    Ok(Request {
        residual: limit * 1e-6,
        coverage: f64::from(arguments.coverage),
        extremes: arguments.leave_out.extremes(),
        joint: if arguments.continuous {
            Joint::Continuous
        } else {
            Joint::Free
        },
        smooth: arguments.follow == Follow::Groups,
    })
}

pub(super) fn demand(arguments: &Arguments) -> Outcome<Demand> {
    let speed = arguments.speed_m_min;
    match (1.0..=100.0).contains(&speed) {
        true => Ok(Demand::at(speed / 60.0)),
        false => Err(Problem::new(
            format!("is {speed}"),
            "give a speed in m/min between 1 and 100",
        )
        .in_column("--speed-m-min")),
    }
}
