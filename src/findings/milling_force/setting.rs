//! What of the process may differ from what is stated, as one vector: coefficients (SI), runout along
//! tooth 1 and a quarter turn on (m), how much each tooth is shorter (m), along its whole edge and then near its
//! tip alone, the logarithm of the sensor's bandwidth, the share of a ray before the border of the stock that counts as chip, then
//! of every cut its width (m),
//! its depth (m), its relative spindle speed and the angle of tooth 1 at its first sample (rad).

use crate::cutting::wave::Side;
use crate::experiments::milling_force::{
    BANDWIDTH, BORDER, CutScene, PHASE, RUNOUT, SPEED, UNKNOWNS, WIDTH,
};
use crate::experiments::resonance::Resonant;
use crate::ground::spatial::{V3, add, scale};

/// Shape of a cause of the process: this, then the direction of every amount in the vector.
pub(super) const PROCESS: f64 = 1.0;
/// Shape of a cause of the sensor: this, then what its effect wants to know again.
pub(super) const SENSOR: f64 = 0.0;

/// Steps of forward differences: length of a tooth, width, depth, m.
const STEPS: [f64; 3] = [1e-6, 2e-5, 1e-5];

/// Places that every cut has of its own.
const OF_CUT: usize = 4;

/// Places in the vector.
#[derive(Debug, Clone, Copy)]
pub struct Places {
    /// Teeth of the tool.
    pub teeth: usize,
    /// Cuts of the file.
    pub cuts: usize,
}

impl Places {
    /// Length of the vector.
    pub fn len(&self) -> usize {
        self.common() + OF_CUT * self.cuts
    }

    /// Places that act on all cuts.
    fn common(&self) -> usize {
        10 + 2 * self.teeth
    }

    /// How much a tooth is shorter along its whole edge.
    pub fn shorter(&self, tooth: usize) -> usize {
        8 + tooth
    }

    /// How much it is shorter near its tip alone.
    pub fn chipped(&self, tooth: usize) -> usize {
        8 + self.teeth + tooth
    }

    /// Logarithm of the sensor's bandwidth.
    pub fn bandwidth(&self) -> usize {
        8 + 2 * self.teeth
    }

    /// Share of a ray before the border of the stock that counts as chip.
    pub fn border(&self) -> usize {
        9 + 2 * self.teeth
    }

    /// Width of a cut.
    pub fn width(&self, cut: usize) -> usize {
        self.common() + OF_CUT * cut
    }

    /// Depth of a cut.
    pub fn depth(&self, cut: usize) -> usize {
        self.width(cut) + 1
    }

    /// Relative spindle speed of a cut.
    pub fn speed(&self, cut: usize) -> usize {
        self.width(cut) + 2
    }

    /// Angle of tooth 1 of a cut.
    pub fn phase(&self, cut: usize) -> usize {
        self.width(cut) + 3
    }

    /// A step of one unit at a place.
    pub fn unit(&self, place: usize) -> Vec<f64> {
        let mut unit = vec![0.0; self.len()];
        unit[place] = 1.0;
        unit
    }

    /// The vector that is this at one place of every cut.
    pub fn of_every_cut(
        &self,
        place: fn(&Self, usize) -> usize,
        of: impl Fn(usize) -> f64,
    ) -> Vec<f64> {
        let mut to = vec![0.0; self.len()];
        (0..self.cuts).for_each(|c| to[place(self, c)] = of(c));
        to
    }

    /// Places that act on a cut.
    pub fn of_cut(&self, cut: usize) -> impl Iterator<Item = usize> {
        (0..self.common()).chain(self.width(cut)..self.width(cut) + OF_CUT)
    }
}

/// How one cut differs from what is stated.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a> {
    /// Places of the vector.
    pub places: Places,
    /// Number of the cut.
    pub cut: usize,
    /// The vector.
    pub offset: &'a [f64],
    /// How the sensor rings.
    pub resonant: Option<Resonant>,
}

/// One cut at a setting: its forces and their slopes over the vector.
pub struct Slopes {
    /// Forces at the samples, N.
    pub force: Vec<V3>,
    /// Per place that acts on this cut, in the order of [`Places::of_cut`].
    pub slopes: Vec<Vec<V3>>,
}

/// A cut as it is simulated before anything is blamed.
#[derive(Debug, Clone)]
pub struct Present {
    /// The scene; its speed is what the record shows.
    pub scene: CutScene,
    /// Its unknowns.
    pub p: [f64; UNKNOWNS],
    /// Relative error of the stated speed that is in the scene.
    pub speed: f64,
}

