"""Linear equations in our own order of operations: right, and the same whatever the processor."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from mpmath import mp
from scipy.interpolate import make_interp_spline

from geneva_cli import spline
from geneva_cli.linear import gram, inverse2, product, solve, solve_banded

EPS = np.finfo(float).eps
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


@pytest.mark.parametrize("n", [1, 2, 6, 10])
def test_solve(n):
    rng = np.random.default_rng(n)
    matrix, right = rng.normal(size=(n, n)), rng.normal(size=(n, 3))
    matrix[0, 0] = 0.0 if n > 1 else 1.0  # a pivot must be looked for
    exact = mp.lu_solve(mp.matrix(matrix.tolist()), mp.matrix(right[:, 0].tolist()))
    for found in (solve(matrix, right)[:, 0], solve(matrix, right[:, 0])):
        # backward stable: n units times the condition number, and a little for its growth
        bound = 8 * n * EPS * np.linalg.cond(matrix) * max(map(abs, exact))
        assert max(abs(float(a - b)) for a, b in zip(found, exact, strict=True)) <= bound
    with pytest.raises(ZeroDivisionError):
        solve(np.zeros((n, n)), right)


def test_stacks():
    rng = np.random.default_rng(1)
    a, b, c = rng.normal(size=(7, 2, 2)), rng.normal(size=(7, 2, 3)), rng.normal(size=(7, 50, 4))
    assert product(a, b) == pytest.approx(a @ b, rel=0, abs=8 * EPS)
    assert gram(c, c) == pytest.approx(c.transpose(0, 2, 1) @ c, rel=0, abs=1000 * EPS)
    assert product(inverse2(a), a) == pytest.approx(np.stack([np.eye(2)] * 7), rel=0, abs=1e-12)


@pytest.mark.parametrize("width", [1, 2, 4])
def test_solve_banded(width):
    n, rng = 12, np.random.default_rng(width)
    full = np.zeros((n, n))
    for i in range(n):
        for j in range(max(0, i - width), min(n, i + width + 1)):
            full[i, j] = rng.normal() + (4.0 * width if i == j else 0.0)
    right = rng.normal(size=(n, 2)).tolist()
    rows = [
        [full[i, i + k] if 0 <= i + k < n else 0.0 for k in range(-width, width + 1)]
        for i in range(n)
    ]
    known = np.linalg.solve(full, np.array(right))
    solve_banded(rows, width, right)
    assert np.array(right) == pytest.approx(known, rel=0, abs=1e-13)  # well conditioned


@pytest.mark.parametrize("count", [7, 8, 41, 300])
def test_splines_are_scipys(count):
    """The same spline as SciPy's own, through points uneven by some hundreds to one."""
    rng = np.random.default_rng(count)
    x = np.concatenate(([0.0], np.sort(rng.random(count - 2)), [1.0]))
    y = x * x * (3.0 - 2.0 * x)
    flat = [(1, 0.0), (2, 0.0)]
    found = spline.at_rest(x.tolist(), y.tolist())
    known = make_interp_spline(x, y, k=5, bc_type=(flat, flat))
    assert (found.t == known.t).all()
    # what both round comes to some 1e-14 of coefficients about 1
    assert found.c == pytest.approx(known.c, rel=0, abs=1e-12)
    assert found(x) == pytest.approx(y, rel=0, abs=4 * EPS)
    for order in (1, 2):
        assert found.derivative(order)(np.array([0.0, 1.0])).tolist() == [0.0, 0.0]

    y = 1.0 - 0.3 * np.cos(2.0 * np.pi * x)
    y[-1] = y[0]
    found = spline.periodic(x.tolist(), y.tolist())
    known = make_interp_spline(x, y, k=5, bc_type="periodic")
    assert found.t == pytest.approx(known.t, rel=0, abs=4 * EPS)
    assert found.c == pytest.approx(known.c, rel=0, abs=1e-12)
    assert found(x) == pytest.approx(y, rel=0, abs=4 * EPS)


# What is written of machines whose curves, laws or gears come from systems of equations
WORK = """
import hashlib, io, sys
import numpy as np
from geneva_cli.spec import load
from geneva_cli.motion import motion_table
from geneva_cli.outline import slot_walls
from geneva_cli.plane import plane
from geneva_cli.sizes import sizes
from geneva_cli import fit
from geneva_cli.groove import groove_curve
def tell(what):
    print(hashlib.sha256(repr(what).encode()).hexdigest())
cam = load("designs/cam-geneva.toml").stations[0]
for side in (1.0, 0.0):
    curve = groove_curve(cam, 441.89, 20.0 * side)
    for a, b in ((cam.entry_deg, cam.exit_deg), (cam.exit_deg, cam.entry_deg + 360.0)):
        tell(fit.KINDS["arcs"](curve, a, b, 0.001))
curved = load("designs/modified-sine-matched.toml")
where = plane(curved)
tell(slot_walls(where, sizes(where), curved.stations[0], 0.001))
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
