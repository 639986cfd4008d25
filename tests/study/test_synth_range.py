"""Wishes that combine: ranges, bounds, a frame, an order; against dense sweeps of every kind."""

import math

import numpy as np
import pytest
import repo
from searched import searched
from words import Drive, Keys, Motion, Spec, Wheel, load

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.motion.many import many
from geneva_cli.spec.tables import Limits, Load, Size
from geneva_cli.study.batches import columns
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search

pytestmark = pytest.mark.usefixtures("few_four_bars")
# A minimum found to a share d of its place is d² off in its value, and no dense sweep is nearer.
NEAR = 1e-8


def rows(**options):
    return searched(**options)[1]


def test_a_dwell_of_several_turns_is_behind_a_first_wheel():
    """A first wheel of n slots turns the crank by 360/n once a turn, and that is its motion."""
    found = rows(dwell_deg="1000..")
    assert {row.cells["drive"] for row in found} == {"geneva-pair"}
    assert len(found) == 8  # z = 3 behind 3 to 6 slots, 4 behind 3 and 4, 5 and 6 behind 3
    for row in found:
        c, turns = row.cells, 360.0 * row.cells["first_z"]
        assert c["dwell_deg"] == pytest.approx(turns - c["motion_deg"], rel=1e-12)
    with pytest.raises(GenevaError, match="out of reach with 4 rollers; straight slots carry"):
        rows(motion_deg="30", dwell_deg="60", z="6")


FLAT = {"internal": True, "external": True}
WISHES = [
    {"dwell_s": "0.8..", "cycle": "1.5", "z": "8", "motion_deg": "..180"},
    {"motion_deg": "100..140", "z": "6", "rollers": 1},
    {"subject_to": ["k >= 0.3", "k <= 0.9"], "z": "4", "dwell_deg": "..250"},
    {"tau": "0.2..0.4", "z": "5", "subject_to": ["acceleration.max <= 2"], **FLAT},
]


@pytest.mark.long
@pytest.mark.parametrize("options", WISHES, ids=str)
def test_every_row_keeps_every_wish(options):
    target, found = searched(**options)
    assert len(found) > 3
    for row in found:
        cells, design = row.cells, Design.of(row.spec)
        times = cells | {"cycle": (cells["motion_s"] or 0.0) + (cells["dwell_s"] or 0.0)}
        for name, wanted in target.spans.items():
            inside = wanted.low * (1 - 1e-9) <= times[name] <= wanted.high * (1 + 1e-9)
            assert inside, (name, cells)
        for bound in target.bounds:
            if bound.name == "acceleration.max":
                assert cells["acceleration_max"] <= bound.bound * (1 + 1e-9)
        own = [design.peaks.acceleration.max, design.timing.motion_deg]
        assert own == pytest.approx([cells["acceleration_max"], cells["motion_deg"]], rel=1e-12)


def swept(spec, key, values, low, high):
    """The least peak acceleration of a dense sweep within a span of motions; none: infinite."""
    found = many(spec, {key: np.asarray(values)})
    if found.machine is None:
        return math.inf
    names = ["acceleration.max", "timing.motion_deg"]
    peak, motion = columns(found.machine, names, len(found.which))
    fits = (motion >= low) & (motion <= high)
    return float(peak[fits].min()) if fits.any() else math.inf


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("z", "low", "high"), [(6, 100.0, 140.0), (4, 110.0, 160.0), (6, 30.0, 50.0)]
)
@pytest.mark.parametrize("gearing", ["external", "internal"])
def test_no_dense_sweep_finds_a_gentler_machine(z, low, high, gearing):
    """Of every kind there is one exactly where there is one, and it is the gentlest."""
    found = rows(motion_deg=f"{low}..{high}", z=str(z), rollers=1, **{gearing: True})
    ours = {}
    for row in found:
        c = row.cells
        kind = c["drive"], c["phase"] or c["fixed"] or (c["law"] and "law") or ""
        ours[kind] = min(ours.get(kind, math.inf), c["acceleration_max"])
    wheel = Wheel(z, gearing)
    fine = np.linspace(-0.9999, 0.9999, 2001)
    spec = Spec(wheel, Drive("side-crank"), Keys("side-crank", 0.1))
    theirs, gears = {("side-crank", ""): swept(spec, "drive.A", fine, low, high)}, {}
    for phase in ("slow", "quick"):
        keys = Keys("elliptical-gears", 0.1, phase)
        spec = Spec(wheel, Drive("elliptical-gears"), keys)
        peak = swept(spec, "drive.eccentricity", fine[fine >= 0.0], low, high)
        gears["elliptical-gears", phase] = peak
    if gearing == "external" and z in (4, 6):
        for fixed in ("sun", "ring"):
            spec = Spec(wheel, Drive("epicyclic"), Keys("epicyclic", 0.0, fixed))
            ratios = np.linspace(-0.2, 0.2, 2001)
            theirs["epicyclic", fixed] = swept(spec, "drive.planet_ratio", ratios, low, high)
    alpha = np.linspace(-170.0, 170.0, 1361)
    # curved slots end at the longest motion whose parts can be built: test_synth
    spec = Spec(wheel, Drive("cam"), {}, Motion("modified-sine"))
    theirs["cam", "law"] = swept(spec, "motion.alpha0_deg", alpha, low, high)
    for kind, peak in theirs.items():
        assert (kind in ours) == (peak < math.inf), kind
        assert ours.get(kind, math.inf) <= peak * (1 + NEAR), kind
    # one signed eccentricity runs through both phases
    mine = min(ours.get(kind, math.inf) for kind in gears)
    assert mine <= min(gears.values()) * (1 + NEAR)


