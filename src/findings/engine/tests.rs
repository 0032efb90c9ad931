//! Two toy kinds behind the engine: one linear with known sizes, one with free shapes.

use super::*;
use crate::findings::Verdict;

/// Noise of one deviation by a hash of the row.
fn noise(seed: u64, row: usize) -> f64 {
    let mut state = (row as u64 + 1)
        .wrapping_add(seed << 32)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mut uniform = || {
        state ^= state >> 31;
        state = state.wrapping_mul(0xBF58_476D_1CE4_E5B9);
        state ^= state >> 27;
        ((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    };
    let (a, b) = (uniform(), uniform());
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

/// Causes by name, each with its shapes.
type Causes = Vec<(&'static str, Vec<Member>)>;

/// Columns of a toy kind: its causes by name, each with its shapes.
pub(super) struct Toy {
    reading: Vec<f64>,
    causes: fn(usize) -> Causes,
    nuisances: Vec<Nuisance>,
    /// What the square of an amount of a cause adds of [`bend`].
    bends: Option<fn(&str) -> f64>,
    /// Which rivals are fitted until they arrive.
    peers: Peers,
    /// Whether all causes are of one mechanism.
    are_kin: bool,
}

/// What causes do beyond first order: little in every row, four squares in all of 200.
fn bend(row: usize) -> f64 {
    0.2 * (0.7 * row as f64).sin()
}

impl Toy {
    pub(super) fn new(
        seed: u64,
        rows: usize,
        causes: fn(usize) -> Causes,
        hidden: impl Fn(usize) -> f64,
    ) -> Self {
        let nuisance = |i: usize| (i as f64 / 9.0).cos();
        let reading = (0..rows).map(|i| 0.3 * nuisance(i) + hidden(i) + noise(seed, i));
        Self {
            reading: reading.collect(),
            causes,
            nuisances: vec![Nuisance {
                column: (0..rows).map(nuisance).collect(),
                spread: 0.5,
            }],
            bends: None,
            peers: Peers::Near,
            are_kin: false,
        }
    }

    fn names(&self) -> (Vec<&'static str>, Verdict) {
        let found = diagnose(self, &Judgement::default());
        let groups = found.answer.groups.iter().map(|g| g.effects[0]);
        let mut names: Vec<&str> = found
            .answer
            .causes
            .iter()
            .map(|c| c.effect)
            .chain(groups)
            .collect();
        names.sort_unstable();
        (names, found.answer.verdict)
    }
}

impl Experiment for Toy {
    fn unit(&self) -> &'static str {
        "m"
    }

    fn is_linear(&self) -> bool {
        self.bends.is_none()
    }

    fn peers(&self) -> Peers {
        self.peers
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        let square = |b: &Blamed| self.bends.map_or(0.0, |f| f(b.effect)) * b.amounts[0].powi(2);
        let beyond: f64 = about.iter().map(square).sum();
        let rows = self.reading.len();
        let suspect = |(effect, members): (&'static str, Vec<Member>)| Suspect {
            effect,
            site: "A1".into(),
            summary: "a toy",
            mechanism: if self.are_kin { "kin" } else { effect },
            share: 0.0,
            members,
            named: true,
            law_error: 0.0,
            can_be: |_, _| true,
        };
        let cosine = |k: usize, i: usize| {
            (std::f64::consts::PI * k as f64 * (i as f64 + 0.5) / rows as f64).cos() / k as f64
        };
        Statement {
            reading: (0..rows)
                .map(|i| self.reading[i] - beyond * bend(i))
                .collect(),
            noise: Box::new(White {
                spread: vec![1.0; rows],
                rows: 30.0,
            }),
            nuisances: self.nuisances.clone(),
            suspects: (self.causes)(rows).into_iter().map(suspect).collect(),
            span: (1..40)
                .map(|k| (0..rows).map(|i| cosine(k, i)).collect())
                .collect(),
            splits: vec![(0..rows).map(|i| i * 40 / rows % 8).collect()],
            aspects: Aspects::default(),
        }
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        vec![("amount", blamed.amounts[0], "1")]
    }

    fn would_tell(&self, _: &[(&'static str, String)]) -> String {
        "another toy".into()
    }

    fn place(&self, _: &[f64]) -> String {
        "everywhere".into()
    }

    fn remaining(&self, _: &[f64]) -> Remaining {
        Remaining::default()
    }
}

pub(super) fn steps(rows: usize) -> Causes {
    let of = |f: fn(f64) -> f64| {
        vec![Member::given(
            (0..rows)
                .map(|i| 20.0 * f(i as f64 / rows as f64))
                .collect(),
            0.5,
        )]
    };
    vec![
        ("base", of(|t| 1.0 - t)),
        ("drive", of(|t| t * t)),
        ("tilt", of(|t| (6.0 * t).sin())),
    ]
}

pub(super) fn load(i: usize) -> f64 {
    (i as f64 * 0.1).sin()
}

pub(super) fn cycle(rows: usize) -> Causes {
    let gap = |width: f64| {
        Member::free((0..rows).map(|i| (load(i) / width).tanh()).collect())
            .positive()
            .shaped(&[width])
    };
    let power = |p: i32| Member::free((0..rows).map(|i| load(i).powi(p)).collect());
    let skew = Member::free((0..rows).map(|i| (i as f64 * 0.1 + 0.3).cos()).collect());
    vec![
        ("backlash", [0.02, 0.04, 0.08].map(gap).to_vec()),
        ("cubic", [3, 5].map(power).to_vec()),
        ("skew", vec![skew]),
    ]
}

#[test]
fn a_linear_kind_names_what_is_hidden_and_nothing_else() {
    for seed in 0..5 {
        let toy = |hidden: fn(f64) -> f64| {
            Toy::new(seed, 90, steps, move |i| hidden(i as f64 / 90.0)).names()
        };
        assert_eq!(toy(|_| 0.0), (vec![], Verdict::Sufficient));
        assert_eq!(
            toy(|t| 8.0 * (6.0 * t).sin()),
            (vec!["tilt"], Verdict::Explained)
        );
        let pair = toy(|t| 8.0 * (6.0 * t).sin() + 9.0 * (1.0 - t));
        assert_eq!(pair, (vec!["base", "tilt"], Verdict::Explained));
    }
}

#[test]
fn a_kind_with_free_shapes_does_as_well() {
    for seed in 0..5 {
        let toy = |hidden: fn(usize) -> f64| Toy::new(seed, 252, cycle, hidden).names();
        assert_eq!(toy(|_| 0.0), (vec![], Verdict::Sufficient));
        assert_eq!(
            toy(|i| 6.0 * (load(i) / 0.05).tanh()),
            (vec!["backlash"], Verdict::Explained)
        );
        let pair = toy(|i| 6.0 * (load(i) / 0.05).tanh() + 5.0 * (i as f64 * 0.1 + 0.3).cos());
        assert_eq!(pair, (vec!["backlash", "skew"], Verdict::Explained));
    }
}

#[test]
fn what_nobody_knows_is_called_unknown() {
    for seed in 0..5 {
        let toy = Toy::new(seed, 252, cycle, |i| 8.0 * (i as f64 * 0.031).sin());
        assert_eq!(toy.names().1, Verdict::UnknownCause);
    }
}

/// Six numbers that are known to a third of what is wrong make up for all but a little of it, each three deviations off: unseen
/// rows show the cause by a percent, and what is known of the numbers shows it by far.
#[test]
fn a_cause_stays_where_all_that_is_uncertain_would_have_to_stand_in_for_it() {
    let base = |rows: usize| -> Causes {
        let one = vec![Member::given(vec![1.0; rows], 2.0)];
        vec![("base", one), ("skew", steps(rows).remove(2).1)]
    };
    let piece = |k: usize, spread: f64| Nuisance {
        column: (0..6000)
            .map(|i| f64::from(u8::from(i * 6 / 6000 == k)))
            .collect(),
        spread,
    };
    for seed in 0..5 {
        let mut toy = Toy::new(seed, 6000, base, |_| 2.4);
        toy.nuisances.extend((0..6).map(|k| piece(k, 0.72)));
        assert_eq!(toy.names(), (vec!["base"], Verdict::Explained));
        let mut sound = Toy::new(seed, 6000, base, |_| 0.9);
        sound.nuisances.extend((0..6).map(|k| piece(k, 0.72)));
        assert_eq!(sound.names(), (vec![], Verdict::Sufficient));
    }
}

fn bent(rows: usize) -> Causes {
    let of = |more: f64| {
        let column = |i: usize| 3.0 * (i as f64 / 15.0).sin() + more * bend(i);
        vec![Member::given((0..rows).map(column).collect(), 1.0)]
    };
    vec![("drive", of(0.8)), ("tilt", of(0.0))]
}

/// Two of the drive and two of the tilt do the same; the straight line of the drive is the nearer one.
fn alike(seed: u64, peers: Peers, are_kin: bool) -> Vec<usize> {
    let hidden = |i: usize| 6.0 * (i as f64 / 15.0).sin() + 4.0 * bend(i);
    let toy = Toy {
        bends: Some(|effect| if effect == "drive" { 0.6 } else { 1.0 }),
        peers,
        are_kin,
        ..Toy::new(seed, 200, bent, hidden)
    };
    let found = diagnose(&toy, &Judgement::default());
    let groups = found.answer.groups.iter();
    groups.map(|g| g.effects.len()).collect()
}

/// The tilt is not ruled out by its own straight line about the drive.
#[test]
fn a_rival_is_weighed_where_it_has_arrived() {
    for seed in 1..5 {
        assert_eq!(alike(seed, Peers::Near, false), [2], "seed {seed}");
    }
}

#[test]
fn kin_are_weighed_where_they_have_arrived_and_strangers_by_their_straight_lines() {
    let groups = |peers, are_kin| {
        let all = (1..9).map(|seed| alike(seed, peers, are_kin));
        all.filter(|groups| groups == &[2]).count()
    };
    assert_eq!(groups(Peers::Kin, true), 8);
    let by_lines = groups(Peers::Nobody, true);
    assert!(by_lines <= 4, "{by_lines}");
    assert_eq!(groups(Peers::Kin, false), by_lines);
}

/// Of two shapes that do the same the rarer one is none.
#[test]
fn what_is_rare_stands_behind_what_does_the_same() {
    let twins = |rows: usize| {
        let column = || Member::free((0..rows).map(|i| f64::from(i > rows / 3)).collect());
        vec![
            ("plain", vec![column()]),
            ("seldom", vec![column().rare(20.0)]),
        ]
    };
    let toy = Toy::new(5, 120, twins, |i| if i > 40 { 6.0 } else { 0.0 });
    assert_eq!(toy.names(), (vec!["plain"], Verdict::Explained));
}

#[test]
fn what_is_exact_may_be_smaller_where_a_kind_says_so() {
    let level = |rows: usize| vec![("level", vec![Member::free(vec![1.0; rows])])];
    let toy = Toy::new(3, 400, level, |_| 0.9);
    let told = |exact_peak: Option<f64>| {
        let judgement = Judgement {
            exact_peak,
            ..Judgement::default()
        };
        diagnose(&toy, &judgement).answer.causes.len()
    };
    assert_eq!((told(None), told(Some(0.3))), (0, 1));
}
