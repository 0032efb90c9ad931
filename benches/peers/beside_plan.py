#!/usr/bin/env python3
"""ident beside Ruckig (time law) and py-opw-kinematics (inverse kinematics), and 100 000 points planned.

    python3 -m venv venv && venv/bin/pip install numpy ruckig py-opw-kinematics
    cargo build --release && cargo bench --bench beside_plan --no-run
    venv/bin/python benches/peers/beside_plan.py

Values first: durations from rest to rest within 1e-9, every posture of a pose within 1e-6 rad (2 pi apart is
the same); then speed, in turns on one core, the fastest round counts. Ruckig is called through its wheel, one
call per case, as a planner in Python would; py-opw-kinematics gets all poses in one batch, as its page
advises. Last, `ident plan` with a KRL program on a made part of 100 000 points, the whole verb. Exit status 1
if a value differs.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import ruckig
from py_opw_kinematics import KinematicModel, Robot

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIMITS = np.radians([[-185, 185], [-146, 0], [-119, 155], [-180, 180], [-125, 125], [-180, 180]])
REFERENCES = {(0.4, 0.1, 1.0, 20.0): 4.15, (0.05, 0.1, 2.0, 10.0): 0.7, (0.003, 0.05, 0.5, 5.0): 0.26777318003}


def built():
    """The bench as `cargo bench --bench beside_plan --no-run` left it: the newest."""
    found = [p for p in (ROOT / "target" / "release" / "deps").glob("beside_plan-*") if p.suffix == ""]
    if not found:
        sys.exit("let `cargo bench --bench beside_plan --no-run` build ident's side first")
    return str(max(found, key=lambda path: path.stat().st_mtime))


def ident(work, cases, passes):
    """What ident answers, and microseconds per case."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.writelines(" ".join(repr(float(x)) for x in case) + "\n" for case in cases)
        file.flush()
        done = subprocess.run([built(), work, file.name, str(passes)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def fastest(passes, count, call):
    best = math.inf
    for _ in range(passes):
        start = time.perf_counter()
        call()
        best = min(best, time.perf_counter() - start)
    return best * 1e6 / count


def ruckig_durations(cases):
    solver, trajectory = ruckig.Ruckig(1), ruckig.Trajectory(1)
    durations = []
    for length, speed, acceleration, jerk in cases:
        asked = ruckig.InputParameter(1)
        asked.target_position = [length]
        asked.max_velocity, asked.max_acceleration, asked.max_jerk = [speed], [acceleration], [jerk]
        solver.calculate(asked, trajectory)
        durations.append(trajectory.duration)
    return durations


def time_law(random, passes):
    cases = list(REFERENCES) + [
        tuple(10.0 ** random.uniform(low, high) for low, high in [(-5, 0.5), (-3, 0.5), (-1, 1), (0, 3)])
        for _ in range(2000)
    ]
    ours, theirs = ident("time-law", cases, passes), ruckig_durations(cases)
    apart = max(abs(a / b - 1.0) for a, b in zip(ours["answers"], theirs))
    closed = max(abs(a - b) for a, b in zip(ours["answers"], REFERENCES.values()))
    us = fastest(passes, len(cases), lambda: ruckig_durations(cases))
    print(f"time law: {len(cases)} motions from rest to rest, largest difference {apart:.1e}, from the closed forms {closed:.1e}")
    print(f"  ident {ours['us']:.3f} us, Ruckig (through Python) {us:.3f} us, ratio {ours['us'] / us:.3f}")
    return apart < 1e-9 and closed < 1e-9


def opw():
    """KR 210-2 (visose/Robots): KUKA's signs, A2 = -90 degrees upright."""
    model = KinematicModel(a1=0.35, a2=0.055, b=0.0, c1=0.75, c2=1.25, c3=1.1, c4=0.23,
                           offsets=(0.0, -math.pi / 2, 0.0, 0.0, 0.0, 0.0),
                           flip_axes=(True, False, False, True, False, True))
    return Robot(model, degrees=False)


def missing(ours, theirs):
    """Largest angle (rad) between a posture of one side and the nearest of the other."""
    a, b = np.asarray(ours), theirs[~np.isnan(theirs[:, 0])]
    if len(a) != len(b):
        return math.inf
    gaps = np.abs((a[:, None] - b[None] + math.pi) % (2 * math.pi) - math.pi).max(axis=2)
    return max(gaps.min(axis=0).max(), gaps.min(axis=1).max())


def inverse(random, passes):
    joints = random.uniform(LIMITS[:, 0], LIMITS[:, 1], (2000, 6))
    joints = joints[np.abs(np.sin(joints[:, 4])) > 0.01]
    robot = opw()
    poses = robot.batch_forward(joints)
    ours, theirs = ident("inverse", joints, passes), robot.reach(poses).joints
    apart = np.array([missing(a, b) for a, b in zip(ours["answers"], theirs)])
    ranked = fastest(passes, len(joints), lambda: robot.batch_inverse(poses))
    every = fastest(passes, len(joints), lambda: robot.reach(poses))
    print(f"inverse kinematics: {len(joints)} poses, every posture, largest difference {apart.max():.1e} rad")
    print(f"  ident {ours['us']:.3f} us a pose, py-opw-kinematics {ranked:.3f} (batch_inverse), {every:.3f} (reach), "
          f"ratio {ours['us'] / ranked:.3f}")
    return apart.max() < 1e-6


JOB = """kind = "job"
robot = "kr210"
path = "part.cls"
blend_radius_mm = 0.2
spin = "fixed"
start_joints_deg = [0, -90, 90, 0, 0, 0]
[workpiece]
origin_m = [1.5, -0.1, 0.8]
[limits]
path_acceleration_m_s2 = 1.0
path_jerk_m_s3 = 20.0
"""


def surface(count):
    """Points 0.5 mm apart, to and fro over a wavy surface."""
    points = []
    for k in range(count):
        row, i = divmod(k, 400)
        x, y = 0.5 * (i if row % 2 == 0 else 399 - i), 0.5 * row
        points.append((x, y, 2.0 * math.sin(x / 20) * math.cos(y / 15)))
    return points


def planned(passes, count=100_000):
    program = str(ROOT / "target" / "release" / "ident")
    with tempfile.TemporaryDirectory() as folder:
        lines = ["GOTO/%.4f,%.4f,%.4f\n" % point for point in surface(count)]
        text = "UNITS/MM\nFEDRAT/6000.0,MMPM\nFROM/0,0,0,0,0,1\n" + "".join(lines[1:]) + "FINI\n"
        pathlib.Path(folder, "part.cls").write_text(text)
        pathlib.Path(folder, "job.toml").write_text(JOB)
        command = [program, "plan", "job.toml", "--json", "--program", "krl"]
        run = lambda: subprocess.run(command, cwd=folder, capture_output=True, text=True)
        body = json.loads(run().stdout)
        seconds = fastest(passes, 1, run) * 1e-6
    path = body["path"]
    print(f"plan: {path['points']} points, {path['blends']} blends, {path['samples']} rows, trajectory, KRL and page "
          f"written in {seconds:.2f} s")


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--passes", type=int, default=50)
    passes = asked.parse_args().passes
    random = np.random.default_rng(1)
    good = time_law(random, passes)
    good = inverse(random, passes) and good
    planned(3)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
