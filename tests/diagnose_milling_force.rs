//! Diagnosis of milling forces: one thing at a time is changed on a test bench that shares nothing with the
//! program, and must be named, alone or among at most three that the data cannot tell apart.

use crate::milling_bench::{Cutter, Pass, Recording, csv, record};
use ident::findings::engine::{Found, diagnose};
use ident::findings::kinds::Measured;
use ident::findings::milling_force::Case;
use ident::findings::{Answer, Verdict};
use ident::fit::suitability::milling_force::doubts;
use ident::ground::random::Random;
use ident::measurement::milling_force::MillingForce;
use ident::measurement::table::Table;
use std::f64::consts::TAU;

const NOMINAL: [f64; 6] = [951.365, 262.597, 323.33, 11.115, 11.314, 1.105];
pub(crate) const NOISE: f64 = 3.0;

/// A cut as it is and as the file says it is, and what the sensor makes of it.
pub(crate) struct Bench {
    cutter: Cutter,
    said: Vec<Pass>,
    done: Vec<Pass>,
    pub(crate) truth: [f64; 6],
    ring: Option<[f64; 3]>,
    bandwidth_hz: Option<f64>,
    /// The sensor's own bandwidth over the stated one.
    wider: f64,
    /// Turns of the spindle in a cut.
    pub(crate) turns: f64,
}

impl Bench {
    pub(crate) fn new(teeth: usize) -> Self {
        let pass = |feed: f64, depth: f64, width: f64, side: &'static str| Pass {
            rpm: 6000.0,
            feed,
            depth,
            width,
            side,
        };
        let said = vec![
            pass(1400.0, 1.5, 16.0, "slot"),
            pass(2800.0, 1.5, 16.0, "slot"),
            pass(2400.0, 2.5, 6.0, "down"),
            pass(2400.0, 2.0, 8.0, "up"),
        ];
        Self {
            cutter: Cutter {
                radius: 8e-3,
                teeth,
                helix: 0.5235987755982988,
                runout: 0.0,
                runout_angle: 0.7,
                chip: 0.0,
            },
            done: said.clone(),
            said,
            truth: NOMINAL,
            ring: None,
            bandwidth_hz: Some(2500.0),
            wider: 1.0,
            turns: 5.0,
        }
    }

    /// With so much runout, m.
    pub(crate) fn runs_out(&mut self, by: f64) {
        self.cutter.runout = by;
    }

    /// Rows of cut, time and force on the workpiece.
    pub(crate) fn rows(&self) -> Vec<[f64; 5]> {
        record(
            &self.cutter,
            &self.done,
            &self.truth,
            &Recording {
                ring: self.ring,
                bandwidth_hz: self.bandwidth_hz.map(|hz| self.wider * hz),
                ..self.recording()
            },
            &mut Random::new(4),
        )
    }

    fn found(&self, sensor: impl Fn(&mut [f64; 5])) -> Found {
        let mut rows = self.rows();
        rows.iter_mut().for_each(sensor);
        self.diagnosed(&rows)
    }

    pub(crate) fn diagnosed(&self, rows: &[[f64; 5]]) -> Found {
        let case = Case::new(self.file(rows));
        diagnose(&case, &case.judgement())
    }

    fn file(&self, rows: &[[f64; 5]]) -> MillingForce {
        let k = NOMINAL;
        let nominal = format!(
            "# nominal = {{ Ktc_N_mm2 = {}, Krc_N_mm2 = {}, Kac_N_mm2 = {}, Kte_N_mm = {}, Kre_N_mm = {}, Kae_N_mm = {}, rel_std = 0.03 }}\ncut,time_s",
            k[0], k[1], k[2], k[3], k[4], k[5]
        );
        let text =
            csv(&self.cutter, &self.said, &self.recording(), rows).replace("cut,time_s", &nominal);
        let bytes = text.len() as u64;
        let table = Table::from_reader("cuts.csv".as_ref(), text.as_bytes(), bytes).unwrap();
        MillingForce::from_table(table).unwrap()
    }

    fn recording(&self) -> Recording {
        Recording {
            rate_hz: 20_000.0,
            turns: self.turns,
            bandwidth_hz: self.bandwidth_hz,
            noise: NOISE,
            colour: 0.0,
            clipped: true,
            ring: None,
        }
    }
}

/// Everybody named, alone or in groups.
pub(crate) fn names(answer: &Answer) -> Vec<(&'static str, String)> {
    let causes = answer.causes.iter().map(|c| (c.effect, c.site.clone()));
    let groups = answer.groups.iter().flat_map(|g| {
        let each = g.effects.iter().zip(&g.sites);
        each.map(|(e, s)| (*e, s.clone())).collect::<Vec<_>>()
    });
    causes.chain(groups).collect()
}

