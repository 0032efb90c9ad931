//! `ident diagnose` on joint motion: hidden effects of an independent generator, and a real KR 300.

use crate::common;

use crate::joint_motion_generator::{NAMES, STRANGE, record};
use crate::judge;
use ident::findings::joint_motion::{MotionDiagnosis, diagnose};
use ident::fit::joint_motion_store::StoredMotion;
use ident::fit::parameter::Status;
use ident::ground::random::Random;
use ident::measurement::joint_motion::JointMotion;
use ident::measurement::table::Table;
use rayon::prelude::*;
use std::path::Path;

fn read(text: &str) -> JointMotion {
    let table = Table::from_reader(Path::new("run.csv"), text.as_bytes(), text.len() as u64);
    JointMotion::from_table(table.unwrap()).unwrap()
}

/// Every name in the answer, groups as `{a/b}`.
fn said(found: &MotionDiagnosis) -> Vec<String> {
    let causes = found.answer.causes.iter().map(|c| c.effect.to_string());
    let groups = found
        .answer
        .groups
        .iter()
        .map(|g| format!("{{{}}}", g.effects.join("/")));
    causes.chain(groups).collect()
}

fn holds(said: &[String], name: &str) -> bool {
    said.iter()
        .any(|s| s == name || s.trim_matches(['{', '}']).split('/').any(|p| p == name))
}

fn asked(variable: &str, default: u64) -> u64 {
    let text = std::env::var(variable).ok();
    text.and_then(|n| n.parse().ok()).unwrap_or(default)
}

