//! The statement of a joint for the engine.

use super::channels::{Channels, largest};
use super::joint::{Joint, TORQUE};
use super::patterns::PATTERNS;
use super::projection::partial;
use super::{EFFECTS, backlash, ripple, sensor_offset};
use crate::findings::engine::{
    Aspects, Blamed, Experiment, Judgement, Nuisance, Remaining, Statement, Suspect,
};
use crate::findings::load_cycle::structure::binned;
use crate::findings::table;

/// Standard deviation of a declared delay, as a share of it.
const DECLARED: f64 = 0.1;
/// Standard deviation of the lag of twist behind torque, s: gears damp themselves, and drives filter their currents.
const LAG_S: f64 = 0.003;
/// Folds of rows, and pieces of time per fold: long ones, then short ones for what shows in few places.
const FOLDS: usize = 10;
const PIECES: [usize; 3] = [1, 5, 20];

/// Parts of the record over which lasts what does not swing.
const LASTS: usize = 40;

/// The numbers that decide, where motion has a reason of its own. Set on seeds 511 to 514 of
/// `tests/judge/joint_motion.rs`, and on the real run of a KR 300.
pub fn judgement() -> Judgement {
    Judgement {
        // a tenth of the variance: gears wave over their angle, and drives ripple
        left_share: 0.3,
        // thousands of readings make significant what laws miss of a delay or a friction; 8 was tried
        companion_gain: 4.0,
        // and a small ripple beside a large delay is seen in all of them
        share: 0.02,
        // they show what is hardly larger than the noise of one; with 1.0 a real run has frictions that come and go
        peak: 1.5,
        left_peak: 1.0,
        // a loop that is all but a spring explains thousands of nats, and is worth six more than none: in 120 files by a stranger the
        // leading sets with odds below four (seven files, 1.1 to 3.8) held no true cause, the next one (5.4) did. Set on these files
        over_none: 4.0,
        ..Judgement::default()
    }
}

impl Experiment for Joint {
    fn unit(&self) -> &'static str {
        "rad"
    }

    /// The instant of a jump is not linear.
    fn is_linear(&self) -> bool {
        false
    }

    fn is_settled(&self, before: &Statement, after: &Statement) -> bool {
        let (old, new) = (before.suspects.iter(), after.suspects.iter());
        let is_same = old.map(|s| &s.members).eq(new.map(|s| &s.members));
        let as_many = before.nuisances.len() == after.nuisances.len();
        is_same && as_many && before.span == after.span
    }

    /// Friction and gears follow nobody's formula.
    fn has_rough_laws(&self) -> bool {
        true
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        self.state_beside(about, &[])
    }

    fn state_beside(&self, about: &[Blamed], uncertain: &[f64]) -> Statement {
        // the torque is among the nuisances: its amount is the compliance, turned round
        let presumed = self.presumed_compliance();
        let compliance = uncertain.get(TORQUE).map_or(presumed, |a| presumed - a);
        let parts: Vec<Vec<f64>> = about.iter().map(|b| b.part.clone()).collect();
        match parts.is_empty() {
            true => self.stated(about, &parts, compliance),
            false => self.beside(&parts).stated(about, &parts, compliance),
        }
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        table::parameters(EFFECTS, self, blamed)
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        table::would_tell(EFFECTS, rivals)
    }

    fn place(&self, missed: &[f64]) -> String {
        place(missed, &self.data).into()
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        Remaining {
            shape: binned(&self.data.torque, left),
            over_time: binned(&self.data.time, left),
            description: "no pattern over speed, torque or angle that a known cause makes".into(),
        }
    }
}

impl Joint {
    fn stated(&self, about: &[Blamed], parts: &[Vec<f64>], compliance: f64) -> Statement {
        Statement {
            reading: self.reading(),
            noise: Box::new(self.noise.clone()),
            nuisances: self.nuisances(about),
            suspects: self.suspects_about(about, compliance),
            span: self.span(parts),
            splits: self.splits(),
            aspects: self.aspects(),
        }
    }

    /// Everybody.
    pub fn suspects(&self) -> Vec<Suspect> {
        let mut suspects = table::suspects(EFFECTS, self);
        suspects.extend(table::patterns(PATTERNS, self));
        suspects.iter_mut().for_each(|s| self.price(s));
        suspects
    }

    /// Everybody, the instant of a jump that was found among its neighbours, and of what follows the speed only
    /// what the torque bears out.
    fn suspects_about(&self, about: &[Blamed], compliance: f64) -> Vec<Suspect> {
        let mut suspects = self.suspects();
        for blamed in about {
            match blamed.effect {
                "sensor_offset" => {
                    let own = suspects.iter_mut().find(|s| s.effect == blamed.effect);
                    own.into_iter().for_each(|s| {
                        s.members = sensor_offset::about(self, blamed);
                        s.share = 0.0;
                        self.price(s);
                    });
                }
                "viscous_friction" => {
                    deny(&mut suspects, self.denied(blamed.amounts[0], compliance))
                }
                "time_skew" => deny(&mut suspects, self.denied(-blamed.amounts[0], compliance)),
                _ => {}
            }
        }
        suspects
    }

