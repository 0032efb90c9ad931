#!/usr/bin/env python3
"""The diagnosis of one load cycle: `ident diagnose` and the same search in numpy and scipy.

Both get the same file of three cycles and 2000 rows, made by `ident lab`, on one core, in turns; the
fastest of several repetitions counts, by the clock and by the processor's time, which on a busy machine
is the fairer one. `ident` is timed as a process, the prototype without its imports, and the prototype
stops at the posterior: the gains on held-out cycles, the adequacy and the scales are left to `ident`.
Needs numpy and scipy, and `cargo build --release` before.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy as np
from scipy.fft import dct
from scipy.optimize import least_squares
from scipy.signal import lfilter

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PRIOR, FORMULA_ERROR, TOLERATED = 0.08, 0.07, 5.0
PAIRS, REFINED, AS_GOOD = 25, 12, 1.5
TRUTH = """robot = "kr210"
source = "synthetic: benches/peers/diagnose_2000.py"
seed = 2000
[[load_cycle]]
file = "axis6.csv"
joint = 6
axis = "rotation"
stiffness_Nm_rad = 314030.0
load_lever_m = 0.5
sensor_lever_m = 0.4
force_N = 1000.0
schedule = "growing"
cycles = 3
cycle_s = 33.0
rest_s = 0.95
step_s = 0.05
sensor_noise_mm = 0.00239
noise_correlation = 0.5
effects.backlash = { gap = 2.15e-4, contact_load = 7.5 }
effects.hysteresis = { width = 9.55e-5, slip_load = 350, spread = 1.0, tilt = 0.0 }
"""


# The dictionary: unit responses of every cause to the scaled load u at the times t (in cycles).

def stop(u, r):
    """Stop operators with thresholds r, one column each."""
    r, s, last = np.atleast_1d(r), 0.0, 0.0
    out = np.empty((len(u), len(r)))
    for i, x in enumerate(u):
        out[i] = s = np.minimum(np.maximum(s + x - last, -r), r)
        last = x
    return out


def hysteresis(u, t, slip, tilt):
    shares = ((np.arange(12) + 0.5) / 12) ** 1.3
    weights = np.exp(tilt * (shares - 0.5)) * shares**0.23
    return -stop(u, slip * shares) @ weights / (weights @ shares * slip)


def creep(u, t, constant):
    keep = np.exp(-(t[1] - t[0]) / constant)
    return lfilter([1 - keep], [1, -keep], u)


def loosening(u, t, p):
    work = np.cumsum(np.abs(u * np.gradient(u)))
    return u * (work / work[-1]) ** p


def drift(u, t, warm):
    s = (t - t[0]) / (t[-1] - t[0])
    return (1 - np.exp(-s / warm)) / (1 - np.exp(-1 / warm))


def slip(u, t, instant, width):
    s = (t - t[0]) / (t[-1] - t[0])
    return np.clip((s - instant) / width, 0, 1)


def knee(x, p):
    return x / (1 + np.abs(x) ** p) ** (1 / p)


# cause: (law, grid of its shapes, their bounds, whether the amplitude must be positive)
LAWS = {
    "backlash": (lambda u, t, c: knee(u / c, 2), [(0.004,), (0.02,), (0.05,)], [(5e-4, 0.1)], True),
    "soft_zone": (
        lambda u, t, z, p: knee(u / z, p),
        [(z, p) for z in (0.12, 0.18, 0.26, 0.36, 0.48, 0.62) for p in (4, 14)],
        [(0.1, 0.75), (2, 30)],
        True,
    ),
    "cubic_stiffness": (
        lambda u, t, p: -np.sign(u) * np.abs(u) ** p,
        [(0.35,), (2.3,), (3.2,), (4.2,)],
        [(0.25, 5)],
        False,
    ),
    "asymmetry": (lambda u, t, p: np.abs(u) ** p, [(1,), (1.6,)], [(0.8, 2.2)], False),
    "hysteresis": (
        hysteresis,
        [(r, w) for r in (0.22, 0.45, 0.7, 1.0) for w in (-3, -0.5, 2)],
        [(0.08, 1), (-5, 4)],
        True,
    ),
    "coulomb_friction": (
        lambda u, t, r: -stop(u, r)[:, 0] / r,
        [(r,) for r in (0.02, 0.05, 0.09, 0.14, 0.2, 0.27, 0.36, 0.48)],
        [(0.01, 0.6)],
        True,
    ),
    "creep": (
        creep,
        [(T,) for T in (0.02, 0.05, 0.11, 0.22, 0.45, 0.9, 2.0, 4.5)],
        [(0.01, 8)],
        True,
    ),
    "loosening": (loosening, [(0.6,), (1,), (1.7,)], [(0.4, 2.5)], False),
    "slip": (slip, [(i, 0.016) for i in np.linspace(0.02, 0.98, 64)], [(0.01, 0.99), (1e-4, 0.04)], False),
    "sensor_offset": (lambda u, t: np.ones_like(u), [()], [], False),
    "thermal_drift": (drift, [(0.2,), (0.5,), (10,)], [(0.12, 20)], False),
    "time_skew": (
        lambda u, t, d: np.interp(t - d, t, u) - u,
        [(0.003,), (0.02,)],
        [(1e-4, 0.08)],
        False,
    ),
}
ATOMS = [(cause, shape) for cause, law in LAWS.items() for shape in law[1]]


def cosine(columns):
    return dct(columns, axis=0, norm="ortho")


# The noise: a generous span projected out, and its colour by restricted likelihood.

def span(u, t, dictionary):
    """Branch-wise powers of the load, slow time and the whole dictionary, in cosine coefficients."""
    side = np.sign(np.gradient(np.convolve(u, np.ones(9) / 9, "same")))
    s = (t - t[0]) / (t[-1] - t[0])
    powers = np.cos(np.arange(8) * np.arccos(np.clip(u, -1, 1))[:, None])
    columns = np.column_stack([powers, powers * side[:, None], powers[:, :4] * s[:, None]])
    return np.column_stack([cosine(columns), np.eye(len(u), 6), dictionary])


def colours(n):
    """Relative spectra: white, pink above a floor, first-order autoregressive above a floor."""
    k = np.arange(n)
    yield np.ones(n)
    for exponent in (0.6, 1.0, 1.5, 2.0):
        for corner in (3, 10, 30, 100, 300, 1000):
            yield 1 + (corner / (k + 1)) ** exponent
    for r in (0.12, 0.22, 0.32, 0.42, 0.52, 0.6, 0.68, 0.76, 0.83, 0.89, 0.93, 0.96, 0.985):
        for floor in (0.0, 0.08, 0.4):
            yield floor / (1 - r * r) + 1 / (1 - 2 * r * np.cos(np.pi * k / n) + r * r)


def noise(y, columns):
    """Standard deviation of every cosine coefficient of the noise, and what the span leaves."""
    sigma, spectra = np.ones(len(y)), np.array(list(colours(len(y))))
    for _ in range(3):
        weighed = columns / sigma[:, None]
        left, sizes, _ = np.linalg.svd(weighed / np.linalg.norm(weighed, axis=0), full_matrices=False)
        basis = left[:, sizes > 3e-4 * sizes[0]]
        rest = y / sigma - basis @ (basis.T @ (y / sigma))
        free, power = np.maximum(1 - (basis**2).sum(1), 0), (rest * sigma) ** 2
        size = (power / spectra).sum(1) / free.sum()
        likelihood = -0.5 * ((free * np.log(spectra)).sum(1) + free.sum() * np.log(size))
        good = np.flatnonzero(likelihood > likelihood.max() - AS_GOOD)
        low = spectra[good, : len(y) // 50].sum(1) / spectra[good].sum(1)
        best = good[np.argmax(low)]
        sigma = np.sqrt(size[best] * spectra[best])
    return sigma, len(y) - basis.shape[1]


# The search: every one and two by batched normal equations, the best pairs with every third.

def solve(gram, right, sets):
    """Amplitudes of every set of atoms, and the nats that it explains."""
    matrices = gram[sets[:, :, None], sets[:, None, :]]
    diagonal = np.arange(sets.shape[1])
    matrices[:, diagonal, diagonal] *= 1 + 1e-9
    amplitudes = np.linalg.solve(matrices, right[sets][:, :, None])[:, :, 0]
    return amplitudes, 0.5 * (amplitudes * right[sets]).sum(1)


def search(gram, right):
    """The best atoms of every combination of causes, by their nats."""
    cause = np.array([list(LAWS).index(atom[0]) for atom in ATOMS])
    signed = np.array([LAWS[atom[0]][3] for atom in ATOMS])
    best = {}

    def offer(sets):
        amplitudes, nats = solve(gram, right, sets)
        nats[((amplitudes <= 0) & signed[sets]).any(1)] = -np.inf
        for i in np.argsort(nats):
            if np.isfinite(nats[i]):
                best[tuple(sorted(cause[sets[i]]))] = (nats[i], sets[i])

    def top(size, most):
        chosen = [v for key, v in best.items() if len(key) == size]
        return sorted(chosen, key=lambda v: -v[0])[:most]

    every = np.arange(len(ATOMS))
    offer(every[:, None])
    i, j = np.triu_indices(len(ATOMS), 1)
    other = cause[i] != cause[j]
    offer(np.column_stack([i[other], j[other]]))
    triples = [
        [*pair, k] for _, pair in top(2, PAIRS) for k in every if cause[k] not in cause[pair]
    ]
    offer(np.array(triples))
    return [v for size in (1, 2, 3) for v in top(size, len(ATOMS))]


def refine(atoms, u, t, y, sigma, spring):
    """Shapes set free, amplitudes projected out: the nats that are reached."""
    parts = [ATOMS[i] for i in atoms]
    bounds = [b for cause, _ in parts for b in LAWS[cause][2]]
    counts = [len(shape) for _, shape in parts]

    def residual(shapes):
        columns, at = [spring], 0
        for (cause, _), count in zip(parts, counts):
            columns.append(cosine(LAWS[cause][0](u, t, *shapes[at : at + count])) / sigma)
            at += count
        matrix = np.column_stack(columns)
        amplitudes = np.linalg.lstsq(matrix, y, rcond=None)[0]
        return y - matrix @ amplitudes

    start = np.array([x for _, shape in parts for x in shape], float)
    if not len(start):
        return 0.5 * (residual(start) ** 2).sum(), 0
    low, high = np.array(bounds, float).T
    start = np.clip(start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
    found = least_squares(residual, start, bounds=(low, high), x_scale=high - low, ftol=1e-5, max_nfev=12)
    return found.cost, len(start)


def diagnose(path):
    """The prototype: probabilities of sets of causes, most probable first."""
    with open(path) as file:
        front = sum(1 for line in file if line.startswith("#"))
    table = np.genfromtxt(path, delimiter=",", skip_header=front + 1)
    t, u, y = table[:, 0], table[:, 1] / np.abs(table[:, 1]).max(), table[:, 2]
    t = t / ((t[-1] - t[0]) / 3)
    y = cosine(y / np.abs(y).max())
    dictionary = cosine(np.column_stack([LAWS[cause][0](u, t, *shape) for cause, shape in ATOMS]))
    sigma, freedom = noise(y, span(u, t, dictionary))
    y, spring, whitened = y / sigma, cosine(u) / sigma, dictionary / sigma[:, None]
    unit = spring / np.linalg.norm(spring)
    beyond, rest = whitened - np.outer(unit, unit @ whitened), y - unit * (unit @ y)
    base = 0.5 * rest @ rest
    temper = 1 / (1 + FORMULA_ERROR**2 * max(base - 0.5 * freedom, 0) / TOLERATED)
    price = lambda size, shapes: size * np.log(PRIOR / (1 - PRIOR)) - 0.5 * (size + shapes) * np.log(len(y))
    shapes_of = lambda atoms: sum(len(ATOMS[i][1]) for i in atoms)
    found = search(beyond.T @ beyond, beyond.T @ rest)
    found.sort(key=lambda v: -(temper * v[0] + price(len(v[1]), shapes_of(v[1]))))
    scores = {(): 0.0}
    for _, atoms in found[:REFINED]:
        cost, shapes = refine(atoms, u, t, y, sigma, spring)
        names = tuple(sorted(ATOMS[i][0] for i in atoms))
        scores[names] = temper * (base - cost) + price(len(atoms), shapes)
    top = max(scores.values())
    total = sum(np.exp(v - top) for v in scores.values())
    return sorted(((np.exp(v - top) / total, names) for names, v in scores.items()), reverse=True)


def ident(program, path):
    """The whole verb as a user runs it, without writing: the causes it names."""
    arguments = [program, "diagnose", "--dry-run", "--json", path]
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode == 2:
        sys.exit(done.stderr)
    return tuple(sorted(cause["effect"] for cause in json.loads(done.stdout)["causes"]))


def make_file(program, folder):
    truth = os.path.join(folder, "truth.toml")
    with open(truth, "w") as out:
        out.write(TRUTH)
    subprocess.run([program, "lab", truth], check=True, capture_output=True)
    return os.path.join(folder, "axis6.csv")


def processor():
    """Seconds that this process and its finished children have computed."""
    spent = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(r.ru_utime + r.ru_stime for r in spent)


def timed(work):
    """Seconds by the clock and of the processor, and what was found."""
    start, before = time.perf_counter(), processor()
    value = work()
    return time.perf_counter() - start, processor() - before, value


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--ident", default=os.path.join(ROOT, "target", "release", "ident"))
    options.add_argument("--times", type=int, default=7)
    chosen = options.parse_args()
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    with tempfile.TemporaryDirectory() as folder:
        path = make_file(chosen.ident, folder)
        with open(path) as file:
            rows = sum(1 for line in file if not line.startswith("#")) - 1
        turns = [
            (timed(lambda: ident(chosen.ident, path)), timed(lambda: diagnose(path)))
            for _ in range(chosen.times)
        ]
    fastest = lambda who, which: min(turn[who][which] for turn in turns)
    (clock, work), (their_clock, their_work) = [[fastest(who, k) for k in (0, 1)] for who in (0, 1)]
    named, (probability, likely) = turns[0][0][2], turns[0][1][2][0]
    print(f"{rows} rows, 3 cycles, one core, the fastest of {chosen.times} turns: clock, processor")
    print(f"ident diagnose  {clock:6.2f} s {work:6.2f} s   names {' + '.join(named) or 'nothing'}")
    print(
        f"numpy and scipy {their_clock:6.2f} s {their_work:6.2f} s   names "
        f"{' + '.join(likely) or 'nothing'} ({100 * min(probability, 0.99):.0f} % at least)"
    )
    same = "the same causes" if named == likely else "OTHER CAUSES"
    print(f"ratio           {clock / their_clock:6.2f}   {work / their_work:6.2f}     {same}")


if __name__ == "__main__":
    main()
