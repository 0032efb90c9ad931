//! RAPID for ABB controllers: one `.mod`.

use super::chords::{arcs, is_straight, spelled};
use super::text::{comment, decimals, degrees, identifier, mm};
use super::{Program, ProgramFile, ProgramMove};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, Pose, V3};
use crate::measurement::toolpath::{Arc, Shape};
use crate::path::quaternion::Quaternion;
use std::f64::consts::PI;

/// Most motions of a procedure.
const PROCEDURE: usize = 5000;
/// Largest angle of one MoveC, rad.
const MOST_ANGLE: f64 = 0.9 * PI;
/// External axes that are not there.
const EXTERNAL: &str = "[9E9,9E9,9E9,9E9,9E9,9E9]";
/// Joints of the robots that RAPID knows.
const JOINTS: usize = 6;

pub(super) fn write(program: &Program) -> Outcome<Vec<ProgramFile>> {
    let name = identifier(&program.name, 28);
    let mut text = format!("MODULE {name}\n");
    for line in &program.comments {
        text += &format!("  ! {}\n", comment(line));
    }
    text += "  ! the load of the tool is not known here: set mass and centre of gravity\n";
    text += &format!(
        "  PERS tooldata {name}_t := [TRUE,{},[1,[0,0,1],[1,0,0,0],0,0,0]];\n",
        pose(&program.tool)
    );
    text += &format!(
        "  PERS wobjdata {name}_w := [FALSE,TRUE,\"\",{},[[0,0,0],[1,0,0,0]]];\n",
        pose(&program.base)
    );
    let moves = spelled(&program.moves, shortened);
    let parts: Vec<&[ProgramMove]> = moves.chunks(PROCEDURE).collect();
    text += &format!("  PROC {name}_main()\n");
    text += &approach(program, &name)?;
    text += &line(&program.moves[0], 0.0, &name);
    for i in 0..parts.len() {
        text += &format!("    {name}_{};\n", i + 1);
    }
    text += "  ENDPROC\n";
    let mut here = program.moves[0].to;
    for (i, part) in parts.iter().enumerate() {
        text += &format!("  PROC {name}_{}()\n", i + 1);
        for next in *part {
            text += &motion(here, next, &name);
            here = next.to;
        }
        text += "  ENDPROC\n";
    }
    text += "ENDMODULE\n";
    Ok(vec![ProgramFile {
        name: format!("{name}.mod"),
        text,
    }])
}

/// Long arcs become several.
fn shortened(from: &ProgramMove, next: &ProgramMove, arc: &Arc) -> Option<Vec<ProgramMove>> {
    let count = (arc.angle / MOST_ANGLE).ceil() as usize;
    (arc.angle > MOST_ANGLE).then(|| {
        let joint = next.blend.max(1e-4);
        let mut pieces = arcs(from, next, arc, count);
        pieces[..count - 1]
            .iter_mut()
            .for_each(|piece| piece.blend = joint);
        pieces
    })
}

fn approach(program: &Program, name: &str) -> Outcome<String> {
    let Some(joints) = &program.start_joints else {
        return Ok(String::new());
    };
    if joints.len() != JOINTS {
        let what = format!(
            "RAPID knows robots of six joints, this one has {}",
            joints.len()
        );
        return Err(Problem::new(what, "choose another language with --program"));
    }
    let angles: Vec<String> = joints.iter().map(|q| degrees(*q)).collect();
    let angles = angles.join(",");
    Ok(format!(
        "    MoveAbsJ [[{angles}],{EXTERNAL}],v100,fine,{name}_t;\n"
    ))
}

fn motion(here: V3, next: &ProgramMove, name: &str) -> String {
    let Shape::Arc(arc) = next.shape else {
        return line(next, next.blend, name);
    };
    if is_straight(here, &arc) {
        return line(next, next.blend, name);
    }
    let middle = target(arc.at(here, 0.5 * arc.angle), &next.rotation);
    let end = target(next.to, &next.rotation);
    format!(
        "    MoveC {middle},{end},{}",
        ending(next, next.blend, name)
    )
}

fn line(next: &ProgramMove, blend: f64, name: &str) -> String {
    format!(
        "    MoveL {},{}",
        target(next.to, &next.rotation),
        ending(next, blend, name)
    )
}

/// Speed, zone, tool and work object.
fn ending(next: &ProgramMove, blend: f64, name: &str) -> String {
    let speed = decimals(next.feed * 1e3, 6);
    let zone = match mm(blend).as_str() {
        "0" => "fine".to_string(),
        radius => {
            let wide = decimals(1.5e3 * blend, 6);
            let turn = decimals(150.0 * blend, 6);
            format!("[FALSE,{radius},{wide},{wide},{turn},{wide},{turn}]")
        }
    };
    format!("[{speed},500,5000,1000],{zone},{name}_t\\WObj:={name}_w;\n")
}

fn target(point: V3, rotation: &M3) -> String {
    let [x, y, z] = point.map(mm);
    format!(
        "[[{x},{y},{z}],{},[0,0,0,0],{EXTERNAL}]",
        quaternion(rotation)
    )
}

fn pose(pose: &Pose) -> String {
    let [x, y, z] = pose.point.map(mm);
    format!("[[{x},{y},{z}],{}]", quaternion(&pose.rotation))
}

fn quaternion(rotation: &M3) -> String {
    let [w, x, y, z] = Quaternion::of(rotation).0.map(|part| decimals(part, 10));
    format!("[{w},{x},{y},{z}]")
}
