#!/usr/bin/env python3
"""ident beside Pinocchio (wheel `pin` from PyPI): the same URDF, random states, both live.

    pip install pin
    cargo build --release
    python benches/peers/beside_pinocchio.py path/to/*.urdf [--ident target/release/ident] [--states 20]

Compared within 1e-10 relative: tool pose, Jacobian (tool point, base axes), mass matrix, gravity torque as
`ident simulate pose` prints them; then RNEA and ABA by closure: Pinocchio's inverse and forward dynamics
must fit the mass matrix and gravity of ident (the velocity terms are compared in tests/robot_pinocchio.rs).
The tool is the frame `tool0`, else the last link, as in ident. Exit status 1 if anything differs.
"""
import argparse
import json
import subprocess
import sys

import numpy as np
import pinocchio as pin

TOLERANCE = 1e-10


def tool_frame(model):
    """`tool0`, else the last body of the file."""
    if model.existFrame("tool0"):
        return model.getFrameId("tool0")
    bodies = [i for i, f in enumerate(model.frames) if f.type == pin.FrameType.BODY]
    return bodies[-1]


def ask_ident(ident, urdf, q):
    degrees = ",".join(repr(float(x)) for x in np.degrees(q))
    typed = [ident, "simulate", "pose", "--robot", urdf, f"--joints-deg={degrees}", "--json"]
    run = subprocess.run(typed, capture_output=True, text=True)
    if run.returncode == 2:
        raise SystemExit(f"{urdf}: refused by ident: {run.stderr.strip()}")
    return json.loads(run.stdout)


def worst(found, wanted):
    wanted = np.asarray(wanted)
    scale = max(np.abs(wanted).max(), 1e-300)
    return np.abs(np.asarray(found) - wanted).max() / scale


def compare(model, data, tool, answer, q, rng):
    """Largest relative difference of every quantity at one state."""
    v, a = rng.uniform(-1, 1, model.nv), rng.uniform(-1, 1, model.nv)
    pin.computeJointJacobians(model, data, q)
    pin.framesForwardKinematics(model, data, q)
    pose = data.oMf[tool]
    jacobian = pin.getFrameJacobian(model, data, tool, pin.LOCAL_WORLD_ALIGNED)
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    gravity = pin.computeGeneralizedGravity(model, data, q)
    own_mass, own_gravity = np.array(answer["mass_matrix"]), np.array(answer["gravity_torque_Nm"])
    bias = pin.nonLinearEffects(model, data, q, v) - gravity
    torque = pin.rnea(model, data, q, v, a)
    acceleration = pin.aba(model, data, q, v, torque)
    return {
        "pose": max(worst(answer["tcp_m"], pose.translation), worst(answer["tcp_rotation"], pose.rotation)),
        "jacobian": worst(answer["jacobian"], jacobian),
        "M": worst(own_mass, mass),
        "G": worst(own_gravity, gravity),
        "RNEA": worst(own_mass @ a + bias + own_gravity, torque),
        "ABA": worst(np.linalg.solve(own_mass, torque - bias - own_gravity), acceleration),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("urdf", nargs="+")
    parser.add_argument("--ident", default="target/release/ident")
    parser.add_argument("--states", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    failed = False
    for urdf in options.urdf:
        model = pin.buildModelFromUrdf(urdf)
        data, tool = model.createData(), tool_frame(model)
        largest = {}
        for _ in range(options.states):
            q = rng.uniform(-2, 2, model.nq)
            found = compare(model, data, tool, ask_ident(options.ident, urdf, q), q, rng)
            largest = {key: max(value, largest.get(key, 0.0)) for key, value in found.items()}
        failed |= max(largest.values()) > TOLERANCE
        print(urdf.rsplit("/", 1)[-1], " ".join(f"{key} {value:.1e}" for key, value in largest.items()))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