pub(crate) fn is_named(found: &Found, effect: &str) {
    let answer = &found.answer;
    let named = names(answer);
    let held = named.iter().any(|n| n.0 == effect);
    let told = format!(
        "{effect}: {:?} {named:?} {:?}",
        answer.verdict, found.blamed
    );
    assert!(held && named.len() <= 3, "{told}");
}

#[test]
fn a_cut_as_it_is_stated_is_sufficient() {
    for teeth in [2, 3] {
        let found = Bench::new(teeth).found(|_| ());
        assert_eq!(
            found.answer.verdict,
            Verdict::Sufficient,
            "{:?} {}",
            names(&found.answer),
            found.answer.discrepancy.rms
        );
    }
}

/// A record that runs on while the tool leaves the stock, and in air: nothing is wrong with the last cut.
#[test]
fn a_record_that_ends_in_air_is_no_other_cut() {
    let mut bench = Bench::new(2);
    bench.turns = 50.0;
    let end = bench.rows().last().unwrap()[1];
    let found = bench.found(|row| {
        // the radius of 8 mm at 40 mm/s, then 60 ms of air
        let share = ((end - 0.06 - row[1]) / 0.2).clamp(0.0, 1.0);
        (2..5).for_each(|k| row[k] *= if row[0] == 4.0 { share.max(0.01) } else { 1.0 });
    });
    assert_eq!(
        found.answer.verdict,
        Verdict::Sufficient,
        "{:?}",
        names(&found.answer)
    );
}

/// A bandwidth is stated to a fifth, so that one that is off by less is no other depth of cut.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_bandwidth_that_is_a_little_off_is_no_cause() {
    for wider in [0.94, 1.07] {
        let mut bench = Bench::new(2);
        (bench.bandwidth_hz, bench.wider) = (Some(1000.0), wider);
        let answer = bench.found(|_| ()).answer;
        assert_eq!(answer.verdict, Verdict::Sufficient, "{:?}", names(&answer));
    }
}

