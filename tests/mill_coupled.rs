//! Robot and cut together, at one pose: what must hold whatever the robot.

use ident::cutting::cutter::{Cutter, Fineness};
use ident::cutting::dexel::Stock;
use ident::cutting::{Material, Tool};
use ident::ground::spatial::{IDENTITY, M3, V3, dot, norm, rotate, scale, sub};
use ident::motion::elastic;
use ident::process::pose::Carrier;
use ident::process::rigid::Rigid;
use ident::process::run::{Cut, Outcome, Settings, mill};
use ident::process::springs::Springs;
use ident::process::structure::Structure;
use ident::process::swinging::Swinging;
use ident::process::way::{Row, Way};
use ident::robot::Robot;
use ident::robot::joint_effect::JointEffect;
use ident::robot::load::load;
use std::f64::consts::{FRAC_PI_6, TAU};

const MM: f64 = 1e-3;
const SPINDLE: f64 = 10_000.0 / 60.0 * TAU;

fn robot(stiffer: f64) -> Robot {
    let mut robot = load("kr210", None).unwrap().robot;
    for (_, spring) in robot.springs_mut() {
        spring.stiffness *= stiffer;
        spring.damping *= stiffer.sqrt();
    }
    robot
}

/// The joints at rest, rad.
fn way_joints() -> Vec<f64> {
    let degrees = [0.0, -60.0, 80.0, 0.0, 70.0, 0.0];
    degrees.map(f64::to_radians).to_vec()
}

/// Along x at 3000 mm/min through a block from 0 to 40 mm, 2 mm deep, the joints at rest.
fn way() -> Way {
    let row = |i: usize| {
        let x = -0.010 + 0.05 * 0.012 * i as f64;
        Row {
            time_s: 0.012 * i as f64,
            s_m: x + 0.010,
            tip: [x, 0.0, -2.0 * MM],
            axis: [0.0, 0.0, 1.0],
            joints: way_joints(),
        }
    };
    Way::new((0..60).map(row).collect()).unwrap()
}

fn cutter(width: f64, steps: usize) -> Cutter {
    let tool = Tool {
        flute_m: 32.0 * MM,
        ..Tool::square(8.0 * MM, 2, FRAC_PI_6)
    };
    let fineness = Fineness {
        steps,
        ..Fineness::usual(&tool)
    };
    let stock = Stock::block(
        [0.0, -15.0 * MM, -8.0 * MM],
        [40.0 * MM, width, 0.0],
        fineness.spacing_m,
    );
    let al7075 = Material::linear_edge([1319.41, 788.83, 48.75, 19.65, 26.77, 2.05]);
    Cutter::new(&tool, &al7075, stock.unwrap(), fineness, [0.0, 0.0, 1.0])
}

fn run(structure: &mut dyn Structure, cutter: &mut Cutter) -> Outcome {
    let settings = Settings {
        spindle_rad_s: SPINDLE,
    };
    mill(&way(), cutter, structure, &settings, |_| {}).unwrap()
}

fn carrier(stiffer: f64) -> Carrier {
    Carrier::new(elastic(&robot(stiffer)), IDENTITY)
}

fn springs(stiffer: f64) -> Springs {
    Springs::new(carrier(stiffer), &way().at(0.0)).unwrap()
}

fn swinging(stiffer: f64, steps: usize) -> Swinging {
    Swinging::new(carrier(stiffer), &way().at(0.0), SPINDLE, steps).unwrap()
}

/// The robot with a gap and contacts in its joints.
fn loose(gap_a1: f64) -> Carrier {
    let mut robot = robot(1.0);
    for (name, spring) in robot.springs_mut() {
        match name.as_str() {
            "A1" => spring.backlash = vec![gap_a1],
            "A5" => spring.backlash = vec![1.5e-4],
            "A3" => {
                let values = vec![2e-5, 400.0, 1.0, 0.0];
                spring.effects = vec![JointEffect::new("hysteresis", values).unwrap()];
            }
            _ => {}
        }
    }
    Carrier::new(elastic(&robot), IDENTITY)
}

/// Force and deviation in the middle of the cut: mean over the stations from x = 14 to 24 mm.
fn middle(out: &Outcome) -> (V3, V3) {
    let inside: Vec<_> = out
        .course
        .iter()
        .filter(|c| (14.0 * MM..24.0 * MM).contains(&c.tip[0]))
        .collect();
    let mean = |of: &dyn Fn(usize) -> V3| {
        [0, 1, 2].map(|k| (0..inside.len()).map(|i| of(i)[k]).sum::<f64>() / inside.len() as f64)
    };
    (mean(&|i| inside[i].force), mean(&|i| inside[i].deviation))
}