#[test]
fn hidden_effects_are_named() {
    let (each, seed) = (
        asked("IDENT_BLIND_CASES", common::few_or_all(2, 16)),
        asked("IDENT_BLIND_SEED", 1),
    );
    let jobs: Vec<(&'static str, u64)> = NAMES
        .iter()
        .flat_map(|n| (0..each).map(move |i| (*n, i)))
        .collect();
    let answers: Vec<(&str, Vec<String>, &str, Vec<f64>)> = jobs
        .par_iter()
        .map(|(name, i)| {
            let (text, hidden) = record(name, seed * 1000 + i);
            let found = diagnose(&read(&text), None);
            if std::env::var_os("IDENT_BLIND_LIST").is_some() {
                println!(
                    "{i} {hidden:?}\n   {:?} {} {:?}",
                    said(&found),
                    found.answer.verdict.name(),
                    found.remarks
                );
                println!(
                    "   {:?} left {:.3}",
                    found.answer.candidates, found.answer.unexplained.share_of_variance
                );
            }
            let causes = &found.answer.causes;
            let told = causes.iter().filter(|c| c.effect != *name);
            let wrong: f64 = told.clone().count() as f64;
            let stated = causes.iter().map(|c| c.probability).sum();
            let sums = vec![stated, causes.len() as f64 - wrong, causes.len() as f64];
            (*name, said(&found), found.answer.verdict.name(), sums)
        })
        .collect();
    let (mut right, mut wrong, mut alarms) = (0.0, 0.0, 0.0);
    for name in NAMES {
        let own: Vec<_> = answers.iter().filter(|a| a.0 == name).collect();
        let text: Vec<String> = own
            .iter()
            .map(|a| format!("{} ({})", a.1.join("+"), a.2))
            .collect();
        println!("{name}: {}", text.join(", "));
        if name == "clean" {
            alarms = own.iter().filter(|a| !a.1.is_empty()).count() as f64 / each as f64;
            continue;
        }
        right += own
            .iter()
            .filter(|a| a.1.len() == 1 && holds(&a.1, name))
            .count() as f64;
        wrong += own
            .iter()
            .filter(|a| !a.1.is_empty() && !holds(&a.1, name))
            .count() as f64;
    }
    let sum = |k: usize| answers.iter().map(|a| a.3[k]).sum::<f64>();
    println!(
        "{} names stated with {:.3} in the mean, {:.3} of them right",
        sum(2),
        sum(0) / sum(2),
        sum(1) / sum(2)
    );
    let hidden = (each * (NAMES.len() as u64 - 1)) as f64;
    println!(
        "right {:.3} wrong {:.3} false alarms {alarms:.3} of {} cases",
        right / hidden,
        wrong / hidden,
        jobs.len()
    );
    assert!(right >= 0.9 * hidden && wrong <= 0.04 * hidden && alarms <= 0.03);
}

#[test]
fn what_no_cause_makes_takes_no_name() {
    let (each, seed) = (
        asked("IDENT_BLIND_CASES", common::few_or_all(2, 10)),
        asked("IDENT_BLIND_SEED", 1),
    );
    let mut named = [0; 2];
    for strange in STRANGE {
        let answers: Vec<MotionDiagnosis> = (0..each)
            .into_par_iter()
            .map(|i| diagnose(&read(&record(strange, seed * 1000 + i).0), None))
            .collect();
        let said: Vec<String> = answers.iter().map(|a| said(a).join("+")).collect();
        let open = |a: &&MotionDiagnosis| a.answer.verdict.name() == "unknown-cause";
        let unknown = answers.iter().filter(open).count();
        println!("{strange}: unknown {unknown} of {each}, named {said:?}");
        // a spring that stiffens has another stiffness, too
        let is_wrong =
            |s: &&String| !s.is_empty() && (strange, s.as_str()) != ("stiffening", "stiffness");
        named[0] += said.iter().filter(is_wrong).count();
        named[1] += said.iter().filter(|s| !s.is_empty()).count();
    }
    println!(
        "invented {} of {}, any name {}",
        named[0],
        4 * each,
        named[1]
    );
    assert!(named[0] as u64 * 20 <= 4 * each && named[1] as u64 * 6 <= 4 * each);
}

/// A late encoder misses nothing of its law, so that a loop and a jump a tenth as large are seen beside it.
#[test]
fn small_causes_are_named_beside_a_large_delay() {
    for (seed, small) in [(54_100_036, "hysteresis"), (54_400_116, "sensor_offset")] {
        let judged = judge::answer(judge::joint_motion::draw(seed));
        let named = |name: &str| judged.causes.iter().any(|c| c.0 == name);
        assert!(named("time_skew") && named(small), "{:?}", judged.causes);
    }
}

/// A joint that gravity does not load, swung by two sines: a row per reading with the twist and the torque (N·m behind the gear) of
/// time, speed and acceleration, encoders that scatter by 8 µrad, torques by a hundredth.
fn swung(rate_hz: f64, rows: usize, of: impl Fn([f64; 4]) -> [f64; 2]) -> String {
    let mut random = Random::new(11);
    let mut text = String::from(
        "# kind = \"joint-motion\"\n# gear_ratio = [100.0]\n\
         time_s,motor_angle_rad_1,link_angle_rad_1,motor_torque_Nm_1\n",
    );
    let (slow, fast) = ([0.5, 1.1, 0.3], [0.2, 2.9, 1.0]);
    for i in 0..rows {
        let t = i as f64 / rate_hz;
        let sum = |f: &dyn Fn([f64; 3]) -> f64| f(slow) + f(fast);
        let angle = sum(&|[a, w, p]| a * (w * t + p).sin());
        let speed = sum(&|[a, w, p]| a * w * (w * t + p).cos());
        let acceleration = sum(&|[a, w, p]| -a * w * w * (w * t + p).sin());
        let [twist, torque] = of([t, angle, speed, acceleration]);
        let link = angle + twist + 8e-6 * random.normal();
        let torque = 1e-2 * torque + 2e-2 * random.normal();
        text += &format!("{t:.4},{angle:.8},{link:.8},{torque:.5}\n");
    }
    text
}

const SPRING: f64 = 4e5;
const INERTIA: f64 = 300.0;
const OIL: f64 = 90.0;

fn effects(text: &str) -> Vec<&'static str> {
    let found = diagnose(&read(text), None);
    found.answer.causes.iter().map(|c| c.effect).collect()
}