/// A helix evens out the axial force of a full slot: shallow cuts show hardly more
/// than noise beside the steady force of deep ones, which is no reason to refuse; much noise alone is.
#[test]
fn an_axis_without_ripple_is_no_unrelated_record() {
    let mut bench = Bench::new(3);
    bench.cutter.helix = 0.785;
    bench.truth[2] = 150.0;
    (bench.said[0].depth, bench.done[0].depth) = (0.3, 0.3);
    for pass in bench.said.iter_mut().chain(&mut bench.done) {
        (pass.width, pass.side) = (16.0, "slot");
    }
    let rows = bench.rows();
    let fatal = |rows: &[[f64; 5]]| {
        let doubts = doubts(&bench.file(rows)).into_iter();
        doubts.filter(|d| d.rule == "unrelated").count()
    };
    assert_eq!(fatal(&rows), 0);
    let mut random = Random::new(5);
    let of_another: Vec<[f64; 5]> = rows
        .iter()
        .map(|row| {
            let mut row = *row;
            row[4] = 20.0 * random.normal();
            row
        })
        .collect();
    assert_eq!(fatal(&of_another), 1);
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn other_coefficients_are_named() {
    let mut bench = Bench::new(3);
    (0..3).for_each(|j| bench.truth[j] *= 1.25);
    is_named(&bench.found(|_| ()), "cutting_coefficients");
    let mut bench = Bench::new(3);
    (3..6).for_each(|j| bench.truth[j] *= 1.9);
    is_named(&bench.found(|_| ()), "edge_coefficients");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn another_engagement_is_named() {
    let mut bench = Bench::new(3);
    bench.done[2..].iter_mut().for_each(|p| p.width += 0.4);
    is_named(&bench.found(|_| ()), "width_of_cut");
    let mut bench = Bench::new(3);
    bench.done.iter_mut().for_each(|p| p.depth += 0.25);
    is_named(&bench.found(|_| ()), "depth_of_cut");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn another_speed_is_named_however_many_turns_it_costs() {
    for error in [0.004, -0.03] {
        let mut bench = Bench::new(3);
        bench.done.iter_mut().for_each(|p| p.rpm *= 1.0 + error);
        let found = bench.found(|_| ());
        is_named(&found, "spindle_speed");
        let cause = &found.answer.causes[0];
        let said = cause.parameters[0].1;
        assert!((said / error - 1.0).abs() < 0.05, "{said} {error}");
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn what_the_sensor_makes_of_a_force_is_named() {
    let bench = Bench::new(3);
    is_named(&bench.found(|r| r[3] *= 1.15), "force_gain");
    is_named(&bench.found(|r| r[4] += 0.08 * r[2]), "cross_talk");
    is_named(&bench.found(|r| r[3] += 12.0), "sensor_offset");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn what_changes_with_time_is_named() {
    let bench = Bench::new(3);
    is_named(&bench.found(|r| r[2] += 60.0 * r[1]), "thermal_drift");
    let chatter = |r: &mut [f64; 5]| {
        if r[0] == 3.0 {
            r[2] += 25.0 * (TAU * 743.0 * r[1]).sin();
            r[3] += 30.0 * (TAU * 743.0 * r[1] + 0.4).cos();
        }
    };
    is_named(&bench.found(chatter), "chatter");
}

/// A drift over the root of time is no drift towards an end with an offset beside it, and is told by how far it has come.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_drift_of_another_shape_is_one_drift() {
    let bench = Bench::new(3);
    let rows = bench.rows();
    let [start, end] = [rows[0][1], rows[rows.len() - 1][1]];
    let found = bench.found(|r| r[2] += 40.0 * ((r[1] - start) / (end - start)).sqrt());
    let named: Vec<&str> = found.answer.causes.iter().map(|c| c.effect).collect();
    assert_eq!(named, ["thermal_drift"]);
    let drift = found.answer.causes[0].parameters[0].1;
    assert!((drift / 40.0 - 1.0).abs() < 0.1, "{drift}");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn teeth_that_do_not_run_alike_are_named() {
    let mut bench = Bench::new(4);
    bench.cutter.runout = 14e-6;
    let found = bench.found(|_| ());
    is_named(&found, "runout");
    let size = found.answer.causes[0].parameters[0].1;
    assert!((size / 14e-6 - 1.0).abs() < 0.1, "{size}");
    let mut bench = Bench::new(4);
    bench.cutter.chip = 40e-6;
    is_named(&bench.found(|_| ()), "chipped_tooth");
}

/// Of two teeth one is shorter in an eccentric tool as in a broken one; a runout is among what is named all the same, wherever
/// it points.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_runout_of_two_teeth_is_among_what_is_named() {
    for angle in [0.3, 1.2] {
        let mut bench = Bench::new(2);
        (bench.cutter.runout, bench.cutter.runout_angle) = (27e-6, angle);
        is_named(&bench.found(|_| ()), "runout");
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_sensor_that_rings_is_named_with_its_frequency() {
    let mut bench = Bench::new(3);
    bench.ring = Some([1330.0, 0.06, 1.0]);
    let found = bench.found(|_| ());
    is_named(&found, "sensor_resonance");
    let hz = found.answer.causes[0].parameters[0].1;
    assert!((hz / 1330.0 - 1.0).abs() < 0.02, "{hz}");
    // the noise that is told is what stays beside it, not what the first statement still held of it
    let told = found.answer.discrepancy;
    assert!(told.noise_rms < 1.5 * NOISE, "{}", told.noise_rms);
    assert!(told.rms > 5.0 * NOISE, "{}", told.rms);
}

/// An offset that is smaller than what a resonance's law misses is none of what it misses: no resonance shifts a mean.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn an_offset_beside_a_sensor_that_rings_is_named() {
    let mut bench = Bench::new(3);
    bench.ring = Some([1330.0, 0.06, 1.0]);
    let found = bench.found(|r| r[3] += 3.0);
    let mut named: Vec<&str> = found.answer.causes.iter().map(|c| c.effect).collect();
    named.sort_unstable();
    assert_eq!(named, ["sensor_offset", "sensor_resonance"]);
}

/// Straight teeth enter and leave at once and nothing spreads it: the record shows where they leave, so a width that is wrong turns
/// the tooth, and no slope says so.
#[test]
fn a_width_by_straight_teeth_is_named() {
    let mut bench = Bench::new(2);
    (bench.cutter.helix, bench.bandwidth_hz) = (0.0, None);
    bench.said.remove(0);
    bench.done = bench.said.clone();
    bench.done[1..]
        .iter_mut()
        .for_each(|pass| pass.width += 0.35);
    let found = bench.found(|_| ());
    let named: Vec<&str> = found.answer.causes.iter().map(|c| c.effect).collect();
    assert_eq!(named, ["width_of_cut"], "{:?}", found.answer.verdict);
}

/// What changes the forces along no straight line is told with an interval that holds it.
#[test]
fn a_runout_is_told_within_its_interval() {
    let mut bench = Bench::new(4);
    bench.cutter.runout = 14e-6;
    let found = bench.found(|_| ());
    let cause = &found.answer.causes[0];
    let [low, high] = cause.interval("runout").unwrap();
    assert!(low <= 14e-6 && 14e-6 <= high, "{low} to {high}");
    assert!(high - low < 5e-6, "{low} to {high}");
}
