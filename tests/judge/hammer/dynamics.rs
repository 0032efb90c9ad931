//! Small motions of an arm on hinges: mass matrix from the bodies (sums of Jacobians, after Lagrange), transfer
//! functions, and exact steps in time under a force that is linear between instants.

use super::super::algebra::{V3, dot, norm, turn, turned};
use super::super::rigid::{facing, postured};
use super::robot::{Body, Robot, swing};
use nalgebra::{Complex, DMatrix, DVector};

pub type C = Complex<f64>;

/// Acceleration [response][direction] per force.
pub type Pairs = [[C; 3]; 3];

/// A mass on a spring at the tool: direction, kg, N/m, N·s/m.
pub type Absorber = (V3, f64, f64, f64);

/// A robot at rest in a posture, with what was built onto it.
#[derive(Debug, Clone)]
pub struct World {
    pub robot: Robot,
    pub joints: [f64; 6],
    pub absorber: Option<Absorber>,
    /// A spring and a damper in series beside a hinge: hinge, N·m/rad, s.
    pub rubber: Option<(usize, f64, f64)>,
    /// A hinge that does not follow Hooke.
    pub bent: Option<(usize, Law)>,
    /// Scatter of the place that is hit, m.
    pub wander: f64,
    /// Impulse of a cable that strikes back, share of the hit's.
    pub knock: f64,
    /// Readings of the sensor per acceleration, base frame.
    pub sensor: [[f64; 3]; 3],
    /// Reading of the hammer per force.
    pub hammer: f64,
    /// Acceleration is read this late, s.
    pub delay: f64,
    /// Both channels are multiplied by exp(-decay t), 1/s.
    pub decay: f64,
    /// Second pulses: direction, hits, share, s after the first.
    pub second: Vec<(usize, usize, f64, f64)>,
}

/// Moment beside Hooke's.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    /// k3 θ³.
    Cubic(f64),
    /// Play of this half width, rad, before the stated spring carries.
    Gap(f64, f64),
}

impl Law {
    /// Moment on the hinge, N·m, beside that of its spring.
    fn moment(self, angle: f64) -> f64 {
        match self {
            Law::Cubic(k3) => -k3 * angle.powi(3),
            Law::Gap(half, k) => k * angle.clamp(-half, half),
        }
    }
}

/// Matrices of the small motion.
#[derive(Debug, Clone)]
pub struct Plant {
    pub m: DMatrix<f64>,
    pub c: DMatrix<f64>,
    pub k: DMatrix<f64>,
    /// Velocity of the tool centre point per rate, 3 by n.
    pub hand: DMatrix<f64>,
    pub rubber: Option<(usize, f64, f64)>,
}

/// Lines of the hinges in a posture.
pub fn lines(robot: &Robot, q: &[f64; 6]) -> Vec<(V3, V3)> {
    let line = |h: &super::robot::Hinge| {
        let axis = facing(&robot.frame, q, h.link, h.axis);
        (axis, postured(&robot.frame, q, h.link, h.point))
    };
    robot.hinges.iter().map(line).collect()
}

/// Velocity per rate of a place beyond `rank`, 3 by n.
pub fn reach(robot: &Robot, lines: &[(V3, V3)], rank: f64, x: V3) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(3, lines.len());
    for (i, (a, p)) in lines.iter().enumerate() {
        if robot.hinges[i].rank < rank {
            let v = swing(*a, *p, x);
            (0..3).for_each(|r| all[(r, i)] = v[r]);
        }
    }
    all
}

