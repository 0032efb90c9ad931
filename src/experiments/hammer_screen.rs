//! Hammer tests: the records cut into hits, each hit judged.

use crate::measurement::hammer::{HammerRecord, HammerRun};
use crate::signal::decay::residual_ring;
use crate::signal::fault::Fault;
use crate::signal::frf::HitSpectra;
use crate::signal::judge::{self, Hit};
use crate::signal::off_axis;
use crate::signal::pulse::Pulse;
use crate::signal::spectrum::lines_up_to;
use crate::signal::trigger::Trigger;
use rustfft::num_complex::Complex64;

/// Angle, rad, beyond which a hit counts as struck in another direction (15 degrees), by so many standard
/// errors.
const OFF_AXIS: f64 = 0.26;
const SURELY: f64 = 3.0;

/// One hit and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ScreenedHit {
    /// Stated direction of the force.
    pub direction: String,
    /// Its label in the file, or its number where it was found by trigger.
    pub hit: String,
    /// Force, N.
    pub force: Vec<f64>,
    /// Acceleration per output, m/s².
    pub responses: Vec<Vec<f64>>,
    /// Why it is not used; empty: it is used.
    pub faults: Vec<Fault>,
    /// Share of the response left at the end of the record, worst output ([`residual_ring`]).
    pub ring: f64,
}

impl ScreenedHit {
    /// Whether the hit enters the FRF.
    pub fn used(&self) -> bool {
        self.faults.is_empty()
    }

    /// The reasons as one sentence; none if the hit is used.
    pub fn why(&self) -> Option<String> {
        let reasons: Vec<String> = self.faults.iter().map(Fault::to_string).collect();
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }

    fn view(&self, record: &HammerRecord) -> Hit<'_> {
        Hit {
            force: &self.force,
            responses: &self.responses,
            interval_s: record.interval_s,
            window_rate: record.exponential_window_s.map_or(0.0, f64::recip),
        }
    }
}

/// Cuts a record into hits and judges them for use up to `to_hz`.
pub fn screen(record: &HammerRecord, to_hz: f64) -> Vec<ScreenedHit> {
    let mut hits: Vec<ScreenedHit> = Vec::new();
    for run in &record.runs {
        let known = hits.iter().filter(|h| h.direction == run.direction).count();
        hits.extend(cut(run, known, record.interval_s));
    }
    for hit in &mut hits {
        hit.faults = judge::faults(&hit.view(record), to_hz);
        hit.ring = ring(hit, record.interval_s, to_hz);
    }
    for direction in directions(&hits) {
        judge_family(&mut hits, &direction, record);
    }
    judge_axes(&mut hits, record.interval_s, to_hz);
    hits
}

/// The directions in the order of their first hit.
pub fn directions(hits: &[ScreenedHit]) -> Vec<String> {
    let mut directions: Vec<String> = Vec::new();
    for hit in hits {
        if !directions.contains(&hit.direction) {
            directions.push(hit.direction.clone());
        }
    }
    directions
}

fn cut(run: &HammerRun, known: usize, interval_s: f64) -> Vec<ScreenedHit> {
    let hit = |label: String, range: std::ops::Range<usize>| ScreenedHit {
        direction: run.direction.clone(),
        hit: label,
        force: run.force[range.clone()].to_vec(),
        responses: run
            .responses
            .iter()
            .map(|r| r[range.clone()].to_vec())
            .collect(),
        faults: Vec::new(),
        ring: 0.0,
    };
    match &run.hit {
        Some(label) => vec![hit(label.clone(), 0..run.force.len())],
        None => Trigger::default()
            .segments(&run.force, interval_s)
            .into_iter()
            .enumerate()
            .map(|(i, range)| hit((known + i + 1).to_string(), range))
            .collect(),
    }
}

fn ring(hit: &ScreenedHit, interval_s: f64, to_hz: f64) -> f64 {
    let Some(pulse) = Pulse::find(&hit.force) else {
        return 0.0;
    };
    let average = (0.5 / (to_hz * interval_s)) as usize;
    let rings = hit
        .responses
        .iter()
        .map(|r| residual_ring(r, &pulse, average));
    rings.fold(0.0, f64::max)
}

fn judge_family(hits: &mut [ScreenedHit], direction: &str, record: &HammerRecord) {
    let sound = |hit: &&mut ScreenedHit| hit.direction == direction && hit.used();
    let mut family: Vec<&mut ScreenedHit> = hits.iter_mut().filter(sound).collect();
    let views: Vec<Hit> = family.iter().map(|hit| hit.view(record)).collect();
    let faults = judge::family_faults(&views);
    for (hit, faults) in family.iter_mut().zip(faults) {
        hit.faults = faults;
    }
}

/// Rejects hits whose force was off its axis, the worst first, until none is.
fn judge_axes(hits: &mut [ScreenedHit], interval_s: f64, to_hz: f64) {
    let frfs: Vec<_> = hits
        .iter()
        .map(|hit| ratios(hit, interval_s, to_hz))
        .collect();
    loop {
        let angles = (0..hits.len()).filter_map(|i| Some((i, axis_angle(hits, &frfs, i)?)));
        let worst = angles.max_by(|a, b| surely(a.1).total_cmp(&surely(b.1)));
        match worst {
            Some((i, found)) if surely(found) > OFF_AXIS => {
                hits[i].faults.push(Fault::OffAxis { angle: found.0 })
            }
            _ => return,
        }
    }
}

/// The least that an angle may be.
fn surely((angle, stderr): (f64, f64)) -> f64 {
    angle - SURELY * stderr
}

type Frf = Vec<Vec<Complex64>>;

fn ratios(hit: &ScreenedHit, interval_s: f64, to_hz: f64) -> Frf {
    let keep = lines_up_to(hit.force.len(), interval_s, Some(to_hz));
    let spectra = HitSpectra::new(hit.force.clone(), hit.responses.clone(), keep);
    (0..hit.responses.len()).map(|o| spectra.ratio(o)).collect()
}

/// The angle of hit `i` with its standard error, told from at least two others in its direction.
fn axis_angle(hits: &[ScreenedHit], frfs: &[Frf], i: usize) -> Option<(f64, f64)> {
    let mean_of = |direction: &str, count: usize| {
        let same = |j: &usize| j != &i && hits[*j].used() && hits[*j].direction == direction;
        let fits = |j: &usize| frfs[*j][0].len() == frfs[i][0].len();
        let family: Vec<&Frf> = (0..hits.len())
            .filter(same)
            .filter(fits)
            .map(|j| &frfs[j])
            .collect();
        (family.len() >= count).then(|| mean(&family))
    };
    if !hits[i].used() {
        return None;
    }
    let own = mean_of(&hits[i].direction, 2)?;
    let others = directions(hits)
        .into_iter()
        .filter(|d| *d != hits[i].direction);
    let across: Vec<Frf> = others.filter_map(|d| mean_of(&d, 1)).collect();
    let across: Vec<&off_axis::Column> = across.iter().map(Vec::as_slice).collect();
    off_axis::angle(&frfs[i], &own, &across)
}

fn mean(family: &[&Frf]) -> Frf {
    let n = family.len() as f64;
    let line = |o: usize, k: usize| family.iter().map(|frf| frf[o][k]).sum::<Complex64>() / n;
    let outputs = family[0].iter().enumerate();
    outputs
        .map(|(o, h)| (0..h.len()).map(|k| line(o, k)).collect())
        .collect()
}
