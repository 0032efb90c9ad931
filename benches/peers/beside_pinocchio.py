#!/usr/bin/env python3
"""ident beside Pinocchio (wheel `pin` from PyPI): the same URDF, the same random states, both live.

    python3 -m venv venv && venv/bin/pip install pin     # brings Pinocchio's C++ headers and libraries
    apt-get install g++ libeigen3-dev                     # for the speed only
    cargo build --release
    venv/bin/python benches/peers/beside_pinocchio.py path/to/*.urdf [--speed] [--states 20]

Values: tool pose, Jacobian (tool point, base axes), M, G, RNEA and ABA of every URDF and of the chain of 18
hinges (KR 210 R2700-2, each joint followed by two virtual axes), within 1e-10 of the largest entry. A robot
with links without mass must be refused by name by `ident simulate pose`; all but ABA is compared all the same.

Speed: pinocchio.cpp (built here, -O3 -march=native, some minutes the first time) and beside.rs take turns on
the same 256 states; the fastest round over them counts. Exit status 1 if a value differs.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pinocchio as pin

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOLERANCE = 1e-10
CHAIN_OF_18 = "kr210_r2700_2.urdf"
FLAGS = [
    "-std=c++17", "-O3", "-DNDEBUG", "-march=native", "-w", "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
]


def with_virtual_axes(rigid):
    """Per joint: drive about z, virtual axes about x and y, the link on the last."""
    model, parent, here = pin.Model(), 0, pin.SE3.Identity()
    model.gravity = rigid.gravity
    for i in range(1, rigid.njoints):
        name = rigid.names[i]
        parent = model.addJoint(parent, pin.JointModelRZ(), rigid.jointPlacements[i], name)
        parent = model.addJoint(parent, pin.JointModelRX(), here, name + "-x")
        parent = model.addJoint(parent, pin.JointModelRY(), here, name + "-y")
        model.appendBodyToJoint(parent, rigid.inertias[i], here)
    placement = rigid.frames[rigid.getFrameId("tool0")].placement
    model.addFrame(pin.Frame("tool0", parent, 0, placement, pin.FrameType.OP_FRAME))
    return model


def tool_frame(model):
    """`tool0`, else the last body of the file."""
    if model.existFrame("tool0"):
        return model.getFrameId("tool0")
    return [i for i, f in enumerate(model.frames) if f.type == pin.FrameType.BODY][-1]


def massless(model):
    """Whether M is singular: nothing behind the last joint has mass."""
    return model.inertias[model.njoints - 1].mass == 0


def random_states(model, count, rng):
    """q, v, a and the torque that belongs to them, one array per state. Driven joints turn by up to 2 rad,
    virtual axes bend by up to 0.1 rad: three axes in one point lose rank at a right angle."""
    data, states = model.createData(), []
    reach = np.array([0.1 if name.endswith(("-x", "-y")) else 2.0 for name in list(model.names)[1:]])
    for _ in range(count):
        q, v, a = reach * rng.uniform(-1, 1, model.nq), rng.uniform(-1, 1, model.nv), rng.uniform(-1, 1, model.nv)
        states.append(np.array([q, v, a, pin.rnea(model, data, q, v, a)]))
    return states


def write_states(folder, states):
    path = pathlib.Path(folder, "states.txt")
    rows = (" ".join(repr(float(x)) for x in state.ravel()) for state in states)
    path.write_text(f"{len(states)} {states[0].shape[1]}\n" + "\n".join(rows) + "\n")
    return str(path)


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return json.loads(done.stdout)


def pinocchio_values(model, state):
    (q, v, a, torque), data, tool = state, model.createData(), tool_frame(model)
    pin.computeJointJacobians(model, data, q)
    pin.framesForwardKinematics(model, data, q)
    jacobian = pin.getFrameJacobian(model, data, tool, pin.LOCAL_WORLD_ALIGNED)
    mass = pin.crba(model, data, q).copy()
    soft = np.diag(1 / (1e6 * (1 + np.arange(model.nv))))  # as in beside.rs and pinocchio.cpp
    return {
        "point": data.oMf[tool].translation.copy(),
        "rotation": data.oMf[tool].rotation.copy(),
        "jacobian": jacobian,
        "M": np.triu(mass) + np.triu(mass, 1).T,
        "G": pin.computeGeneralizedGravity(model, data, q).copy(),
        "RNEA": pin.rnea(model, data, q, v, a).copy(),
        "ABA": None if massless(model) else pin.aba(model, data, q, v, torque).copy(),
        "compliance": jacobian[:3] @ soft @ jacobian[:3].T,
    }


def differences(model, states, answers):
    """Largest difference of every quantity against its largest entry, over all states."""
    largest = {}
    for state, answer in zip(states, answers, strict=True):
        for key, wanted in pinocchio_values(model, state).items():
            if wanted is not None:
                found = np.abs(np.array(answer[key], dtype=float) - wanted).max() / np.abs(wanted).max()
                largest[key] = max(found, largest.get(key, 0.0))
    return largest


def compare(beside, urdf, model, hinges, states):
    with tempfile.TemporaryDirectory() as folder:
        answers = run([beside, urdf, write_states(folder, states), hinges, "0"])
    largest = differences(model, states, answers)
    name = pathlib.Path(urdf).name + (", 18 hinges" if hinges == "18" else "")
    print(f"{name}: " + ", ".join(f"{key} {value:.1e}" for key, value in largest.items()))
    return all(value <= TOLERANCE for value in largest.values())


def refused_by_name(ident, urdf):
    """Whether `ident simulate pose` refuses the robot, and says why."""
    command = [ident, "simulate", "pose", "--robot", urdf, "--joints-deg=0,-90,90,0,0,0"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    print(f"{pathlib.Path(urdf).name}: exit status {done.returncode}: {done.stderr.strip().splitlines()[0]}")
    return done.returncode == 2 and "link_5" in done.stderr


def built_ident():
    """The benchmark binary: cargo says where it lies."""
    command = ["cargo", "bench", "--bench", "beside", "--no-run", "--message-format=json"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=True)
    lines = (json.loads(line) for line in done.stdout.splitlines() if line.startswith("{"))
    found = [x["executable"] for x in lines if x.get("executable") and x["target"]["name"] == "beside"]
    return found[-1]


def built_pinocchio():
    """The C++ benchmark, made again when its source is newer."""
    source, out = HERE / "pinocchio.cpp", ROOT / "target/peers/pinocchio"
    if out.exists() and out.stat().st_mtime > source.stat().st_mtime:
        return str(out)
    prefix = next(p for p in pathlib.Path(pin.__file__).parents if p.name == "cmeel.prefix")
    out.parent.mkdir(parents=True, exist_ok=True)
    paths = [f"-I{prefix}/include", "-I/usr/include/eigen3", f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib"]
    libraries = ["-lpinocchio_default", "-lboost_serialization"]
    subprocess.run(["g++", *FLAGS, *paths, str(source), "-o", str(out), *libraries], check=True)
    return str(out)


def best(turns):
    return {key: min(turn[key] for turn in turns) for key in turns[0]}


def race(beside, peer, urdf, model, hinges, rng, passes=200, rounds=7):
    """Both take turns on the same states; the fastest of `rounds` turns counts."""
    with tempfile.TemporaryDirectory() as folder:
        states, saved = write_states(folder, random_states(model, 256, rng)), f"{folder}/model.txt"
        model.saveToText(saved)
        own, other = [beside, urdf, states, hinges, str(passes)], [peer, saved, states, str(passes)]
        turns = [(run(own), run(other)) for _ in range(rounds)]
    own, other = (best(list(side)) for side in zip(*turns))
    fastest = {}
    for key, value in other.items():
        kind, _, way = key.partition(", ")
        fastest[kind] = min(fastest.get(kind, (np.inf, "")), (value, way))
        print(f"  Pinocchio {key:<40}{value:8.3f} us")
    for key, (value, way) in fastest.items():
        ratio = own[key] / value
        print(f"  ident     {key:<40}{own[key]:8.3f} us = {ratio:.2f} of Pinocchio's fastest ({way or key})")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("urdf", nargs="+")
    parser.add_argument("--ident", default="target/release/ident")
    parser.add_argument("--states", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--speed", action="store_true", help="time both as well (builds pinocchio.cpp)")
    options = parser.parse_args()
    rng, beside, good = np.random.default_rng(options.seed), built_ident(), True
    chains = []
    for urdf in (str(pathlib.Path(urdf).resolve()) for urdf in options.urdf):
        rigid = pin.buildModelFromUrdf(urdf)
        good &= compare(beside, urdf, rigid, "6", random_states(rigid, options.states, rng))
        if massless(rigid):
            good &= refused_by_name(options.ident, urdf)
        if pathlib.Path(urdf).name == CHAIN_OF_18:
            chains += [(urdf, rigid, "6"), (urdf, with_virtual_axes(rigid), "18")]
            good &= compare(beside, *chains[-1], random_states(chains[-1][1], options.states, rng))
    for urdf, model, hinges in chains if options.speed else []:
        print(f"{pathlib.Path(urdf).name}, {hinges} hinges")
        race(beside, built_pinocchio(), urdf, model, hinges, rng)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