fn compliance() -> M3 {
    carrier(1.0)
        .held(&way().at(0.0).joints)
        .unwrap()
        .compliance()
}

fn close(a: V3, b: V3, share: f64) {
    let size = norm(b);
    assert!(norm(sub(a, b)) < share * size, "{a:?} is not {b:?}");
}

#[test]
fn springs_a_thousand_times_stiffer_are_rigid() {
    let rigid = run(&mut Rigid, &mut cutter(15.0 * MM, 120));
    for stiff in [
        run(&mut springs(1e3), &mut cutter(15.0 * MM, 120)),
        run(&mut swinging(1e3, 120), &mut cutter(15.0 * MM, 120)),
    ] {
        close(middle(&stiff).0, middle(&rigid).0, 3e-3);
        assert!((stiff.removed_m3 / rigid.removed_m3 - 1.0).abs() < 1e-3);
        assert!(norm(middle(&stiff).1) < 2e-3 * MM);
    }
}

#[test]
fn springs_stand_where_compliance_and_force_put_them() {
    let out = run(&mut springs(1.0), &mut cutter(0.0, 120));
    let (force, deviation) = middle(&out);
    close(deviation, rotate(&compliance(), force), 5e-3);
    assert!(norm(deviation) > 0.05 * MM);
}

/// Along −x at 630 mm/min on the side of a block from 0 to 30 mm, 2.6 mm wide, by three teeth of 10 mm.
fn aside(stiffer: f64) -> Outcome {
    let row = |i: usize| {
        let way = 0.0105 * 0.012 * i as f64;
        Row {
            time_s: 0.012 * i as f64,
            s_m: way,
            tip: [0.036 - way, -2.4 * MM, -2.3 * MM],
            axis: [0.0, 0.0, 1.0],
            joints: way_joints(),
        }
    };
    let way = Way::new((0..330).map(row).collect()).unwrap();
    let tool = Tool {
        flute_m: 30.0 * MM,
        ..Tool::square(5.0 * MM, 3, FRAC_PI_6)
    };
    let fineness = Fineness::usual(&tool);
    let stock = Stock::block(
        [0.0, 0.0, -12.0 * MM],
        [30.0 * MM, 20.0 * MM, 0.0],
        fineness.spacing_m,
    );
    let material = Material::linear_edge([767.0, 168.8, 222.0, 27.7, 26.6, 0.7]);
    let mut cutter = Cutter::new(&tool, &material, stock.unwrap(), fineness, [0.0, 0.0, 1.0]);
    let mut springs = Springs::new(carrier(stiffer), &way.at(0.0)).unwrap();
    let settings = Settings {
        spindle_rad_s: 8500.0 / 60.0 * TAU,
    };
    mill(&way, &mut cutter, &mut springs, &settings, |_| {}).unwrap()
}

/// Width and depth of the cut follow the tool a tooth late: a soft robot must come to rest all the same, and take less the softer it is.
#[test]
fn springs_come_to_rest_however_soft() {
    let mut taken = f64::INFINITY;
    for stiffer in [1.0, 0.5, 0.25, 0.12] {
        let out = aside(stiffer);
        assert!(
            out.removed_m3 < taken,
            "{stiffer}: {} after {taken}",
            out.removed_m3
        );
        taken = out.removed_m3;
        let inside = |c: &&Cut| (0.010..0.020).contains(&c.tip[0]);
        let forces: Vec<V3> = out.course.iter().filter(inside).map(|c| c.force).collect();
        let step = |w: &[V3]| norm(sub(w[1], w[0])) / norm(w[0]);
        let most = forces.windows(2).map(step).fold(0.0, f64::max);
        assert!(
            most < 0.03,
            "{stiffer}: forces jump by {most:.3} of themselves"
        );
    }
}

#[test]
fn a_swinging_robot_stands_on_average_where_springs_would() {
    let mut swinging = swinging(1.0, 120);
    let out = run(&mut swinging, &mut cutter(0.0, 120));
    let (force, deviation) = middle(&out);
    close(deviation, rotate(&compliance(), force), 0.05);
    let energy = out.energy.unwrap();
    assert!(energy.gap() < 2e-3 && energy.damped > 0.0, "{energy:?}");
}