    /// What was sought among more shapes than are stated pays for all of them.
    fn price(&self, suspect: &mut Suspect) {
        let tried = match suspect.effect {
            "sensor_offset" => sensor_offset::tried(self),
            "encoder_ripple" | "meshing" => ripple::TRIED,
            _ => return,
        };
        suspect.share -= (tried / suspect.members.len() as f64).ln();
    }

    /// Of friction and a link encoder that is read early, which add the same, the one that the torque denies.
    fn denied(&self, rate: f64, compliance: f64) -> Option<&'static str> {
        if rate <= 0.0 {
            return Some("viscous_friction");
        }
        let [shown, error] =
            [self.friction.viscous, self.friction.viscous_std].map(|f| f * compliance.max(0.0));
        let near = |said: f64| (shown - said).abs() < (2.0 * error).max(NEAR * rate);
        let far = |said: f64| (shown - said).abs() > (4.0 * error).max(FAR * rate);
        match (near(rate) && far(0.0), near(0.0) && far(rate)) {
            (true, _) => Some("time_skew"),
            (_, true) => Some("viscous_friction"),
            _ => None,
        }
    }

    /// What every model has; the rest of a declared delay; damping of the gear and lag of the torque; what laws that are
    /// nearly right miss; what friction holds before the record; ripples too small to speak of.
    fn nuisances(&self, about: &[Blamed]) -> Vec<Nuisance> {
        let data = &self.data;
        let known = |column: Vec<f64>, spread: f64| Nuisance { column, spread };
        let free = |column| known(column, f64::INFINITY);
        let mut all: Vec<Nuisance> = self.base().into_iter().map(free).collect();
        all[TORQUE].spread = self.spring_spread(about);
        let declared = DECLARED * self.declared.map_or(0.0, f64::abs);
        all.push(known(data.speed.clone(), declared));
        let lag = LAG_S * partial(&self.beside_torque(), &data.torque, &data.twist).slope;
        all.push(known(data.torque_rate.clone(), lag.abs()));
        all.extend(self.beyond_motion().map(free));
        all.extend(self.missed(about));
        all.extend(self.begun(about));
        let gaps = about.iter().filter(|b| b.effect == backlash::EFFECT.name);
        all.extend(gaps.flat_map(|b| backlash::flanks(self, b)));
        let small = self.waves.iter().filter(|w| w.is_small);
        all.extend(small.flat_map(|w| w.columns.clone()).map(free));
        all.retain(|n| n.spread > 0.0);
        all
    }

    /// What lasts, and what swings within a fortieth of the record: what a loop misses is no ripple.
    fn aspects(&self) -> Aspects {
        let n = self.data.rows();
        Aspects {
            groups: vec![(0..n).map(|i| i * LASTS / n).collect()],
        }
    }

    /// Pieces of time, long and short ones.
    pub fn splits(&self) -> Vec<Vec<usize>> {
        let n = self.data.rows();
        let folds = |pieces: usize| (0..n).map(|i| i * pieces * FOLDS / n % FOLDS).collect();
        PIECES.map(folds).to_vec()
    }
}

fn deny(suspects: &mut Vec<Suspect>, denied: Option<&str>) {
    suspects.retain(|s| Some(s.effect) != denied);
}

/// Shares of what the twist asks for, or two and four standard errors, within which the torque bears it out, and beyond
/// which it does not.
const NEAR: f64 = 0.3;
const FAR: f64 = 0.5;

/// Where a residual is largest.
fn place(residual: &[f64], data: &Channels) -> &'static str {
    let (top, load) = (data.top_speed(), largest(&data.torque));
    let square = |keep: &dyn Fn(usize) -> bool| {
        let inside: Vec<usize> = (0..data.rows()).filter(|i| keep(*i)).collect();
        let sum: f64 = inside.iter().map(|i| residual[*i] * residual[*i]).sum();
        match inside.len() * 20 < data.rows() {
            true => 0.0,
            false => sum / inside.len() as f64,
        }
    };
    let all = square(&|_| true).max(f64::MIN_POSITIVE);
    let (speed, torque) = (
        |i: usize| data.speed[i].abs(),
        |i: usize| data.torque[i].abs(),
    );
    let places = [
        ("largest in fast motion", square(&|i| speed(i) > 0.6 * top)),
        (
            "largest in slow motion and at rest",
            square(&|i| speed(i) < 0.1 * top),
        ),
        (
            "largest at high torque",
            square(&|i| torque(i) > 0.7 * load),
        ),
        (
            "largest near zero torque",
            square(&|i| torque(i) < 0.15 * load),
        ),
    ];
    let best = places.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    best.filter(|b| b.1 > 1.4 * all)
        .map_or("spread over the motion", |b| b.0)
}
