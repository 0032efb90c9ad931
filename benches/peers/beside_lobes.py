#!/usr/bin/env python3
"""Stability lobes beside a semi-discretisation in numpy: 200 speeds by 100 depths.

    python3 -m venv venv && venv/bin/pip install numpy
    cargo bench --bench beside_lobes --no-run
    venv/bin/python benches/peers/beside_lobes.py

The benchmark of Insperger and Stepan (two teeth, one mode of 922 Hz, full slot), and the same with a mode
across. Values first: ident and the first-order semi-discretisation (Insperger and Stepan 2004; the mean of the
delayed displacements, matrices averaged over each interval, all depths of a speed in one batch of
`numpy.linalg.eigvals`) against one whose interval is ever smaller: the peer's distance must fall, ident's
must not exceed it. Then speed on two cores, ident with its threads and numpy with one process per core. The
machine may be busy: processor time is given too. Exit status 1 if a value differs.
"""
import argparse
import json
import multiprocessing
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KT, KR, TEETH, DIAMETER = 6e8, 2e8, 2, 0.01
MODES = {
    "one mode": [(1.0, 0.0, 922.0, 0.011, 1340049.648)],
    "two modes": [(1.0, 0.0, 922.0, 0.011, 1340049.648), (0.0, 1.0, 1050.0, 0.02, 1.9e6)],
}
# spectral radii of a collocation by other hands (project's knowledge 3.6): rpm, depth mm, radius
KNOWN = [(5000.0, 0.2, 0.819743), (5000.0, 0.5, 1.073976), (5000.0, 0.7, 1.221556), (5000.0, 1.0, 1.406474)]


def built():
    """The bench as `cargo bench --bench beside_lobes --no-run` left it: the newest."""
    found = [p for p in (ROOT / "target" / "release" / "deps").glob("beside_lobes-*") if p.suffix == ""]
    if not found:
        sys.exit("let `cargo bench --bench beside_lobes --no-run` build ident's side first")
    return str(max(found, key=lambda path: path.stat().st_mtime))