#[test]
fn halving_the_step_moves_the_mean_deviation_by_less_than_one_percent() {
    let [coarse, fine] = [120, 240].map(|steps| {
        let out = run(&mut swinging(1.0, steps), &mut cutter(0.0, steps));
        middle(&out).1
    });
    close(coarse, fine, 0.01);
}

/// Deviations over a second in which axis 1 goes there and back, the tool in a material without forces, or beside it.
fn swung(rpm: f64, beside: bool) -> Outcome {
    let row = |i: usize| {
        let time_s = 4e-3 * f64::from(i as u32);
        let part = (time_s / 0.4).min(1.0);
        let turn = 0.02 * (1.0 - (TAU * part).cos());
        Row {
            time_s,
            s_m: 0.4 * time_s,
            // so far that the course has a station every few milliseconds
            tip: [0.4 * time_s, if beside { -0.5 } else { 0.0 }, -2.0 * MM],
            axis: [0.0, 0.0, 1.0],
            joints: [turn, -1.0, 1.4, 0.0, 1.2, 0.0].to_vec(),
        }
    };
    let way = Way::new((0..250).map(row).collect()).unwrap();
    let spindle_rad_s = rpm / 60.0 * TAU;
    let tool = Tool::square(8.0 * MM, 2, FRAC_PI_6);
    let low = [0.0, -15.0 * MM, -8.0 * MM];
    let stock = Stock::block(low, [0.4, 15.0 * MM, 0.0], 2.0 * MM).unwrap();
    let nothing = Material::linear_edge([0.0; 6]);
    let fineness = Fineness::usual(&tool);
    let mut cutter = Cutter::new(&tool, &nothing, stock, fineness, [0.0, 0.0, 1.0]);
    let start = way.at(0.0);
    let mut robot = Swinging::new(carrier(1.0), &start, spindle_rad_s, cutter.steps()).unwrap();
    let settings = Settings { spindle_rad_s };
    mill(&way, &mut cutter, &mut robot, &settings, |_| {}).unwrap()
}

/// The inertia of a motion loads the robot when it moves so, however long the teeth take to pass.
#[test]
fn the_swing_of_a_motion_does_not_know_the_spindle() {
    let runs = [(20_000.0, false), (8_000.0, false), (8_000.0, true)];
    let [fast, slow, beside] = runs.map(|(rpm, beside)| swung(rpm, beside));
    let times: Vec<f64> = (30..90).map(|i| 0.01 * f64::from(i)).collect();
    let largest = |of: &dyn Fn(f64) -> V3| times.iter().map(|t| norm(of(*t))).fold(0.0, f64::max);
    let size = largest(&|t| fast.deviation_at(t));
    for other in [&slow, &beside] {
        let off = largest(&|t| sub(fast.deviation_at(t), other.deviation_at(t)));
        println!("{:.4} of {size:.6} m", off / size);
        assert!(off < 0.04 * size, "{off} of {size}");
    }
}

/// No weight presses the first axis: the force of the cut closes its gap, and the tool goes by half of it, times
/// its lever.
#[test]
fn the_cut_closes_a_gap_that_no_weight_presses() {
    let gap = 2e-4;
    let begin = way().at(0.0);
    let of = |gap: f64| -> [Outcome; 2] {
        let mut springs = Springs::new(loose(gap), &begin).unwrap();
        let mut swinging = Swinging::new(loose(gap), &begin, SPINDLE, 120).unwrap();
        [
            run(&mut springs, &mut cutter(0.0, 120)),
            run(&mut swinging, &mut cutter(0.0, 120)),
        ]
    };
    let held = loose(gap).held(&begin.joints).unwrap();
    let first = held.linear.names.iter().position(|n| n == "A1").unwrap();
    let lever = held.linear.tool[first];
    let (closed, open) = (of(0.0), of(gap));
    for (closed, open) in closed.iter().zip(&open) {
        let [(force, before), (_, after)] = [closed, open].map(middle);
        let side = dot(lever, force).signum();
        let wanted = scale(0.5 * gap * side, lever);
        close(sub(after, before), wanted, 0.1);
    }
    close(middle(&open[1]).1, middle(&open[0]).1, 0.06);
}

#[test]
fn gaps_and_dry_contacts_make_no_energy() {
    let mut swinging = Swinging::new(loose(2e-4), &way().at(0.0), SPINDLE, 120).unwrap();
    let out = run(&mut swinging, &mut cutter(0.0, 120));
    let energy = out.energy.unwrap();
    assert!(energy.gap() < 5e-3 && energy.damped > 0.0, "{energy:?}");
}
