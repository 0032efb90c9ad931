//! Causes that may be blamed in place of another.

use super::super::algebra::V3;
use super::super::rigid::{across, between, postured};
use super::dynamics::{C, Pairs, Plant, World, lines, reach};
use super::line::{Line, whole};
use super::robot::{Hinge, Robot, along, span};
use super::sight::Sight;
use nalgebra::DMatrix;

/// Stiffness of what stands for a rigid joint, N·m/rad.
pub const RIGID: f64 = 1e10;

/// A cause that may be blamed, and what it does to the transfer functions.
pub struct Rival {
    pub effect: &'static str,
    pub site: Option<String>,
    pub columns: Vec<Vec<f64>>,
    /// By how many stated standard deviations it leaves the file: a sound robot may go some of the way.
    pub cost: f64,
}

impl Rival {
    pub fn free(effect: &'static str, site: Option<String>, columns: Vec<Vec<f64>>) -> Self {
        Self {
            effect,
            site,
            columns,
            cost: f64::INFINITY,
        }
    }
}

/// What a spring of the file is blamed as.
pub fn blamed(kind: &str, site: &str) -> (&'static str, Option<String>) {
    match kind {
        "drive" => ("drive_stiffness", Some(site.into())),
        "tilt" => ("tilt_stiffness", Some(site.into())),
        "base" => ("base_compliance", None),
        _ => ("link_compliance", None),
    }
}

