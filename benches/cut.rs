//! Speed of the cut: `cargo bench --bench cut`. One core; the time of this thread's processor counts where the
//! machine tells it, so that neighbours do not.
//!
//! A coupled step (18 hinges, 20 discs, two teeth), the removal of a tool of 20 dexels per radius, and a look
//! around it. Each works through a fresh slot; the fastest of some rounds counts.

use ident::cutting::cutter::{Cutter, Fineness};
use ident::cutting::dexel::{Solid, Stock};
use ident::cutting::{Material, Tool};
use ident::ground::spatial::{IDENTITY, V3};
use ident::motion::elastic;
use ident::process::pose::Carrier;
use ident::process::structure::{Structure, Tick};
use ident::process::swinging::Swinging;
use ident::process::way::{Row, Way};
use ident::robot::load::load;
use std::f64::consts::{FRAC_PI_6, TAU};
use std::hint::black_box;

const MM: f64 = 1e-3;
const SPINDLE: f64 = 10_000.0 / 60.0 * TAU;
const RADIUS: f64 = 8.0 * MM;
const SPACING: f64 = RADIUS / 20.0;
/// Feed per tooth.
const FEED: f64 = 0.15 * MM;
const UP: V3 = [0.0, 0.0, 1.0];
const ROUNDS: usize = 5;

fn main() {
    let worked = [
        (
            "coupled step, 18 hinges, 20 discs, 2 teeth",
            coupled(20),
            1e-5,
        ),
        (
            "removal of one place, 20 dexels per radius",
            removal(2.0 * MM),
            1e-5,
        ),
        (
            "removal and look around, one tooth further",
            advance(2.0 * MM),
            1e-5,
        ),
        ("whole tooth passing, 60 steps, 20 discs", passing(20), 3e-3),
    ];
    for (name, took, most) in worked {
        println!(
            "{name}: {:.2} µs ({:.0} per second), asked {:.0} µs",
            1e6 * took,
            1.0 / took,
            1e6 * most
        );
    }
}

/// Processor time of this thread, s (Linux counts it in nanoseconds); elsewhere the clock.
fn now() -> f64 {
    let own = std::fs::read_to_string("/proc/thread-self/schedstat");
    let ran = own.ok().and_then(|t| {
        t.split_whitespace()
            .next()
            .and_then(|w| w.parse::<f64>().ok())
    });
    let clock = || {
        std::time::UNIX_EPOCH
            .elapsed()
            .map_or(0.0, |t| t.as_secs_f64())
    };
    ran.map_or_else(clock, |ns| 1e-9 * ns)
}

/// Least time of a unit of work; `prepare` is not timed.
fn least<T>(units: usize, prepare: impl Fn() -> T, work: impl Fn(&mut T)) -> f64 {
    let once = |_| {
        let mut ready = prepare();
        let start = now();
        work(&mut ready);
        (now() - start) / units as f64
    };
    (0..ROUNDS).map(once).fold(f64::INFINITY, f64::min)
}

fn tool() -> Tool {
    Tool {
        flute_m: 32.0 * MM,
        ..Tool::square(RADIUS, 2, FRAC_PI_6)
    }
}

fn stock(depth: f64) -> Stock {
    let low = [-40.0 * MM, -15.0 * MM, -depth - 4.0 * SPACING];
    Stock::block(low, [200.0 * MM, 15.0 * MM, 0.0], SPACING).unwrap()
}

fn cutter(depth: f64) -> Cutter {
    let al7075 = Material::linear_edge([1319.41, 788.83, 48.75, 19.65, 26.77, 2.05]);
    Cutter::new(&tool(), &al7075, stock(depth), Fineness::usual(&tool()), UP)
}

/// A cutter whose slot has a round front already.
fn begun(depth: f64) -> (Cutter, usize) {
    let (mut cutter, ticks) = (cutter(depth), 200);
    for i in 0..ticks {
        cutter.advance(place(depth, i), UP).unwrap();
    }
    (cutter, ticks)
}

fn place(depth: f64, tick: usize) -> V3 {
    [FEED * tick as f64, 0.0, -depth]
}

fn removal(depth: f64) -> f64 {
    // several slots: the processor's time is counted in ticks of milliseconds
    let (count, slots) = (800, 40);
    let all = |stocks: &mut Vec<Stock>| {
        for stock in stocks {
            for i in 0..count {
                let tip = place(depth, i);
                stock.remove(&Solid::of(&tool(), 32.0 * MM, tip, UP));
            }
        }
    };
    least(count * slots, || vec![stock(depth); slots], all)
}

fn advance(depth: f64) -> f64 {
    let count = 800;
    let on = |ready: &mut (Cutter, usize)| {
        for i in 0..count {
            ready.0.advance(place(depth, ready.1 + i), UP).unwrap();
        }
    };
    least(count, || begun(depth), on)
}

fn way() -> Way {
    let row = |i: usize| Row {
        time_s: 0.012 * i as f64,
        s_m: 0.05 * 0.012 * i as f64,
        tip: [0.0; 3],
        axis: UP,
        joints: [0.0, -60.0, 80.0, 0.0, 70.0, 0.0]
            .map(f64::to_radians)
            .to_vec(),
    };
    Way::new((0..10).map(row).collect()).unwrap()
}

fn swinging(steps: usize) -> Swinging {
    let robot = load("kr210", None).unwrap().robot;
    let carrier = Carrier::new(elastic(&robot), IDENTITY);
    Swinging::new(carrier, &way().at(0.0), SPINDLE, steps).unwrap()
}

fn tick(depth: f64, i: usize) -> Tick {
    let at = way().at(0.0);
    let [from, to] = [i, i + 1].map(|k| ident::process::Moment {
        tip: place(depth, k),
        time_s: k as f64 * TAU / SPINDLE / 2.0,
        ..at.clone()
    });
    Tick { from, to }
}

fn ready(discs: usize) -> (Cutter, usize, Swinging) {
    let (cutter, at) = begun(discs as f64 * SPACING);
    let swinging = swinging(cutter.steps());
    (cutter, at, swinging)
}

fn coupled(discs: usize) -> f64 {
    let count = 200;
    let depth = discs as f64 * SPACING;
    let steps = count * cutter(depth).steps() / 2;
    let ticks: Vec<Tick> = (0..count).map(|i| tick(depth, 200 + i)).collect();
    let on = |(cutter, _, swinging): &mut (Cutter, usize, Swinging)| {
        for tick in &ticks {
            black_box(swinging.cut(cutter, tick).unwrap());
        }
    };
    least(steps, || ready(discs), on)
}

fn passing(discs: usize) -> f64 {
    let count = 200;
    let depth = discs as f64 * SPACING;
    let ticks: Vec<Tick> = (0..count).map(|i| tick(depth, 200 + i)).collect();
    let on = |(cutter, _, swinging): &mut (Cutter, usize, Swinging)| {
        for tick in &ticks {
            cutter.advance(tick.to.tip, UP).unwrap();
            black_box(swinging.cut(cutter, tick).unwrap());
        }
    };
    least(count, || ready(discs), on)
}
