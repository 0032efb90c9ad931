//! From a robot to the chain that is computed.

use super::chain::Chain;
use crate::ground::spatial::normals;
use crate::robot::{ElasticAxis, Joint, Robot};

/// The driven joints only, everything rigid: n = number of joints.
pub fn rigid(robot: &Robot) -> Chain {
    let mut chain = Chain::default();
    for (i, joint) in robot.joints.iter().enumerate() {
        drive(&mut chain, joint, false);
        let here = robot.elastic.iter().filter(|axis| axis.after == i + 1);
        let bodies = here.filter_map(|axis| axis.body);
        bodies.for_each(|body| chain.load(&body));
    }
    finish(chain, robot)
}

/// Drives, bearings and further virtual axes, in the order foundation, then per joint: tilt about
/// two axes across the drive axis, drive with its body, axes fixed to that link. The tool's body
/// sits behind the last axis.
pub fn elastic(robot: &Robot) -> Chain {
    let mut chain = Chain::default();
    axes(&mut chain, robot, 0);
    for (i, joint) in robot.joints.iter().enumerate() {
        tilt(&mut chain, joint);
        drive(&mut chain, joint, true);
        axes(&mut chain, robot, i + 1);
    }
    finish(chain, robot)
}

fn drive(chain: &mut Chain, joint: &Joint, elastic: bool) {
    chain.drives.push(chain.len());
    let spring = joint.drive.clone().filter(|_| elastic);
    chain.push(&joint.name, joint.axis, joint.point, joint.link, spring);
}

/// Two equal virtual axes across the drive axis, before its rotation (source 004, section 11.2.1).
fn tilt(chain: &mut Chain, joint: &Joint) {
    let Some(spring) = &joint.tilt else { return };
    let (first, second) = normals(joint.axis);
    for axis in [first, second] {
        chain.push(
            joint.tilt_site(),
            axis,
            joint.point,
            None,
            Some(spring.clone()),
        );
    }
}

fn axes(chain: &mut Chain, robot: &Robot, after: usize) {
    let here = robot.elastic.iter().filter(|axis| axis.after == after);
    here.for_each(
        |ElasticAxis {
             name,
             axis,
             point,
             spring,
             body,
             ..
         }| {
            chain.push(name, *axis, *point, *body, Some(spring.clone()));
        },
    );
}

fn finish(mut chain: Chain, robot: &Robot) -> Chain {
    if let Some(body) = &robot.tool.body {
        chain.load(body);
    }
    chain.end_at(robot.tool.tcp, robot.tool.rotation);
    chain
}