/// Hinges that may turn out to give: effect, site, members.
pub type Candidate = (&'static str, Option<String>, Vec<usize>);

/// Rigid hinges where something may turn out to give.
pub fn with_candidates(robot: &Robot) -> (Robot, Vec<Candidate>) {
    let mut own = robot.clone();
    let mut all = Vec::new();
    let mut add = |own: &mut Robot, effect, site: Option<String>, link, rank, axes: &[V3], p| {
        let from = own.hinges.len();
        for axis in axes {
            own.hinges.push(Hinge {
                kind: "candidate",
                site: String::new(),
                link,
                rank,
                axis: *axis,
                point: p,
                k: RIGID,
                d: 0.0,
            });
        }
        all.push((effect, site, (from..from + axes.len()).collect::<Vec<_>>()));
    };
    let level = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    add(&mut own, "base_compliance", None, 0, 0.1, &level, [0.0; 3]);
    add(
        &mut own,
        "base_compliance",
        None,
        0,
        0.11,
        &[[0.0, 0.0, 1.0]],
        [0.0; 3],
    );
    for j in 0..6 {
        let site = format!("A{}", j + 1);
        if robot.group("tilt", &site).is_empty() {
            let axes = across(robot.frame.axes[j]);
            let p = robot.frame.points[j];
            add(
                &mut own,
                "missing_tilt",
                Some(site),
                j,
                j as f64 + 0.69,
                &axes,
                p,
            );
        }
    }
    for link in 1..=4 {
        let (from, to) = span(robot, link);
        let axes = across(along(from, to));
        let rank = link as f64 + 0.05;
        let site = Some(format!("link{link}"));
        add(
            &mut own,
            "link_compliance",
            site,
            link,
            rank,
            &axes,
            between(from, to, 0.5),
        );
    }
    (own, all)
}

impl Sight {
    /// Best that a hinge of other stiffness leaves of a change, from a start; ln of the factors, one per member, and oil.
    pub fn refined(
        &self,
        members: &[usize],
        told: f64,
        start: f64,
        shown: &dyn Fn(&[f64]) -> f64,
    ) -> f64 {
        let n = self.lines[0].inverse.nrows();
        let columns = DMatrix::from_fn(n, members.len(), |i, j| {
            f64::from(u8::from(i == members[j]))
        });
        let left = |p: &[f64]| {
            let of = |l: &Line| {
                let each: Vec<C> = (0..members.len())
                    .map(|j| {
                        let k = start * p[j].exp();
                        let oil = if told == RIGID {
                            p[members.len()].exp() * 1e-3
                        } else {
                            0.0
                        };
                        l.s * (oil * k) + (k - told)
                    })
                    .collect();
                l.changed(&columns, &each)
            };
            shown(&self.white(&self.lines.iter().map(of).collect::<Vec<_>>()))
        };
        let mut p = vec![0.0; members.len() + 1];
        let mut best = left(&p);
        for step in [0.5, 0.25, 0.12, 0.06] {
            for _ in 0..2 {
                for i in 0..p.len() {
                    for sign in [step, -step] {
                        p[i] += sign;
                        let now = left(&p);
                        if now < best {
                            best = now;
                        } else {
                            p[i] -= sign;
                        }
                    }
                }
            }
        }
        best
    }

    pub fn blame(
        &mut self,
        eyes: &World,
        plant: &Plant,
        springs: &[(&'static str, String, Vec<usize>)],
        candidates: &[Candidate],
        all: &[Line],
        known: f64,
    ) {
        let n = plant.m.nrows();
        let unit = |members: &[usize]| {
            DMatrix::from_fn(n, members.len(), |i, j| {
                f64::from(u8::from(i == members[j]))
            })
        };
        let mut found: Vec<Rival> = Vec::new();
        let mut soft = |effect, site: &Option<String>, members: &[usize], levels: &[f64]| {
            let columns = unit(members);
            let told = eyes.robot.hinges[members[0]].k;
            let at = |stiffness: &[f64], oil: f64| {
                let each = |l: &Line| -> Vec<C> {
                    let pairs = members.iter().zip(stiffness);
                    let more =
                        |(i, k): (&usize, &f64)| l.s * (oil * k) + (k - eyes.robot.hinges[*i].k);
                    pairs.map(more).collect()
                };
                let v: Vec<Pairs> = all.iter().map(|l| l.changed(&columns, &each(l))).collect();
                self.white(&v)
            };
            let less = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
            for level in levels {
                let plain = vec![*level; members.len()];
                let own = at(&plain, 0.0);
                let lossy = (told == RIGID).then(|| less(&at(&plain, 1e-3), &own));
                let beside = (0..members.len()).map(|i| {
                    let near =
                        (0..members.len()).map(|j| if i == j { 1.2 * level } else { *level });
                    less(&at(&near.collect::<Vec<f64>>(), 0.0), &own)
                });
                let all: Vec<Vec<f64>> = beside.chain(lossy).collect();
                let all = std::iter::once(own).chain(all).collect();
                found.push(Rival {
                    cost: match told == RIGID {
                        true => f64::INFINITY,
                        false => (level / told).ln().abs() / known,
                    },
                    ..Rival::free(effect, site.clone(), all)
                });
            }
        };
        for (kind, site, members) in springs {
            let (effect, site) = blamed(kind, site);
            let k = eyes.robot.hinges[members[0]].k;
            let levels = [0.35, 0.55, 0.75, 0.87, 1.15, 1.3, 1.8, 3.0].map(|x| x * k);
            soft(effect, &site, members, &levels);
        }
        for (effect, site, members) in candidates {
            let levels = [4e6, 1.2e7, 4e7, 1.5e8].map(|x| x * eyes.robot.scale.min(1.0));
            soft(effect, site, members, &levels);
        }
        for (kind, site, members) in springs {
            let whose = matches!(*kind, "drive" | "tilt").then(|| site.clone());
            let v: Vec<Pairs> = all.iter().map(|l| l.springs(members, l.s)).collect();
            found.push(Rival::free("joint_damping", whose, vec![self.white(&v)]));
        }
        let at = lines(&eyes.robot, &eyes.joints);
        for link in 2..=6 {
            let point = match link {
                6 => eyes.tip(),
                _ => postured(
                    &eyes.robot.frame,
                    &eyes.joints,
                    link,
                    eyes.robot.frame.points[link],
                ),
            };
            let rank = if link == 6 { 7.0 } else { link as f64 + 0.02 };
            let j = reach(&eyes.robot, &at, rank, point);
            let more = whole(&(j.transpose() * &j));
            let v: Vec<Pairs> = all.iter().map(|l| l.mass(&more)).collect();
            let site = Some(if link == 6 {
                "tool".into()
            } else {
                format!("link{link}")
            });
            found.push(Rival::free("added_mass", site, vec![self.white(&v)]));
        }
        found.extend(self.instruments(plant, all));
        self.rivals = found;
    }

    pub fn instruments(&self, plant: &Plant, all: &[Line]) -> Vec<Rival> {
        let of = |f: &dyn Fn(&Line) -> Pairs| -> Vec<f64> {
            let v: Vec<Pairs> = all.iter().map(f).collect();
            self.white(&v)
        };
        let mut found: Vec<Rival> = Vec::new();
        for axis in 0..4 {
            let gain = |l: &Line| {
                let mut h = l.transfer(plant);
                for (r, row) in h.iter_mut().enumerate() {
                    let own = f64::from(u8::from(axis == 3 || axis == r));
                    row.iter_mut().for_each(|z| *z *= own);
                }
                h
            };
            let site = ["sensor-x", "sensor-y", "sensor-z", "sensor"][axis];
            found.push(Rival::free(
                "accelerometer_gain",
                Some(site.into()),
                vec![of(&gain)],
            ));
        }
        let turned = |about: usize| {
            of(&|l: &Line| {
                let h = l.transfer(plant);
                let (a, b) = ((about + 1) % 3, (about + 2) % 3);
                let mut to = [[C::new(0.0, 0.0); 3]; 3];
                for d in 0..3 {
                    to[a][d] = -h[b][d];
                    to[b][d] = h[a][d];
                }
                to
            })
        };
        let columns = (0..3).map(turned).collect();
        found.push(Rival::free("accelerometer_misalignment", None, columns));
        let skewed = |l: &Line| l.transfer(plant).map(|row| row.map(|z| -l.s * z));
        found.push(Rival::free("time_skew", None, vec![of(&skewed)]));
        let aside = |l: &Line| {
            let near = Line::new(plant, l.s + 0.02).transfer(plant);
            let own = l.transfer(plant);
            std::array::from_fn(|r| std::array::from_fn(|d| (near[r][d] - own[r][d]) / 0.02))
        };
        found.push(Rival::free("exponential_window", None, vec![of(&aside)]));
        found
    }
}