@pytest.mark.long
def test_without_a_wish_for_a_motion_the_nearest_to_the_plain_crank_keeps_the_bounds():
    """The velocity of z = 6 is 1; down to 0.8 with the least change of each kind, and no less."""
    found = rows(z="6", external=True, rollers=1, subject_to=["velocity.max <= 0.8"])
    ours = {r.cells["drive"]: r for r in found}
    assert {"side-crank", "elliptical-gears", "cam"} <= set(ours)
    for drive in ("side-crank", "elliptical-gears", "cam"):
        assert ours[drive].cells["velocity_max"] == pytest.approx(0.8, rel=1e-8)
    # the modified sine's C_v is 4 pi / (4 + pi), over a step of 60 degrees
    C_v = 4.0 * math.pi / (4.0 + math.pi)
    assert ours["cam"].cells["motion_deg"] == pytest.approx(C_v * 60.0 / 0.8, rel=1e-8)
    # a side-crank's peak velocity is at mid-motion, where it is the plain crank's 1 over 1 + A
    assert pytest.approx(0.25, rel=1e-7) == ours["side-crank"].cells["A"]


@pytest.mark.long
def test_of_what_no_array_has_several_machines_of_a_family_are_asked():
    """The crank of curved slots grows as their motion falls: R/L = V/(1 + V), V = C_v 60/motion.

    The gentlest, of 200 deg, have 34.5 mm of 100. The modified sine's C_v is 4 pi/(4 + pi).
    """
    target = {"motion_deg": "100..200", "z": "6", "external": True, "rollers": 1}
    found = rows(**target, subject_to=["sizes.crank_radius_mm >= 48"])
    (slots,) = [r.cells for r in found if r.cells["law"] and r.cells["drive"] == "crank"]
    V = 4.0 * math.pi / (4.0 + math.pi) * 60.0 / slots["motion_deg"]
    assert slots["motion_deg"] >= 100.0 and V / (1.0 + V) >= 0.48
    kinds = [(r.cells["drive"], r.cells["law"], r.cells["fixed"]) for r in found]
    assert len(set(kinds)) == len(kinds)  # the best of each


@pytest.mark.long
def test_a_frame_and_an_order():
    """Sizes, loads and speed of a spec in every row; each quantity is the built design's own."""
    frame = str(repo.DESIGNS / "press-345.toml")
    target = read_target(
        frame=load(frame).spec,
        motion_deg="100..130",
        rollers=1,
        external=True,
        sort="min:loads.input_torque_Nm.rms",
    )
    found = search(target)
    (name,) = target.names
    own = target.frame
    values = [row.cells[name] for row in found]
    assert values == pytest.approx(sorted(values), rel=1e-11)  # those of rounding are equal
    for row in found[:4]:
        assert (row.spec.load, row.spec.wheel.z) == (own.load, own.wheel.z)
        assert row.spec.drive.n_rpm == own.drive.n_rpm == row.cells["n_rpm"]
        assert row.cells[name] == pytest.approx(
            Design.of(row.spec).loads["input_torque_Nm"].rms, rel=1e-12
        )
    turned_round = search(target._replace(sort=Objective(-1.0, "acceleration.max")))
    peaks = [row.cells["acceleration_max"] for row in turned_round]
    assert peaks == pytest.approx(sorted(peaks, reverse=True), rel=1e-11)


def dense(spec, key, values, names):
    """Quantities of a dense sweep, (n,) each."""
    found = many(spec, {key: np.asarray(values)})
    return columns(found.machine, names, len(found.which))


@pytest.mark.long
@pytest.mark.parametrize(
    ("limit", "field", "most"),
    [
        ("input_torque_max_Nm", "loads.input_torque_Nm.max", 15.5),
        ("pin_force_max_N", "loads.pin_force_N.max", 300.5),
    ],
)
def test_a_frame_s_limits_choose_the_machine_of_a_range(limit, field, most):
    """The gentlest gears of the range break the limit; the gentlest that keep it are shown."""
    frame = Spec(
        Wheel(6),
        size=Size(center_distance_mm=200.0, roller_radius_mm=8.0),
        load=Load(inertia_kgm2=0.05, torque_Nm=30.0),
        limits=Limits(**{limit: most}),
    )
    found = rows(frame=frame, motion_deg="100..200", external=True, rollers=1)
    (gears,) = [r for r in found if r.cells["drive"] == "elliptical-gears"]
    names = ["acceleration.max", "timing.motion_deg", field]
    places = np.linspace(0.2, 0.4, 4001)
    peak, motion, load_ = dense(gears.spec, "drive.eccentricity", places, names)
    inside = (motion >= 100.0) & (motion <= 200.0)
    gentlest = np.flatnonzero(inside)[peak[inside].argmin()]
    assert load_[gentlest] > most
    assert gears.cells["parts"] == "maybe"
    assert sum(r.cells["drive"] == "four-bar" for r in found) <= 1
    fits = inside & (load_ <= most)
    assert gears.cells["acceleration_max"] <= peak[fits].min() * (1 + 1e-4)
    # of a plain crank there is no other: it stays, and says what it breaks
    (plain,) = [r for r in found if r.cells["drive"] == "crank" and not r.cells["law"]][:1]
    assert plain.cells["parts"] == f"no: {limit}"