def ident(modes, speeds, depths, passes, threads):
    """Spectral radii, clock and processor seconds of the fastest pass."""
    head = f"{DIAMETER} {TEETH} {DIAMETER} slot {KT} {KR}"
    rows = [speeds, depths, *modes]
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("\n".join([head, *(" ".join(repr(float(x)) for x in row) for row in rows)]) + "\n")
        file.flush()
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([built(), file.name, str(passes)], capture_output=True, text=True, check=True,
                              env={**os.environ, "RAYON_NUM_THREADS": str(threads)})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    answer = json.loads(done.stdout)
    cpu = (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / passes
    return np.array(answer["radii"]), answer["s"], cpu


def exponential(a, terms=18):
    """exp of a batch of small matrices: scaled, by its series, squared back."""
    halvings = max(0, int(np.ceil(np.log2(max(np.abs(a).sum(axis=-1).max(), 1e-9)))) + 2)
    a = a / 2.0**halvings
    total = term = np.broadcast_to(np.eye(a.shape[-1]), a.shape).copy()
    for n in range(1, terms):
        term = term @ a / n
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def directional(k, passing_s):
    """Mean directional matrix of a full slot of two teeth in each of k intervals, N/m2 (finely sampled)."""
    phi = (np.arange(k * 20) + 0.5) / (k * 20) * 2.0 * np.pi / TEETH
    s, c = np.sin(phi), np.cos(phi)
    # force on the tool per depth and displacement along the chip normal (s, c)
    fx, fy = -KT * c - KR * s, KT * s - KR * c
    matrix = np.array([[fx * s, fx * c], [fy * s, fy * c]])
    return matrix.reshape(2, 2, k, 20).mean(axis=3).transpose(2, 0, 1)


def semi_discretisation(modes, rpm, depths, k):
    """Spectral radius at every depth: zeroth-order hold of the mean of two delayed displacements."""
    m = len(modes)
    along = np.array([mode[:2] for mode in modes])
    omega = np.array([2.0 * np.pi * mode[2] for mode in modes])
    zeta, stiffness = (np.array([mode[i] for mode in modes]) for i in (3, 4))
    passing_s = 60.0 / rpm / TEETH
    h = passing_s / k
    cut = along @ directional(k, passing_s) @ along.T
    gain = (omega**2 / stiffness)[:, None] * cut
    n, size = len(depths), 2 * m + m * k
    phi = np.broadcast_to(np.eye(size), (n, size, size)).copy()
    for i in range(k):
        w = np.asarray(depths)[:, None, None] * gain[i]
        # states with a constant input as extra states: one exponential gives both
        system = np.zeros((n, 3 * m, 3 * m))
        system[:, :m, m:2 * m] = np.eye(m)
        system[:, m:2 * m, :m] = -np.diag(omega**2) + w
        system[:, m:2 * m, m:2 * m] = -np.diag(2.0 * zeta * omega)
        system[:, m:2 * m, 2 * m:] = -w
        step = exponential(system * h)[:, :2 * m]
        own, delayed = step[:, :, :2 * m], step[:, :, 2 * m:]
        last, earlier = phi[:, size - m:], phi[:, size - 2 * m:size - m] if k > 1 else phi[:, :m]
        new = own @ phi[:, :2 * m] + 0.5 * delayed @ (last + earlier)
        phi = np.concatenate([new, phi[:, :m], phi[:, 2 * m:size - m]], axis=1)
    return np.abs(np.linalg.eigvals(phi)).max(axis=1)


def one(task):
    return semi_discretisation(*task)


def values(modes):
    """Whether ident is where ever finer intervals lead."""
    speeds, depths = [5000.0, 9000.0, 14000.0], [0.2e-3, 0.5e-3, 1.0e-3, 2.0e-3]
    ours = ident(modes, speeds, depths, 1, 2)[0]
    apart = []
    for k in (40, 80, 160):
        theirs = np.array([semi_discretisation(modes, rpm, depths, k) for rpm in speeds])
        apart.append(np.abs(theirs - ours).max())
    print("  largest distance of spectral radii, k = 40, 80, 160:", ", ".join(f"{a:.2e}" for a in apart))
    return apart[1] < 0.4 * apart[0] and apart[2] < 0.4 * apart[1]


def main():
    typed = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    typed.add_argument("--k", type=int, default=40, help="intervals of the peer that is timed [40]")
    typed.add_argument("--passes", type=int, default=3, help="rounds of ident [3]")
    typed.add_argument("--speeds", type=int, default=200)
    typed.add_argument("--depths", type=int, default=100)
    asked = typed.parse_args()
    good = True
    known = ident(MODES["one mode"], [5000.0], [1e-3 * d for _, d, _ in KNOWN], 1, 1)[0][0]
    off = max(abs(a - r) for a, (_, _, r) in zip(known, KNOWN))
    print(f"spectral radii of the benchmark: off by at most {off:.1e}")
    good &= off < 1e-4
    speeds, depths = np.linspace(5000.0, 20000.0, asked.speeds), np.linspace(0.05e-3, 5e-3, asked.depths)
    for name, modes in MODES.items():
        print(name)
        good &= bool(values(modes))
        ours, clock, cpu = ident(modes, speeds, depths, asked.passes, 2)
        start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        with multiprocessing.Pool(2) as pool:
            theirs = np.array(pool.map(one, [(modes, rpm, depths, asked.k) for rpm in speeds], chunksize=5))
        theirs_clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        theirs_cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        agree = ((ours < 1.0) == (theirs < 1.0)).mean()
        print(f"  {asked.speeds} x {asked.depths}, two cores: ident {clock:.2f} s (processor {cpu:.2f} s), "
              f"numpy k={asked.k} {theirs_clock:.2f} s (processor {theirs_cpu:.2f} s), ratio {cpu / theirs_cpu:.3f}; "
              f"the same side of stable at {100.0 * agree:.1f} %")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
