"""The same bytes on every processor.

A library of linear algebra picks its kernels by the processor, and they round differently: what
reaches a file must not come from one. Elementwise products and sums in a fixed order are rounded
by IEEE 754 alone. (NumPy's own sines differ in the last place between instruction sets, AVX-512 or
not: the same bytes are promised within one instruction set.)
"""

import os
import signal
import subprocess
import sys

import pytest
import repo
from sampling import some

ROOT = os.path.dirname(str(repo.TESTS))

# What is written of machines whose curves, laws or gears come from systems of equations, and loads
# and vibration, whose integrals are sums of products
WORK = """
import functools, hashlib, io, sys
import numpy as np
from geneva_cli import design
from geneva_cli.motion.motion_table import motion_table
from geneva_cli.geometry import fit
from geneva_cli.parts.slots.groove import groove_curve
from geneva_cli.parts.outlines.cut_outlines import slot_walls
from geneva_cli.parts.machine_sizes import machine_sizes
def load(path):
    return design.load(path).mechanism
def tell(what):
    print(hashlib.sha256(repr(what).encode()).hexdigest())
cam = load("designs/cam-geneva.toml").engagements[0]
for side in (1.0, 0.0):
    curve = functools.partial(groove_curve, cam.groove, 441.89, 20.0 * side)
    for a, b in ((cam.entry_deg, cam.exit_deg), (cam.exit_deg, cam.entry_deg + 360.0)):
        tell(fit.KINDS["arcs"](curve, a, b, 0.001))
curved = load("designs/modified-sine-matched.toml")
tell(slot_walls(*machine_sizes(curved), curved.engagements[0], 0.001))
tell([c.tolist() for c in motion_table(load("designs/table-law.toml"), 999).columns])
tell([c.tolist() for c in motion_table(load(sys.argv[1]), 999).columns])
for name in ("cam-geneva", "turret"):
    own = design.load(f"designs/{name}.toml", ["shaft.stiffness_Nm_rad=1000"])
    tell(own.loads_table.to_dict())
    tell([own.vibration().to_dict(), own.spectrum(21).to_rows()])
# the kernels do differ: else this test shows nothing
a = np.random.default_rng(1).normal(size=(60, 60))
print("library", hashlib.sha256((a @ a + np.linalg.inv(a)).tobytes()).hexdigest())
"""
# two that differ most and that most processors run; the others are between them
CORES = some(["Haswell", "SkylakeX", "Zen", "Sandybridge", "Prescott"], ["Haswell", "Prescott"])


@pytest.mark.long
def test_the_same_bytes_for_every_kernel_of_the_library(tmp_path):
    spec = tmp_path / "gears.toml"
    spec.write_text('[wheel]\nz = 6\n[drive]\nkind = "noncircular-gears"\nA = 0.4\n')
    runs = {
        core: subprocess.Popen(
            [sys.executable, "-c", WORK, str(spec)],
            cwd=ROOT,
            env=os.environ | {"OPENBLAS_CORETYPE": core, "OPENBLAS_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
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
    assert len(first) == 11
    assert all(ours == first for ours in found.values()), found
    if sys.platform == "linux" and os.uname().machine == "x86_64":
        assert len(kernels) > 1
