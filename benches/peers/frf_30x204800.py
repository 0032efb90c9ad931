"""FRFs of 30 hits of 204 800 samples and 3 responses: pyFRF and scipy beside ident, one run.

    python3 benches/peers/frf_30x204800.py [--threads N] [--repeats N]

Needs numpy and scipy; pyFRF if it is installed (`pip install pyFRF`). ident's time is that of its own
benchmark of the same work (`cargo bench --bench frf`), run by this script with the same number of
threads. Best of the repeats, without process start, import and reading of files on either side.
"""
import argparse
import os
import re
import subprocess
import sys
import time

HITS, SAMPLES, RESPONSES, RATE = 30, 204_800, 3, 51_200


def best(repeats, work):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return 1e3 * min(times)


def scipy_h1(np, fft, force, response):
    f = fft.rfft(force, axis=-1)
    x = fft.rfft(response, axis=-1)
    ff = (np.abs(f) ** 2).sum(axis=0)
    fx = (np.conj(f)[:, None] * x).sum(axis=0)
    xx = (np.abs(x) ** 2).sum(axis=0)
    return fx / ff, np.abs(fx) ** 2 / (ff * xx)


def py_frf(force, response):
    from pyFRF import FRF
    frf = FRF(sampling_freq=RATE, exc=force[:, None, :], resp=response, window="none",
              resp_type="a", exc_type="f")
    return frf.get_H1(), frf.get_coherence()


def ident():
    text = subprocess.run(["cargo", "bench", "--bench", "frf"], capture_output=True, text=True, check=True).stdout
    low, unit = re.search(r"time:\s+\[([\d.]+) (\S+)", text).groups()
    return float(low) * {"ms": 1.0, "s": 1e3, "µs": 1e-3}[unit]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"):
        os.environ[name] = str(given.threads)
    rows = [("ident", ident())]
    try:
        import numpy as np
        import scipy.fft as fft
    except ImportError as missing:
        print(f"scipy: not installed ({missing.name})", file=sys.stderr)
    else:
        random = np.random.default_rng(1)
        force = random.random((HITS, SAMPLES)) - 0.5
        response = random.random((HITS, RESPONSES, SAMPLES)) - 0.5
        with fft.set_workers(given.threads):
            rows.append(("scipy", best(given.repeats, lambda: scipy_h1(np, fft, force, response))))
        try:
            rows.append(("pyFRF", best(given.repeats, lambda: py_frf(force, response))))
        except ImportError:
            print("pyFRF: not installed", file=sys.stderr)
    for name, milliseconds in rows:
        print(f"{name:8} {milliseconds:8.1f} ms   {milliseconds / rows[0][1]:.2f} times ident")


if __name__ == "__main__":
    main()
