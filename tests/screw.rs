//! Linear axes: figures, groups and tables against formulas of this file.

use ident::fit::screw::groups::Joint;
use ident::fit::screw::in_motion::{Demand, in_motion};
use ident::fit::screw::positions::Extremes;
use ident::fit::screw::{Account, Request, identify};
use ident::ground::random::Random;
use ident::measurement::pitch_table::{PitchTable, exporter};
use ident::measurement::screw::ScrewTest;
use ident::motion::servo::{BANDWIDTH, Drive, Loop, Screw, Stroke, course};
use std::path::Path;

/// Error of the screw, µm, at a position in mm.
type Error = fn(f64, bool) -> f64;

/// Pitch error, cyclic error and backlash.
fn worn(x: f64, forward: bool) -> f64 {
    let cyclic = 2.0 * (std::f64::consts::TAU * x / 5.08).sin();
    0.12 * x + 9.0 * (x / 60.0).sin() + cyclic + if forward { 0.0 } else { 11.0 }
}

/// The same with a narrow worn stretch: its targets differ by several µm from one to the next.
fn pitted(x: f64, forward: bool) -> f64 {
    worn(x, forward) - 30.0 * (-((x - 140.0) / 14.0).powi(2)).exp()
}

/// A file of seven runs; `table` corrects the command.
fn file(seed: u64, step: f64, error: Error, noise_um: f64, table: Option<&PitchTable>) -> String {
    let mut random = Random::new(seed);
    let mut text = String::from(
        "# kind = \"screw\"\n# pitch_mm = 5.08\n# synthetic = true\nrun,direction,target_mm,actual_mm\n",
    );
    for run in 1..=7 {
        for forward in [true, false] {
            for i in 0..73 {
                let x = -41.0 + step * f64::from(if forward { i } else { 72 - i });
                let told = x + table.map_or(0.0, |t| 1e-3 * t.correction_um(x, forward));
                let actual = told + 1e-3 * (error(told, forward) + noise_um * random.normal());
                let word = if forward { "forward" } else { "backward" };
                text += &format!("{run},{word},{x:.4},{actual:.6}\n");
            }
        }
    }
    text
}

fn read(text: &str) -> ScrewTest {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.csv");
    std::fs::write(&path, text).unwrap();
    ScrewTest::read(&path).unwrap()
}

fn request(coverage: f64) -> Request {
    Request {
        residual: 3e-6,
        coverage,
        extremes: Extremes::Dropped,
        joint: Joint::Free,
        smooth: false,
    }
}

fn judged(text: &str, coverage: f64) -> Account {
    identify(&[read(text)], &request(coverage)).unwrap()
}