/// What one body adds to the mass matrix.
pub fn weight(robot: &Robot, q: &[f64; 6], lines: &[(V3, V3)], body: &Body) -> DMatrix<f64> {
    let at = postured(&robot.frame, q, body.link, body.com);
    let v = reach(robot, lines, body.rank, at);
    let mut w = DMatrix::zeros(3, lines.len());
    for (i, (a, _)) in lines.iter().enumerate() {
        if robot.hinges[i].rank < body.rank {
            let back = |v: V3, j: usize| turned(turn(robot.frame.axes[j], -q[j]), v);
            let own = (0..body.link).fold(*a, back);
            (0..3).for_each(|r| w[(r, i)] = own[r]);
        }
    }
    let [xx, yy, zz, xy, xz, yz] = body.inertia;
    let tensor = DMatrix::from_row_slice(3, 3, &[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
    v.transpose() * &v * body.mass + w.transpose() * tensor * w
}

impl World {
    /// A robot with sound instruments.
    pub fn new(robot: Robot, joints: [f64; 6]) -> Self {
        Self {
            robot,
            joints,
            absorber: None,
            rubber: None,
            bent: None,
            wander: 0.0,
            knock: 0.0,
            sensor: std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)))),
            hammer: 1.0,
            delay: 0.0,
            decay: 0.0,
            second: Vec::new(),
        }
    }

    /// Where the tool centre point is.
    pub fn tip(&self) -> V3 {
        postured(&self.robot.frame, &self.joints, 6, self.robot.frame.tcp)
    }

    /// Its matrices.
    pub fn plant(&self) -> Plant {
        let at = lines(&self.robot, &self.joints);
        let n = at.len();
        let hand = reach(&self.robot, &at, 7.0, self.tip());
        let mut m = DMatrix::zeros(n, n);
        for body in &self.robot.bodies {
            m += weight(&self.robot, &self.joints, &at, body);
        }
        let of = |f: &dyn Fn(&super::robot::Hinge) -> f64| {
            DMatrix::from_diagonal(&DVector::from_iterator(n, self.robot.hinges.iter().map(f)))
        };
        let own = Plant {
            m,
            c: of(&|h| h.d),
            k: of(&|h| h.k),
            hand,
            rubber: self.rubber,
        };
        match self.absorber {
            Some(absorber) => own.with(absorber),
            None => own,
        }
    }

    /// Readings of the sensor over readings of the hammer.
    pub fn transfer(&self, plant: &Plant, frequency: f64) -> Pairs {
        let s = C::new(self.decay, std::f64::consts::TAU * frequency);
        let true_one = plant.transfer(s);
        let late = (-s * self.delay).exp() / self.hammer;
        let read = |r: usize, d: usize| -> C {
            let sum = (0..3).map(|k| true_one[k][d] * self.sensor[r][k]);
            sum.sum::<C>() * late
        };
        std::array::from_fn(|r| std::array::from_fn(|d| read(r, d)))
    }
}

impl Plant {
    fn with(&self, (along, mass, k, c): Absorber) -> Self {
        let n = self.m.nrows();
        let along = along.map(|x| x / norm(along));
        let mut tied = DMatrix::zeros(1, n + 1);
        for i in 0..n {
            let own: V3 = std::array::from_fn(|r| self.hand[(r, i)]);
            tied[(0, i)] = dot(&along, &own);
        }
        let rigid = tied.transpose() * &tied;
        tied[(0, n)] = 1.0;
        let wider = |a: &DMatrix<f64>, last: f64| {
            let mut wide = a.clone().resize(n + 1, n + 1, 0.0);
            wide[(n, n)] = last;
            wide
        };
        let carried = self.hand.transpose() * &self.hand;
        let mut m = wider(&(&self.m + carried * mass), 0.0);
        m += (tied.transpose() * &tied - rigid) * mass;
        Self {
            m,
            c: wider(&self.c, c),
            k: wider(&self.k, k),
            hand: self.hand.clone().resize(3, n + 1, 0.0),
            rubber: self.rubber,
        }
    }

    /// s²M + sC + K, inverted.
    pub fn inverse(&self, s: C) -> DMatrix<C> {
        let n = self.m.nrows();
        let mut z = DMatrix::from_fn(n, n, |i, j| {
            s * s * self.m[(i, j)] + s * self.c[(i, j)] + self.k[(i, j)]
        });
        if let Some((i, k, slow)) = self.rubber {
            z[(i, i)] += s * slow * k / (s * slow + 1.0);
        }
        z.try_inverse().unwrap()
    }

