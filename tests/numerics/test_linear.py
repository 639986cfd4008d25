"""Splines and small matrices in our own order of operations: right, and the same everywhere."""

import os
import signal
import subprocess
import sys
from decimal import Decimal

import numpy as np
import pytest
import repo
from scipy.interpolate import make_interp_spline

from geneva_cli.numerics import spline
from geneva_cli.numerics.linear import gram, inverse2, product

EPS = np.finfo(float).eps
ROOT = os.path.dirname(str(repo.TESTS))


def test_stacks():
    rng = np.random.default_rng(1)
    a, b, c = rng.normal(size=(7, 2, 2)), rng.normal(size=(7, 2, 3)), rng.normal(size=(7, 50, 4))
    assert product(a, b) == pytest.approx(a @ b, rel=0, abs=8 * EPS)
    assert gram(c, c) == pytest.approx(c.transpose(0, 2, 1) @ c, rel=0, abs=1000 * EPS)
    assert product(inverse2(a), a) == pytest.approx(np.stack([np.eye(2)] * 7), rel=0, abs=1e-12)


def exact(values):
    return [Decimal(v) for v in values]


@pytest.mark.parametrize("count", [7, 8, 41, 300])
def test_splines_are_scipys(count):
    """The same spline as SciPy's own, through points uneven by some hundreds to one."""
    rng = np.random.default_rng(count)
    x = np.concatenate(([0.0], np.sort(rng.random(count - 2)), [1.0]))
    y = x * x * (3.0 - 2.0 * x)
    between = np.concatenate((x, rng.random(1000)))
    flat = [(1, 0.0), (2, 0.0)]
    found = spline.at_rest(exact(x.tolist()), exact(y.tolist())).rounded()
    known = make_interp_spline(x, y, k=5, bc_type=(flat, flat))
    # what SciPy's rounds comes to some 1e-14 of coefficients about 1
    assert found(between, 0)[0] == pytest.approx(known(between), rel=0, abs=1e-12)
    assert found(x, 0)[0].tolist() == y.tolist()
    for end in (0.0, 1.0):
        assert found(end, 2) == [end, 0.0, 0.0]
    for v in between[-9:]:
        assert found(float(v), 5) == [c[0] for c in found(np.array([v]), 5)]

    y = 1.0 - 0.3 * np.cos(2.0 * np.pi * x)
    y[-1] = y[0]
    found = spline.periodic(exact(x.tolist()), exact(y.tolist())).rounded()
    known = make_interp_spline(x, y, k=5, bc_type="periodic")
    assert found(between, 0)[0] == pytest.approx(known(between), rel=0, abs=1e-12)
    assert found(x, 0)[0].tolist() == y.tolist()


# What is written of machines whose curves, laws or gears come from systems of equations
WORK = """
import hashlib, io, sys
import numpy as np
from geneva_cli import design
from geneva_cli.analysis.motion import motion_table
from geneva_cli.curves import fit
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.groove import groove_curve
from geneva_cli.parts.outlines import slot_walls
from geneva_cli.parts.sizes import sizes
def load(path):
    return design.load(path).mechanism
def tell(what):
    print(hashlib.sha256(repr(what).encode()).hexdigest())
cam = load("designs/cam-geneva.toml").engagements[0]
for side in (1.0, 0.0):
    curve = groove_curve(cam.groove, 441.89, 20.0 * side)
    for a, b in ((cam.entry_deg, cam.exit_deg), (cam.exit_deg, cam.entry_deg + 360.0)):
        tell(fit.KINDS["arcs"](curve, a, b, 0.001))
curved = load("designs/modified-sine-matched.toml")
where = assembly(curved)
tell(slot_walls(where, sizes(where), curved.engagements[0], 0.001))
tell([c.tolist() for c in motion_table(load("designs/table-law.toml"), 999).columns])
tell([c.tolist() for c in motion_table(load(sys.argv[1]), 999).columns])
# the kernels do differ: else this test shows nothing
a = np.random.default_rng(1).normal(size=(60, 60))
print("library", hashlib.sha256((a @ a + np.linalg.inv(a)).tobytes()).hexdigest())
"""
CORES = ["Haswell", "SkylakeX", "Zen", "Sandybridge", "Prescott"]


def test_the_same_bytes_for_every_kernel_of_the_library(tmp_path):
    (tmp_path / "ratio.csv").write_text(
        "".join(f"{x},{1 - 0.3 * np.cos(np.radians(x % 360)):.6f}\n" for x in range(0, 361, 15))
    )
    spec = tmp_path / "gears.toml"
    spec.write_text(
        '[wheel]\nz = 6\n[drive]\nkind = "noncircular-gears"\nratio_file = "ratio.csv"\n'
    )
    runs = {
        core: subprocess.Popen(
            [sys.executable, "-c", WORK, str(spec)],
            cwd=ROOT,
            env=os.environ | {"OPENBLAS_CORETYPE": core, "OPENBLAS_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for core in CORES
    }
    found, kernels = {}, set()
    for core, run in runs.items():
        said, wrong = run.communicate()
        if run.returncode == -signal.SIGILL:  # instructions that this processor does not have
            continue
        assert run.returncode == 0, wrong
        *ours, library = said.splitlines()
        found[core] = ours
        kernels.add(library)
    assert len(found) >= 2
    first = next(iter(found.values()))
    assert len(first) == 7
    assert all(ours == first for ours in found.values()), found
    if sys.platform == "linux" and os.uname().machine == "x86_64":
        assert len(kernels) > 1
