"""Four-bars that synth finds: each against the machine as built, and against brute force."""

import functools
import math

import numpy as np
import pytest

from geneva_cli.kinds.linkages import four_bar_search as families
from geneva_cli.kinds.linkages.four_bar import FourBar
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peak as peak_of
from geneva_cli.motion.wheels.external import External
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search

KEYS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm", "point_deg", "entry_deg")


@functools.cache
def four_bars(**options):
    """The four-bars of a wish, with their rows, searched for once."""
    found = search(read_target(**options))
    return [row for row in found if row.cells["drive"] == "four-bar"]


def reach(drive):
    """How far a joint or the roller comes from the crank's axis, by the linkage's own geometry."""
    phi = np.linspace(0.0, math.tau, 2001)
    A = drive.crank_mm * np.exp(1j * phi)
    d = drive.ground_mm - A
    # law of cosines: the angle at A between the rocker's pivot and B
    b, c, D = drive.coupler_mm, drive.rocker_mm, abs(d)
    e = d / D * np.exp(1j * np.arccos((b * b + D * D - c * c) / (2.0 * b * D)))
    C = A + drive.point_mm * np.exp(1j * math.radians(drive.point_deg)) * e
    return max(drive.ground_mm, abs(A + b * e).max(), abs(C).max())


@pytest.mark.long
@pytest.mark.parametrize(("z", "motion"), [(3, 75.0), (4, 100.0), (6, 120.0), (12, 200.0)])
def test_a_four_bar_makes_the_motion(z, motion):
    """Found in closed form; the machine is solved for in 50 digits, from its path alone.

    A closed form in doubles moves the point by some 1e-15 of its distance, and the motion by that
    over the slope with which the index angle passes the wanted one: 1e-12 leaves it to be 1/1000.
    """
    (row,) = four_bars(motion_deg=repr(motion), z=str(z), external=True)
    machine = build(row.spec)
    assert machine.engagements[0].motion_deg == pytest.approx(motion, rel=1e-12)
    assert machine.center_distance_mm == pytest.approx(100.0, rel=1e-12)
    assert row.cells["motion_deg"] == machine.engagements[0].motion_deg
    assert [row.cells[key] for key in KEYS] == [getattr(row.spec.drive, key) for key in KEYS]
    # the search looks at 192 places: a joint goes no farther between them than 1/1000
    assert reach(row.spec.drive) <= 300.0 * (1.0 + 1e-3)


def test_it_takes_one_roller_on_an_external_wheel():
    assert not four_bars(motion_deg="120", z="6", rollers=2)
    assert not four_bars(motion_deg="220", z="6", internal=True)
    assert not four_bars(motion_deg="120", z="6", spherical=True)


@pytest.mark.long
@pytest.mark.parametrize(
    ("bounds", "name", "low", "high"),
    [
        (["velocity.max <= 0.8"], "velocity_max", 0.0, 0.8),
        (["velocity.max >= 0.9", "velocity.max <= 0.92"], "velocity_max", 0.9, 0.92),
        (["jerk.max <= 5"], "jerk_max", 0.0, 5.0),
        (["dwell_s >= 0.7"], "dwell_s", 0.7, 1.0),
    ],
)
def test_it_keeps_bounds(bounds, name, low, high):
    """And of several the search offers one, for it knows these quantities itself."""
    (row,) = four_bars(
        motion_deg="90..200", cycle="1", z="6", external=True, subject_to=tuple(bounds)
    )
    assert low * (1 - 1e-9) <= row.cells[name] <= high * (1 + 1e-9)
    assert 90.0 * (1 - 1e-9) <= row.cells["motion_deg"] <= 200.0 * (1 + 1e-9)


@functools.cache
def brute(z, n=400):
    """Random four-bars: motion, peak acceleration and reach of those that drive a wheel."""
    random = np.random.default_rng(z)
    links = {
        key: random.uniform(30.0, 300.0, n) for key in ("ground_mm", "coupler_mm", "rocker_mm")
    }
    sides = np.array(list(links.values()))
    longest = np.minimum(sides.min(axis=0), sides.sum(axis=0) - 2.0 * sides.max(axis=0))
    turns = longest > 10.0
    varied = {f"drive.{key}": side[turns] for key, side in links.items()}
    count = int(turns.sum())
    varied["drive.crank_mm"] = longest[turns] * random.uniform(0.05, 0.97, count)
    varied["drive.point_mm"] = random.uniform(10.0, 400.0, count)
    varied["drive.point_deg"] = random.uniform(-180.0, 180.0, count)
    first = {key.removeprefix("drive."): value[0] for key, value in varied.items()}
    found = many(Spec(External(z), FourBar(**first)), varied)
    machine = found.machine
    drives = [
        FourBar(**{k.removeprefix("drive."): float(v[i]) for k, v in varied.items()})
        for i in found.which
    ]
    peak = worst_peaks(machine, ["acceleration"])["acceleration"].max
    motion = np.broadcast_to(machine.engagements[0].motion_deg, (len(peak), 1))[:, 0]
    return drives, motion, peak, machine.center_distance_mm[:, 0]


@pytest.mark.long
@pytest.mark.parametrize("z", [4, 6, 9])
def test_what_brute_force_finds_is_there_or_better(z):
    """Of hundreds of random four-bars with room the gentlest, for the motion of each."""
    drives, motion, peak, L = brute(z)
    fits = [i for i in range(len(peak)) if reach(drives[i]) <= 3.0 * L[i]]
    # by how gentle they are for their motion
    gentlest = sorted(fits, key=lambda i: peak[i] * motion[i] ** 2)[:3]
    assert len(fits) > 20
    for i in gentlest:
        target = read_target(motion_deg=repr(float(motion[i])), z=str(z))
        (family,) = families.four_bars(target, [External(z)])
        found = build(family.spec).engagements[0]
        assert peak_of(found.motion, "acceleration").max <= peak[i]