/// Deviations in µm straight from the text: [target][direction][run].
fn table_of(text: &str) -> Vec<[Vec<f64>; 2]> {
    let mut rows: Vec<(f64, usize, f64)> = Vec::new();
    for line in text.lines().filter(|l| l.as_bytes()[0].is_ascii_digit()) {
        let cells: Vec<&str> = line.split(',').collect();
        let (target, actual): (f64, f64) = (cells[2].parse().unwrap(), cells[3].parse().unwrap());
        rows.push((
            target,
            usize::from(cells[1] == "backward"),
            1e3 * (actual - target),
        ));
    }
    let mut targets: Vec<f64> = rows.iter().map(|r| r.0).collect();
    targets.sort_by(f64::total_cmp);
    targets.dedup();
    let of = |x: &f64, d: usize| {
        rows.iter()
            .filter(|r| r.0 == *x && r.1 == d)
            .map(|r| r.2)
            .collect()
    };
    targets.iter().map(|x| [of(x, 0), of(x, 1)]).collect()
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

/// By the sum of squares of all pairs: s² = Σ_{i<j} (xi − xj)² / (n (n − 1)).
fn deviation(x: &[f64]) -> f64 {
    let n = x.len() as f64;
    let pairs = x
        .iter()
        .flat_map(|a| x.iter().map(move |b| (a - b) * (a - b)));
    (0.5 * pairs.sum::<f64>() / (n * (n - 1.0))).sqrt()
}

#[test]
fn figures_of_iso_230_2_equal_another_implementation() {
    for (seed, k) in [(1, 2.0), (2, 3.0), (3, 2.0)] {
        let text = file(seed, 5.0, worn, 1.3, None);
        let found = judged(&text, k).figures;
        let t = table_of(&text);
        let (mut high, mut low) = ([f64::MIN; 3], [f64::MAX; 3]);
        let (mut top, mut bottom) = ([f64::MIN; 3], [f64::MAX; 3]);
        let (mut r, mut rf, mut rb, mut b, mut sum) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64, 0.0);
        for [f, w] in &t {
            for (d, x) in [(0, f), (1, w)] {
                for side in [d, 2] {
                    high[side] = high[side].max(mean(x) + k * deviation(x));
                    low[side] = low[side].min(mean(x) - k * deviation(x));
                }
                top[d] = top[d].max(mean(x));
                bottom[d] = bottom[d].min(mean(x));
            }
            let middle = (mean(f) + mean(w)) / 2.0;
            top[2] = top[2].max(middle);
            bottom[2] = bottom[2].min(middle);
            let gap = mean(f) - mean(w);
            sum += gap;
            b = b.max(gap.abs());
            rf = rf.max(2.0 * k * deviation(f));
            rb = rb.max(2.0 * k * deviation(w));
            r = r
                .max(k * deviation(f) + k * deviation(w) + gap.abs())
                .max(rf)
                .max(rb);
        }
        let same = |name: &str, found: Option<f64>, wanted: f64| {
            let found = 1e6 * found.unwrap();
            assert!(
                (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0),
                "{name}: {found} {wanted}"
            );
        };
        same("A", found.a, high[2] - low[2]);
        same("A forward", found.a_forward, high[0] - low[0]);
        same("A backward", found.a_backward, high[1] - low[1]);
        same("R", found.r, r);
        same("R forward", found.r_forward, rf);
        same("R backward", found.r_backward, rb);
        same("B", found.b, b);
        same("B mean", found.b_mean, sum / t.len() as f64);
        same("E", found.e, top[0].max(top[1]) - bottom[0].min(bottom[1]));
        same("E forward", found.e_forward, top[0] - bottom[0]);
        same("E backward", found.e_backward, top[1] - bottom[1]);
        same("M", found.m, top[2] - bottom[2]);
    }
}

#[test]
fn a_case_in_whole_micrometres_by_hand() {
    // deviations forward 1 3, -2 0, 4 6; backward 5 7, 3 5, 9 11: every s = √2
    let text = "# kind = \"screw\"\nrun,direction,target_mm,actual_mm\n\
        1,forward,0,0.001\n2,forward,0,0.003\n1,forward,10,9.998\n2,forward,10,10.000\n\
        1,forward,20,20.004\n2,forward,20,20.006\n1,backward,0,0.005\n2,backward,0,0.007\n\
        1,backward,10,10.003\n2,backward,10,10.005\n1,backward,20,20.009\n2,backward,20,20.011\n";
    let found = judged(text, 2.0).figures;
    let root = 2.0_f64.sqrt();
    let same =
        |found: Option<f64>, wanted: f64| assert!((1e6 * found.unwrap() - wanted).abs() < 1e-8);
    same(found.a, 11.0 + 4.0 * root); // 10 + 2√2 less -1 - 2√2
    same(found.a_forward, 6.0 + 4.0 * root);
    same(found.r_forward, 4.0 * root);
    same(found.b, 5.0);
    same(found.b_mean, -14.0 / 3.0);
    same(found.r, 5.0 + 4.0 * root);
    same(found.e, 11.0);
    same(found.m, 6.0); // 7.5 - 1.5
}