impl Present {
    /// The scene at a setting.
    pub fn moved(&self, setting: Setting) -> (CutScene, [f64; UNKNOWNS]) {
        let Setting {
            places,
            cut,
            offset,
            resonant,
        } = setting;
        let (mut scene, mut p) = (self.scene.clone(), self.p);
        scene.resonant = resonant;
        (0..RUNOUT + 2).for_each(|i| p[i] += offset[i]);
        p[BANDWIDTH] += offset[places.bandwidth()];
        p[BORDER] += offset[places.border()];
        p[PHASE] += offset[places.phase(cut)];
        p[SPEED] += (offset[places.speed(cut)] - self.speed) / (1.0 + self.speed);
        scene.shorter = (0..places.teeth)
            .map(|j| offset[places.shorter(j)])
            .collect();
        scene.chipped = (0..places.teeth)
            .map(|j| offset[places.chipped(j)])
            .collect();
        let most = 2.0 * scene.tool.radius_m;
        let stated = reach(&scene, p[WIDTH]);
        p[WIDTH] = (p[WIDTH] + offset[places.width(cut)]).clamp(1e-6, most);
        if scene.jumps() {
            p[PHASE] += reach(&scene, p[WIDTH]) - stated;
        }
        scene.cut.depth_m = (scene.cut.depth_m + offset[places.depth(cut)]).max(1e-6);
        (scene, p)
    }

    /// Forces there, with their slopes.
    pub fn slopes(&self, setting: Setting) -> Slopes {
        let Setting { places, cut, .. } = setting;
        let (scene, p) = self.moved(setting);
        let at = scene.predict(&p);
        let stepped = |place: usize, step: f64| {
            let mut offset = setting.offset.to_vec();
            offset[place] += step;
            let (scene, p) = self.moved(Setting {
                offset: &offset,
                ..setting
            });
            difference(&scene.force(&p), &at.force, step)
        };
        let mut slopes: Vec<Vec<V3>> = at.slopes[..8].to_vec();
        let nothing = || vec![[0.0; 3]; at.force.len()];
        let of_teeth = |place: usize| match places.teeth {
            1 => nothing(),
            _ => stepped(place, STEPS[0]),
        };
        slopes.extend((0..places.teeth).map(|j| of_teeth(places.shorter(j))));
        slopes.extend((0..places.teeth).map(|j| of_teeth(places.chipped(j))));
        slopes.extend([BANDWIDTH, BORDER].map(|own| at.slopes[own].clone()));
        slopes.push(match scene.cut.side {
            Side::Slot => nothing(),
            // no sample is asked on which side of a jump it stands
            _ if scene.jumps() => wider(&scene, &p, &at.slopes),
            _ => stepped(places.width(cut), -STEPS[1]),
        });
        slopes.push(stepped(places.depth(cut), STEPS[2]));
        let stated = 1.0 + self.speed;
        slopes.push(
            at.slopes[SPEED]
                .iter()
                .map(|v| v.map(|x| x / stated))
                .collect(),
        );
        slopes.push(at.slopes[PHASE].clone());
        Slopes {
            force: at.force,
            slopes,
        }
    }
}

/// Slope of the force over the width where it jumps.
fn wider(scene: &CutScene, p: &[f64; UNKNOWNS], slopes: &[Vec<V3>]) -> Vec<V3> {
    let turn = (reach(scene, p[WIDTH] + STEPS[1]) - reach(scene, p[WIDTH])) / STEPS[1];
    let each = slopes[WIDTH].iter().zip(&slopes[PHASE]);
    each.map(|(w, phase)| add(*w, scale(turn, *phase)))
        .collect()
}

/// Angle of a tooth where its chip is thick and the force jumps, rad, but for a constant: the record shows the jump, so a width
/// that is wrong turns the tooth.
fn reach(scene: &CutScene, width_m: f64) -> f64 {
    let reach = (1.0 - width_m / scene.tool.radius_m)
        .clamp(-1.0, 1.0)
        .acos();
    match scene.cut.side {
        Side::Slot => 0.0,
        Side::Up => reach,
        Side::Down => -reach,
    }
}

fn difference(there: &[V3], here: &[V3], step: f64) -> Vec<V3> {
    let one = |(a, b): (&V3, &V3)| std::array::from_fn(|k| (a[k] - b[k]) / step);
    there.iter().zip(here).map(one).collect()
}
