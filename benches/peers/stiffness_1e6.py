#!/usr/bin/env python3
"""From a file of 1 000 000 rows to a stiffness: `ident stiffness` and numpy with scipy, side by side.

Both read the same file and fit in the same run of this script, one after the other; the best of
three is printed. Needs numpy and scipy, and `cargo build --release` before.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import least_squares

ROWS = 1_000_000
LOAD_LEVER, SENSOR_LEVER = 0.5, 0.4
STIFFNESS, GAP, CONTACT = 314030.0, 6.0e-5, 3.0
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

FRONT = f"""# kind = "load-cycle"
# synthetic = true   # made by a benchmark; nobody measured this
# joint = 6
# axis = "rotation"
# load_lever_m = {LOAD_LEVER}
# sensor_lever_m = {SENSOR_LEVER}
"""


def write_file(path):
    """Six triangle cycles of 1500 N on a joint with a gap, at 10 kHz."""
    random = np.random.default_rng(1)
    t = np.arange(ROWS) * 1e-4
    x = (t * 6 / t[-1] + 0.25) % 1.0
    force = 1500.0 * (1.0 - 4.0 * np.abs(x - 0.5))
    moment = force * LOAD_LEVER
    angle = model([STIFFNESS, GAP, 0.0], moment)
    mm = 1e3 * SENSOR_LEVER * angle + 2e-3 * random.standard_normal(ROWS)
    with open(path, "w") as out:
        out.write(FRONT + "time_s,force_N,displacement_mm\n")
        np.savetxt(out, np.column_stack([t, force, mm]), fmt=["%.4f", "%.3f", "%.6f"], delimiter=",")


def model(p, moment):
    """Angle of a spring behind a smooth gap, with an offset: stiffness, gap, offset."""
    stiffness, gap, offset = p
    return moment / stiffness + 0.5 * gap * np.tanh(moment / CONTACT) + offset


def peer(path):
    """numpy.loadtxt and scipy.optimize.least_squares: three parameters, scaled."""
    table = np.loadtxt(path, delimiter=",", skiprows=FRONT.count("\n") + 1)
    moment, angle = table[:, 1] * LOAD_LEVER, table[:, 2] * 1e-3 / SENSOR_LEVER
    scale = np.array([3e5, 1e-5, 1e-5])
    residual = lambda p: (model(p * scale, moment) - angle) * 1e5
    found = least_squares(residual, [1.0, 1.0, 0.0])
    return found.x[0] * scale[0]


def ident(program, path):
    """The whole verb, as a user runs it, without writing."""
    arguments = [program, "stiffness", "--dry-run", "--json", path]
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode == 2:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["results"][0]["parameters"][0]["value"]


def peak_memory(program, path):
    """Peak resident memory in MB, measured by a small process of its own: a child of this one
    would count the arrays that numpy holds here."""
    measure = (
        "import resource, subprocess, sys\n"
        "subprocess.run(sys.argv[1:], capture_output=True)\n"
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    )
    arguments = [sys.executable, "-c", measure, program, "stiffness", "--dry-run", "--json", path]
    done = subprocess.run(arguments, capture_output=True, text=True, check=True)
    return int(done.stdout) * 1024 / 1e6


def best_of(times, work):
    best = None
    for _ in range(times):
        start = time.perf_counter()
        value = work()
        taken = time.perf_counter() - start
        best = taken if best is None else min(best, taken)
    return best, value


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--ident", default=os.path.join(ROOT, "target", "release", "ident"))
    options.add_argument("--times", type=int, default=3)
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "million.csv")
        write_file(path)
        megabytes = os.path.getsize(path) / 1e6
        ours, our_value = best_of(chosen.times, lambda: ident(chosen.ident, path))
        peak = peak_memory(chosen.ident, path)
        theirs, their_value = best_of(chosen.times, lambda: peer(path))
    numbers = 3 * 8 * ROWS / 1e6
    print(f"{ROWS} rows, {megabytes:.0f} MB of text, {numbers:.0f} MB of numbers; true stiffness {STIFFNESS:.0f} N·m/rad")
    print(f"ident           {ours:6.2f} s   stiffness {our_value:.0f}")
    print(f"numpy and scipy {theirs:6.2f} s   stiffness {their_value:.0f}")
    print(f"ratio           {ours / theirs:6.2f}     (goal: at most 0.50)")
    print(f"peak memory     {peak:6.1f} MB, {peak / numbers:.2f} times the numbers (goal: below 5)")


if __name__ == "__main__":
    main()