/// Least squares by orthogonal polynomials on the points themselves (Forsythe 1957); largest residual.
fn largest_residual(points: &[(f64, f64)]) -> f64 {
    let mut left: Vec<f64> = points.iter().map(|p| p.1).collect();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for degree in 0..3.min(points.len()) {
        let mut own: Vec<f64> = points
            .iter()
            .map(|p| (p.0 / 300.0).powi(degree as i32))
            .collect();
        for _ in 0..2 {
            for b in &basis {
                let along: f64 = own.iter().zip(b).map(|(x, y)| x * y).sum();
                own.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
        }
        let size = own.iter().map(|x| x * x).sum::<f64>().sqrt();
        own.iter_mut().for_each(|x| *x /= size);
        let along: f64 = own.iter().zip(&left).map(|(x, y)| x * y).sum();
        left.iter_mut().zip(&own).for_each(|(x, y)| *x -= along * y);
        basis.push(own);
    }
    left.iter().fold(0.0, |worst, x| worst.max(x.abs()))
}

#[test]
fn group_boundaries_follow_the_greedy_rule_of_the_source() {
    for seed in 1..=8 {
        let text = file(seed, 5.0, worn, 1.5, None);
        let found = judged(&text, 2.0);
        let points: Vec<(f64, f64)> = table_of(&text)
            .iter()
            .enumerate()
            .map(|(i, [f, b])| {
                let inner = |x: &[f64]| {
                    let mut x = x.to_vec();
                    x.sort_by(f64::total_cmp);
                    mean(&x[1..x.len() - 1])
                };
                (-41.0 + 5.0 * i as f64, (inner(f) + inner(b)) / 2.0)
            })
            .collect();
        let mut from = 0;
        for group in &found.groups {
            let mut count = 3.min(points.len() - from);
            while from + count < points.len()
                && largest_residual(&points[from..=from + count]) <= 3.0
            {
                count += 1;
            }
            assert_eq!(group.points, count, "seed {seed}, from {from}");
            assert_eq!(
                (group.from_mm, group.to_mm),
                (points[from].0, points[from + count - 1].0)
            );
            let worst = largest_residual(&points[from..from + count]);
            assert!(
                (group.max_residual_um - worst).abs() < 1e-6,
                "{} {worst}",
                group.max_residual_um
            );
            from += count;
        }
        assert_eq!(from, points.len());
        let least = found.least.as_ref().unwrap();
        assert!(least.len() <= found.groups.len());
    }
}

#[test]
fn the_table_takes_at_least_four_fifths_of_the_error() {
    let before = judged(&file(1, 5.0, worn, 0.5, None), 2.0);
    let table = before.table(false);
    let after = judged(&file(2, 5.0, worn, 0.5, Some(&table)), 2.0);
    let (a, b) = (before.figures.a.unwrap(), after.figures.a.unwrap());
    assert!(b < 0.2 * a, "{a} {b}");
    assert!((before.backlash.unwrap() - 11e-6).abs() < 0.2e-6);
    let smooth = before.table(true);
    let after = judged(&file(3, 5.0, worn, 0.5, Some(&smooth)), 2.0);
    assert!(after.figures.a.unwrap() < 0.35 * a);
}

#[test]
fn in_motion_a_point_table_disturbs_the_speed_and_quadratics_do_not() {
    let account = judged(&file(1, 5.0, pitted, 0.8, None), 2.0);
    let demand = Demand::at(5.0 / 60.0);
    let runs = in_motion(&account, &demand);
    let holds = |key: &str| {
        let run = runs.iter().find(|r| r.key == key).unwrap();
        println!("{key:10} {:?} m/s, {:?} m", run.speed, run.error);
        let (speed, position) = (run.holds_speed(&demand), run.holds_position(&demand));
        (speed.unwrap(), position.unwrap())
    };
    assert_eq!(holds("none"), (true, false));
    assert_eq!(holds("points"), (false, true));
    for key in ["lines", "quadratics", "continuous"] {
        assert_eq!(holds(key), (true, true), "{key}");
    }
}

#[test]
fn in_motion_the_table_brings_the_true_screw_to_where_it_is_told() {
    // the truth of this file turns under the loop, once per turn included
    let account = judged(&file(1, 5.0, worn, 0.8, None), 2.0);
    let table = account.table(false);
    let drive = Drive::of_pitch(5.08e-3);
    let control = Loop::with_bandwidth(&drive, BANDWIDTH);
    let error = |x: f64| 1e-6 * (worn(1e3 * x, true) + 5.5);
    let screw = Screw {
        error: &error,
        play: 11e-6,
    };
    let stroke = Stroke {
        ends: [-0.041, 0.319],
        speed: 5.0 / 60.0,
        acceleration: 2.0,
        rest: 0.1,
    };
    let worst = |correction: &dyn Fn(f64, bool) -> f64| {
        let mut worst = 0.0_f64;
        course(&drive, &control, &screw, &stroke, correction, |now| {
            if now.steady {
                worst = worst.max(now.error.abs());
            }
        });
        worst
    };
    let before = worst(&|_, _| 0.0);
    let after = worst(&|x, forward| 1e-6 * table.correction_um(1e3 * x, forward));
    println!("{before:e} {after:e}");
    assert!(before > 40e-6 && after < 8e-6, "{before} {after}");
}

#[test]
fn linuxcnc_finds_a_triplet_in_every_line_up_to_the_last_target() {
    // it stops at the first line that is none (usrmotLoadComp)
    let table = judged(&file(1, 5.0, worn, 0.8, None), 2.0).table(false);
    let text = (exporter("linuxcnc").unwrap().write)(&table).unwrap();
    let triplet = |line: &&str| {
        let cells: Vec<&str> = line.split_whitespace().collect();
        cells.len() == 3 && cells.iter().all(|c| c.parse::<f64>().is_ok())
    };
    assert_eq!(text.lines().take_while(triplet).count(), 73);
    // type 1: the trim is nominal less actual
    let first: Vec<f64> = text
        .lines()
        .next()
        .unwrap()
        .split(' ')
        .map(|c| c.parse().unwrap())
        .collect();
    assert_eq!(first[0], -41.0);
    assert!(
        (first[1] + 1e-3 * worn(-41.0, true)).abs() < 1.5e-3,
        "{first:?}"
    );
}

#[test]
fn targets_whole_turns_apart_are_said_to_hide_the_cyclic_error() {
    let blind = judged(&file(1, 5.08, worn, 0.5, None), 2.0);
    assert!(
        blind
            .remarks()
            .iter()
            .any(|r| r.contains("cannot show an error once per turn"))
    );
    let clear = judged(&file(1, 5.0, worn, 0.5, None), 2.0);
    assert!(clear.remarks().is_empty(), "{:?}", clear.remarks());
}

#[test]
fn one_wild_reading_moves_the_figures_but_not_the_means() {
    let text = file(1, 5.0, worn, 0.5, None);
    let spoiled = text.replacen(
        "1,forward,-41.0000,",
        "1,forward,-41.0000,-40.5\n9,forward,-41.0000,",
        1,
    );
    let (clean, wild) = (judged(&text, 2.0), judged(&spoiled, 2.0));
    assert!(wild.figures.a.unwrap() > 10.0 * clean.figures.a.unwrap());
    let change = wild.kept[0].mean().unwrap() - clean.kept[0].mean().unwrap();
    assert!(change.abs() < 0.5e-6, "{change}");
    let robust = Request {
        extremes: Extremes::Robust,
        ..request(2.0)
    };
    let robust = identify(&[read(&spoiled)], &robust).unwrap();
    assert!((robust.kept[0].mean().unwrap() - clean.kept[0].mean().unwrap()).abs() < 0.5e-6);
    assert!(robust.dropped < 20, "{}", robust.dropped);
}

#[test]
fn what_cannot_be_read_is_refused_with_line_and_remedy() {
    let refused = |text: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        std::fs::write(&path, text).unwrap();
        let problem = ScrewTest::read(Path::new(&path)).unwrap_err();
        assert!(!problem.remedy.is_empty() && problem.file.is_some());
        (problem.line, problem.what)
    };
    let head = "# kind = \"screw\"\nrun,direction,target_mm,actual_mm\n";
    assert_eq!(
        refused(&format!("{head}1,forward,0,0\n1,sideways,0,0\n")).0,
        Some(4)
    );
    assert_eq!(refused(&format!("{head}1.5,forward,0,0\n")).0, Some(3));
    assert_eq!(
        refused(
            "# kind = \"screw\"\n# pitch = 5\nrun,direction,target_mm,actual_mm\n1,forward,0,0\n"
        )
        .0,
        Some(2)
    );
    assert_eq!(
        refused("# kind = \"screw\"\nrun,direction,target_mm\n1,forward,0\n").0,
        Some(2)
    );
    assert!(refused(head).1.contains("no usable row"));
}

#[test]
fn a_way_back_below_the_way_there_is_said() {
    let gained: Error = |x, forward| worn(x, !forward);
    let [lost, gained] =
        [worn as Error, gained].map(|error| judged(&file(3, 5.0, error, 0.8, None), 2.0));
    let is_said = |account: &Account| {
        let remarks = account.remarks();
        remarks.iter().any(|r| r.contains("below the way there"))
    };
    assert!(!is_said(&lost) && is_said(&gained));
    assert!((lost.backlash.unwrap() - gained.backlash.unwrap()).abs() < 1e-6);
}