    fn transfer(&self, s: C) -> Pairs {
        let hand = self.hand.map(|x| C::new(x, 0.0));
        let all = &hand * self.inverse(s) * hand.transpose() * (s * s);
        std::array::from_fn(|r| std::array::from_fn(|d| all[(r, d)]))
    }

    /// State matrix over angles, rates and the rubber's stretch, and the input matrix of moments on the hinges.
    fn states(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.m.nrows();
        let more = usize::from(self.rubber.is_some());
        let inverse = self.m.clone().try_inverse().unwrap();
        let mut a = DMatrix::zeros(2 * n + more, 2 * n + more);
        a.view_mut((0, n), (n, n)).fill_with_identity();
        a.view_mut((n, 0), (n, n)).copy_from(&(-&inverse * &self.k));
        a.view_mut((n, n), (n, n)).copy_from(&(-&inverse * &self.c));
        if let Some((i, k, slow)) = self.rubber {
            a.view_mut((n, 2 * n), (n, 1))
                .copy_from(&(inverse.column(i) * -k));
            a[(2 * n, n + i)] = 1.0;
            a[(2 * n, 2 * n)] = -1.0 / slow;
        }
        let mut b = DMatrix::zeros(2 * n + more, n);
        b.view_mut((n, 0), (n, n)).copy_from(&inverse);
        (a, b)
    }

    /// Slowest decay of its motions, 1/s.
    pub fn slowest(&self) -> f64 {
        let (a, _) = self.states();
        let all = a.complex_eigenvalues();
        all.iter().map(|z| -z.re).fold(f64::MAX, f64::min)
    }

    /// Accelerations of the tool under forces at a place with Jacobian `at`, given at even instants and linear between.
    pub fn run(
        &self,
        at: &DMatrix<f64>,
        force: &dyn Fn(usize) -> V3,
        step: f64,
        count: usize,
        bent: Option<(usize, Law)>,
    ) -> Vec<V3> {
        let n = self.m.nrows();
        let (a, b) = self.states();
        let mut moments = DMatrix::zeros(n, 4);
        moments.view_mut((0, 0), (n, 3)).copy_from(&at.transpose());
        if let Some((i, _)) = bent {
            moments[(i, 3)] = 1.0;
        }
        let input = &b * moments;
        let (phi, now, next) = discrete(&a, &input, step);
        let out = &self.hand * a.rows(n, n);
        let through = &self.hand * input.rows(n, n);
        let law = |x: &DVector<f64>| bent.map_or(0.0, |(i, law)| law.moment(x[i]));
        let load = |k: usize, m: f64| {
            let f = force(k);
            DVector::from_vec(vec![f[0], f[1], f[2], m])
        };
        let (mut x, mut all) = (DVector::zeros(a.nrows()), Vec::with_capacity(count));
        let (mut u, mut free) = (load(0, 0.0), DVector::zeros(a.nrows()));
        for k in 0..count {
            let y = &out * &x + &through * &u;
            all.push([y[0], y[1], y[2]]);
            free.gemv(1.0, &phi, &x, 0.0);
            free.gemv(1.0, &now, &u, 1.0);
            u = load(k + 1, u[3]);
            for _ in 0..if bent.is_some() { 3 } else { 1 } {
                x.copy_from(&free);
                x.gemv(1.0, &next, &u, 1.0);
                u[3] = law(&x);
            }
        }
        all
    }
}

/// Exact step: state, input now and input at the next instant.
fn discrete(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    step: f64,
) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let (n, m) = (a.nrows(), b.ncols());
    let mut whole = DMatrix::zeros(n + 2 * m, n + 2 * m);
    whole.view_mut((0, 0), (n, n)).copy_from(a);
    whole.view_mut((0, n), (n, m)).copy_from(b);
    whole.view_mut((n, n + m), (m, m)).fill_with_identity();
    let e = (whole * step).exp();
    // The lower block holds u' times the step.
    let ramp = e.view((0, n + m), (n, m)) / step;
    let held = e.view((0, n), (n, m)).into_owned();
    (e.view((0, 0), (n, n)).into_owned(), held - &ramp, ramp)
}