/// Where the torque pays for inertia and friction alone and nobody states a spring, twist that follows the acceleration alone passed as
/// right whatever friction took of the torque. Friction of the link goes through the spring, whatever the rotor's inertia adds.
#[test]
fn friction_of_an_unloaded_drive_is_told_without_a_stated_spring() {
    for rotor in [0.0, 0.3, 1.0] {
        let drag = |v: f64, a: f64| (1.0 + rotor) * INERTIA * a + OIL * v;
        let of_drive = swung(100.0, 1500, |[_, _, v, a]| {
            [-INERTIA * a / SPRING, drag(v, a)]
        });
        let found = diagnose(&read(&of_drive), None);
        assert!(
            holds(&said(&found), "viscous_friction"),
            "{rotor}: {:?}",
            said(&found)
        );
        let through = |v: f64, a: f64| -(INERTIA * a + OIL * v) / SPRING;
        let of_link = swung(100.0, 1500, |[_, _, v, a]| [through(v, a), drag(v, a)]);
        assert_eq!(effects(&of_link), Vec::<&str>::new(), "{rotor}");
    }
}

/// A torque that was not measured tells nothing, and gives no numbers that are none.
#[test]
fn without_any_torque_nothing_is_presumed() {
    let text = swung(100.0, 1500, |[_, _, _, a]| [-INERTIA * a / SPRING, 0.0]);
    let none: String = text
        .lines()
        .map(|line| match line.rsplit_once(',') {
            Some((rest, torque)) if torque.parse::<f64>().is_ok() => format!("{rest},0.0\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let found = diagnose(&read(&none), None);
    let joint = &found.joints[0];
    assert!(
        joint
            .explained
            .iter()
            .chain(&joint.simulated)
            .all(|v| v.is_finite())
    );
    assert!(found.answer.discrepancy.rms.is_finite());
}

/// A link crosses its gap in tens of milliseconds, and comes to rest anywhere in it.
#[test]
fn a_gap_that_is_crossed_in_time_is_a_gap() {
    let at = std::cell::Cell::new(0.0);
    let text = swung(200.0, 3000, |[_, _, _, a]| {
        let torque = INERTIA * a;
        let side = -1e-4 * torque.signum();
        at.set(at.get() + (side - at.get()) * (1.0 - (-0.005_f64 / 0.05).exp()));
        [at.get() - torque / SPRING, torque]
    });
    assert_eq!(effects(&text), ["backlash"]);
}

/// The real run: front matter, header, rows.
fn real_run() -> Option<(Vec<String>, String, Vec<String>)> {
    let text = std::fs::read_to_string(common::shared("kr300/run_a.csv")?).unwrap();
    let facts: Vec<String> = text
        .lines()
        .take_while(|l| l.starts_with('#'))
        .map(String::from)
        .collect();
    let mut rest = text.lines().skip(facts.len()).map(String::from);
    let header = rest.next()?;
    Some((facts, header, rest.collect()))
}

fn diagnosed(facts: &[String], more: &str, header: &str, rows: &[String]) -> MotionDiagnosis {
    let text = format!(
        "{}\n{more}{header}\n{}\n",
        facts.join("\n"),
        rows.join("\n")
    );
    let robot = ident::robot::builtin::named("kr300").unwrap().unwrap();
    diagnose(&read(&text), Some(&robot))
}

fn no_stiffness(found: &MotionDiagnosis) {
    let stiffness: Vec<_> = found
        .parameters
        .iter()
        .filter(|p| p.name == "stiffness")
        .collect();
    assert_eq!(stiffness.len(), 3);
    for p in stiffness {
        assert_eq!(
            (p.status, p.value, p.ci95),
            (Status::NotIdentifiable, None, None),
            "{}",
            p.site
        );
    }
}

#[test]
fn a_real_kr300_has_a_skew_on_every_axis_and_no_stiffness() {
    let Some((facts, header, rows)) = real_run() else {
        return;
    };
    let found = diagnosed(&facts, "", &header, &rows);
    assert_eq!(found.answer.verdict.name(), "explained");
    let mut sites: Vec<&str> = found
        .answer
        .causes
        .iter()
        .map(|c| c.site.as_str())
        .collect();
    sites.sort_unstable();
    assert_eq!(sites, ["A1", "A2", "A3"]);
    for cause in &found.answer.causes {
        assert_eq!(cause.effect, "time_skew");
        assert!(
            (2.5e-3..3.3e-3).contains(&cause.parameters[0].1),
            "{:?}",
            cause.parameters
        );
    }
    assert!(found.answer.groups.is_empty());
    no_stiffness(&found);
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn thinned_and_cut_the_real_run_says_the_same() {
    let Some((facts, header, rows)) = real_run() else {
        return;
    };
    let thinned = [3, 5].map(|k| rows.iter().step_by(k).cloned().collect::<Vec<_>>());
    let cut = [(0, 1250), (1250, 2501), (500, 2000)];
    let cut = cut.map(|(a, b)| rows[a..b].to_vec());
    for part in thinned.iter().chain(&cut) {
        let found = diagnosed(&facts, "", &header, part);
        assert_eq!(found.answer.verdict.name(), "explained");
        let causes = &found.answer.causes;
        assert!(
            causes.len() == 3 && causes.iter().all(|c| c.effect == "time_skew"),
            "{:?}",
            said(&found)
        );
        no_stiffness(&found);
    }
}

#[test]
fn with_the_skew_declared_nothing_is_invented() {
    let Some((facts, header, rows)) = real_run() else {
        return;
    };
    for delay in [
        "0.0027",
        "0.0029",
        "0.003",
        "0.0031",
        "[0.0030, 0.0030, 0.0029]",
    ] {
        let declared = format!("# encoder_delay_s = {delay}\n");
        let parts = [&rows[..], &rows[..1250], &rows[1250..]];
        let some = if delay == "0.003" {
            3
        } else {
            common::few_or_all(1, 3)
        };
        for part in &parts[..some as usize] {
            let found = diagnosed(&facts, &declared, &header, part);
            assert!(said(&found).is_empty(), "{delay}: {:?}", said(&found));
            no_stiffness(&found);
        }
    }
}

fn ident(folder: &Path, arguments: &[&str]) -> std::process::Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ident"));
    command
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_verb_writes_a_model_that_loads_back_and_answers_the_same_twice() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("run.csv"), record("time_skew", 7).0).unwrap();
    let first = ident(folder.path(), &["diagnose", "run.csv", "--json"]);
    assert_eq!(first.status.code(), Some(1));
    assert_eq!(
        first.stdout,
        ident(folder.path(), &["diagnose", "run.csv", "--json"]).stdout
    );
    let json: serde_json::Value = serde_json::from_slice(&first.stdout).unwrap();
    assert_eq!(
        (&json["kind"], &json["synthetic"]),
        (&"joint-motion".into(), &true.into())
    );
    assert_eq!(json["causes"][0]["effect"], "time_skew");
    assert_eq!(json["causes"][0]["site"], "A2");
    let stored = StoredMotion::read(&folder.path().join("fits/run-extended.toml")).unwrap();
    assert!(stored.synthetic && stored.causes[0].effect == "time_skew");
    assert!(
        stored
            .parameters
            .iter()
            .any(|p| p.name == "delay" && p.value.is_some())
    );
    assert!(folder.path().join("reports/run-a2-twist.svg").is_file());
}

#[test]
fn what_is_wrong_is_refused_with_place_and_remedy() {
    let header = "time_s,motor_angle_deg_1,link_angle_deg_1,motor_torque_Nm_1";
    let rows: String = (0..80)
        .map(|i| format!("{},{i},{i},1\n", f64::from(i) * 0.01))
        .collect();
    let file = |facts: &str, header: &str, rows: &str| {
        format!("# kind = \"joint-motion\"\n{facts}{header}\n{rows}")
    };
    let cases = [
        (
            file(
                "",
                "time_s,motor_angle_deg_1,link_angle_deg_1,motor_torque_deg_1",
                &rows,
            ),
            "run.csv:2: `motor_torque_deg_1`",
        ),
        (
            file(
                "",
                "time_s,motor_angle_deg_1,link_angle_deg_1,force_N",
                &rows,
            ),
            "add a column `motor_torque_Nm_1`",
        ),
        (
            file("# gear_ratio = [100.0, 90.0]\n", header, &rows),
            "run.csv:2: `gear_ratio`: has 2 numbers for 1 joints",
        ),
        (
            file("# gear_ratio = -3.0\n", header, &rows),
            "not above zero",
        ),
        (
            file("", header, &rows.replace("0.5,50", "0.49,50")),
            "run.csv:53: `time_s`: two rows",
        ),
        (file("", header, "0,1,1,1\n"), "at least 64 rows"),
        (
            file("# robot = \"none.toml\"\n", header, &rows),
            "none.toml",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (text, wanted) in cases {
        std::fs::write(folder.path().join("run.csv"), text).unwrap();
        let output = ident(folder.path(), &["diagnose", "run.csv"]);
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains(wanted) && said.contains("help:"),
            "{wanted}: {said}"
        );
    }
}

#[test]
fn a_joint_that_stands_still_or_has_no_noise_is_no_trouble() {
    for (angle, torque) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)] {
        let rows: String = (0..100)
            .map(|i| {
                let x = f64::from(i) * 0.05;
                format!(
                    "{},{},{},{}\n",
                    f64::from(i) * 0.004,
                    angle * x.sin(),
                    angle * x.sin(),
                    torque * x.cos()
                )
            })
            .collect();
        let text = format!(
            "# kind = \"joint-motion\"\ntime_s,motor_angle_deg_1,link_angle_deg_1,motor_torque_Nm_1\n{rows}"
        );
        let found = diagnose(&read(&text), None);
        assert!(said(&found).is_empty(), "{:?}", said(&found));
        assert!(found.answer.discrepancy.rms.is_finite());
    }
}

/// A joint of 1 MN·m/rad, read to 3 µrad, and what is not as a simulation has it.
#[derive(Default)]
struct Arm {
    /// N·m of weight at right angles to it.
    weight: f64,
    /// Inertia of the motor, kg·m².
    rotor: f64,
    /// Stated stiffness over the true one, less one.
    stated: f64,
    /// N·m·s/rad.
    oil: f64,
    /// The same between the link and its surroundings, so that it goes through the spring.
    link_oil: f64,
    /// Noise of the motor's torque on the side of the link, N·m, beyond that of every arm.
    scatter: f64,
    /// N·m.
    dry: f64,
    /// Zero of the link encoder, rad.
    zero: f64,
    /// Twist that contacts hold, rad, and the share of it that they hold at the begin.
    held: (f64, f64),
}

impl Arm {
    fn text(&self, seed: u64) -> String {
        let mut random = Random::new(seed);
        let mut text = format!(
            "# kind = \"joint-motion\"\n# synthetic = true\n# gear_ratio = [120]\n\
             # nominal_stiffness_Nm_rad = {}\n# nominal_stiffness_rel_std = 0.05\n\
             # encoder_zero_std_deg = 0.0001\n\
             time_s,motor_angle_deg_2,link_angle_deg_2,motor_torque_Nm_2\n",
            1e6 * (1.0 + self.stated)
        );
        let (mut holds, mut before) = (self.held.1, None);
        for i in 0..2400 {
            let t = f64::from(i) * 0.01;
            let wave = |w: f64, a: f64, p: f64| {
                let (sin, cos) = (w * t + p).sin_cos();
                [a * sin, a * w * cos, -a * w * w * sin]
            };
            let waves = [
                wave(0.7, 0.6, 0.0),
                wave(1.9, 0.3, 1.0),
                wave(3.1, 0.1, 2.0),
            ];
            let [angle, speed, acceleration] =
                [0, 1, 2].map(|k| waves.iter().map(|w| w[k]).sum::<f64>());
            let geared =
                300.0 * acceleration + self.weight * (angle + 0.4).cos() + self.link_oil * speed;
            let turn = geared - before.unwrap_or(geared);
            before = Some(geared);
            holds = turn.signum() - (turn.signum() - holds) * (-turn.abs() / 150.0_f64).exp();
            let paid = geared
                + self.rotor * acceleration
                + self.oil * speed
                + self.dry * (speed / 0.005).tanh();
            let link = angle - geared / 1e6 + self.held.0 * holds + self.zero;
            text += &format!(
                "{t:.3},{:.7},{:.7},{:.6}\n",
                angle.to_degrees(),
                (link + 3e-6 * random.normal()).to_degrees(),
                (paid + 0.5_f64.hypot(self.scatter) * random.normal()) / 120.0
            );
        }
        text
    }

    fn found(&self) -> (Vec<String>, &'static str) {
        let found = diagnose(&read(&self.text(7)), None);
        (said(&found), found.answer.verdict.name())
    }
}

/// The torque of a joint that gravity does not load pays for inertia and friction: the inertia of the motor, which nobody
/// states, must not take the place of a spring that gives more than the stated one, or of friction.
#[test]
fn a_joint_without_gravity_is_told() {
    let named = |arm: Arm, name: &str| {
        let (said, verdict) = arm.found();
        assert_eq!((said, verdict), (vec![name.to_string()], "explained"));
    };
    let of = |stated: f64, oil: f64, dry: f64, rotor: f64| Arm {
        stated,
        oil,
        dry,
        rotor,
        ..Arm::default()
    };
    assert_eq!(of(0.0, 0.0, 0.0, 0.0).found(), (Vec::new(), "sufficient"));
    named(of(0.6, 0.0, 0.0, 0.0), "stiffness");
    named(of(0.0, 60.0, 0.0, 0.0), "viscous_friction");
    named(of(0.0, 0.0, 60.0, 0.0), "coulomb_friction");
    // a stiffer spring twists as little as the stated one behind a motor: most motors have some inertia, few springs are half as stiff again
    for arm in [of(-0.35, 0.0, 0.0, 0.0), of(0.0, 0.0, 0.0, 160.0)] {
        let found = diagnose(&read(&arm.text(7)), None);
        assert_eq!(found.answer.verdict.name(), "sufficient");
        let told = |r: &String| r.contains("a spring 5") && r.contains("% stiffer");
        assert!(found.remarks.iter().any(told), "{:?}", found.remarks);
    }
    // of more inertia than all that it moves few are
    let open = (vec!["{stiffness}".to_string()], "cannot-tell");
    assert_eq!(of(-0.6, 0.0, 0.0, 0.0).found(), open);
    assert_eq!(of(0.0, 0.0, 0.0, 450.0).found(), open);
}

/// A spring that is softer than a rotor without inertia lets it be is not the stated one, and no encoder is late for it, whatever friction the
/// link has.
#[test]
fn a_softer_spring_is_no_delay() {
    for stated in [0.3, 0.6] {
        let arm = Arm {
            stated,
            link_oil: 120.0,
            ..Arm::default()
        };
        let (said, verdict) = arm.found();
        assert_eq!((said, verdict), (vec!["stiffness".into()], "explained"));
    }
}

/// Without a ratio the torque is the motor's, and a spring on the side of the link says nothing of the zero that it leaves.
#[test]
fn without_a_ratio_no_zero_is_told_by_a_stated_spring() {
    let arm = Arm {
        weight: 1500.0,
        ..Arm::default()
    };
    let text = arm.text(7).replace("# gear_ratio = [120]\n", "");
    let found = diagnose(&read(&text), None);
    assert!(said(&found).is_empty(), "{:?}", said(&found));
}

/// Noise of the torque is none of the twist: speed and acceleration, which have none, must not take the torque's place.
#[test]
fn a_noisy_torque_makes_no_delay_and_no_loop() {
    for (link_oil, rotor) in [(0.0, 0.0), (80.0, 0.0), (80.0, 100.0)] {
        let arm = Arm {
            link_oil,
            rotor,
            scatter: 12.0,
            ..Arm::default()
        };
        assert_eq!(
            arm.found(),
            (Vec::new(), "sufficient"),
            "{link_oil} {rotor}"
        );
    }
}

/// A motion under gravity shows the spring, and with it what the mean torque makes of the mean twist.
#[test]
fn a_constant_zero_is_told_under_gravity() {
    let arm = |zero: f64, stated: f64| Arm {
        weight: 1500.0,
        zero,
        stated,
        ..Arm::default()
    };
    assert_eq!(arm(0.0, 0.0).found(), (Vec::new(), "sufficient"));
    let offset = |arm: Arm| holds(&arm.found().0, "sensor_offset");
    assert!(offset(arm(1e-4, 0.0)));
    assert!(offset(arm(-1e-4, 0.0)));
    // a wrong spring is no zero
    assert!(!offset(arm(0.0, 0.8)));
    assert!(!offset(arm(0.0, -0.4)));
}

/// Contacts that hold something when the record begins follow a first branch, and no zero has jumped.
#[test]
fn the_first_branch_of_a_loop_is_no_jump() {
    for begin in [-0.7, 0.0, 0.5] {
        let arm = Arm {
            weight: 1500.0,
            held: (6e-5, begin),
            ..Arm::default()
        };
        assert_eq!(arm.found().0, ["hysteresis"], "{begin}");
    }
}

/// Moves from point to point, each at its own speed, of a joint whose motor's own encoder errs `order` times per motor turn.
fn erring_motor(ratio: f64, order: f64, size: f64) -> String {
    let (step, stay) = (0.01, 60);
    let points = [0.0, 0.6, 0.12, -0.3, 0.48, 0.0];
    let mut angles = Vec::new();
    for (pair, top) in points.windows(2).zip([0.05, 0.2, 0.1, 0.35, 0.6]) {
        let way: f64 = pair[1] - pair[0];
        let rows = (1.875 * way.abs() / top / step) as usize;
        let at = |i: usize| i as f64 / rows as f64;
        let smooth = |s: f64| s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
        angles.extend((0..rows).map(|i| pair[0] + way * smooth(at(i))));
        angles.extend(std::iter::repeat_n(pair[1], stay));
    }
    let last = angles.len() - 1;
    let speed = |i: usize| (angles[(i + 1).min(last)] - angles[i.saturating_sub(1)]) / (2.0 * step);
    let mut random = Random::new(7);
    let mut text = format!(
        "# kind = \"joint-motion\"\n# synthetic = true\n# gear_ratio = [{ratio}]\n# nominal_stiffness_Nm_rad = 1e6\n# nominal_stiffness_rel_std = 0.05\ntime_s,motor_angle_deg_3,link_angle_deg_3,motor_torque_Nm_3,motor_speed_deg_s_3\n"
    );
    for (i, angle) in angles.iter().enumerate() {
        let speeding = (speed((i + 1).min(last)) - speed(i.saturating_sub(1))) / (2.0 * step);
        let torque = 2500.0 * (angle + 0.4).cos() + 300.0 * speeding;
        let error = size * (order * ratio * angle + 0.3).sin();
        let link = angle - torque / 1e6 + 1.7e-5 * random.normal();
        let paid = (torque + 50.0 * speeding + 2.0 * random.normal()) / ratio;
        let (motor, link) = ((angle - error).to_degrees(), link.to_degrees());
        text += &format!(
            "{:.4},{motor:.7},{link:.7},{paid:.5},{:.5}\n",
            i as f64 * step,
            speed(i).to_degrees()
        );
    }
    text
}

/// The ripple is in the acceleration too, which is the motor's angle twice derived, and takes part of it where it is fast.
#[test]
fn a_motor_whose_encoder_errs_is_no_meshing_gear() {
    for (ratio, order, size) in [(85.0, 2.0, 1.3e-4), (122.0, 2.0, 1.7e-4), (81.0, 1.0, 6e-5)] {
        let found = diagnose(&read(&erring_motor(ratio, order, size)), None);
        assert_eq!(said(&found), ["encoder_ripple"], "{:?}", found.remarks);
        let amplitude = found.answer.causes[0].parameters[0].1;
        assert!((amplitude / size - 1.0).abs() < 0.1, "{amplitude}");
    }
}
