"""The curves of a figure: every point on the curve, jumps with both values, peaks exact."""

import itertools
import math

import numpy as np
import pytest
import repo

from geneva_cli import Cycloidal, Design, External, Harmonic, Load, Motion, Size, load
from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle_figures import MACHINES_MAX, USUAL_QUANTITIES, figure

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))
LOADED = Load(inertia_kgm2=0.4, torque_Nm=15)


def curve_of(design, name):
    (panel,) = design.figure([name]).panels
    (curve,) = panel.curves
    return curve


def points(curve):
    return [point for piece in curve.pieces for point in zip(*piece, strict=True)]


@pytest.mark.sampled(32)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_marks_are_the_answers_and_nothing_is_beyond_them(path):
    design = load(str(path))
    for panel in design.figure().panels:
        (curve,) = panel.curves
        name, values = panel.y.name, [y for _, y in points(curve)]
        greatest = max(abs(y) for y in values)
        if name == design.spec.output.column:
            assert curve.marks == ()
            steps = sum(2.0 * e.half_step for e in design.mechanism.engagements)
            steps *= design.spec.output.per_radian
            assert values[-1] - values[0] == pytest.approx(steps, rel=1e-12)
        elif name in ("velocity", "acceleration", "jerk"):
            (mark,) = curve.marks
            peak = getattr(design.peaks, name)
            assert abs(mark.y) == pytest.approx(peak.max, rel=4e-16)  # one place alone
            assert math.cos(math.radians(mark.x - peak.at_deg)) == pytest.approx(1.0)
            # what is drawn reaches the peak but for what a chord may cut off
            assert peak.max * (1.0 - 2e-3) < greatest < peak.max * (1.0 + 1e-9)
        else:
            want = design.loads[name]
            said = {mark.word: mark.y for mark in curve.marks}
            assert said["max"] == pytest.approx(want.max, rel=1e-12)
            if want.min < -1e-6 * want.max:
                assert said["min"] == pytest.approx(want.min, rel=1e-12)
            assert max(values) <= want.max * (1.0 + 1e-9)
            assert max(values) > want.max * (1.0 - 2e-3)


def test_jumps_have_both_values():
    """Harmonic: s'' = pi²/2 cos(pi u): it jumps to psi'' = +-(pi²/2) b / a² and back.

    b is the step pi/3 of six slots and a the motion 2 pi/3 in radians of the input.
    """
    design = Design(External(6), motion=Motion(Harmonic(), ratio="matched"))
    size = 0.5 * math.pi**2 * (math.pi / 3.0) / (2.0 * math.pi / 3.0) ** 2
    jumps = list(curve_of(design, "acceleration").jumps())
    # where all is smooth a jump may be a rounding
    jumps = [pytest.approx(j, rel=1e-9) for j in jumps if abs(j[1] - j[2]) > 1e-9]
    assert jumps == [(-60.0, 0.0, size), (60.0, -size, 0.0), (300.0, 0.0, size)]


def test_a_load_without_a_bound_leaves_the_panel():
    """A slot that lies across the pin's way at mid-motion, and a torque that is not 0 there."""
    design = Design(External(6), motion=Motion(Cycloidal(), ratio=0.42), load=LOADED)
    (panel,) = design.figure(["pin_force_N"]).panels
    (curve,) = panel.curves
    (word,) = [mark for mark in curve.marks if mark.y is None]
    assert (word.word, word.x) == ("max", pytest.approx(0.0, abs=1e-6))
    low, high = panel.bounds
    end = design.mechanism.engagements[0].exit_deg
    signed = design.cycle.states(np.linspace(-end, end, 4001), ["pin_force_N"])[0]
    assert low == pytest.approx(signed.min(), rel=1e-4)  # the square of the spacing
    # three times the force half-way between the ends and mid-motion
    x = np.array([-0.5, 0.5]) * design.mechanism.engagements[0].exit_deg
    assert high == pytest.approx(3.0 * design.cycle.states(x, ["pin_force_N"]).max(), rel=1e-9)
    ys = [y for _, y in points(curve)]
    assert max(ys) == high and all(math.isfinite(y) for y in ys)
    # no line runs along the edge
    runs = [p for _, y in curve.pieces for p in itertools.pairwise(y)]
    assert not [pair for pair in runs if pair == (high, high)]
    # but a stress is seen to be 0 in the dwell
    wide = Design(External(6), motion=design.spec.motion, load=LOADED, size=Size(face_width_mm=20))
    (panel,) = wide.figure(["contact_stress_MPa"]).panels
    assert panel.bounds and any(piece[1] == [0.0, 0.0] for piece in panel.curves[0].pieces)
    # and so is a force whose least value in the motion is above 0
    (panel,) = design.with_("load.inertia_kgm2", 0.0).figure(["pin_force_N"]).panels
    assert panel.bounds[0] == 0.0 and any(one[1] == [0.0, 0.0] for one in panel.curves[0].pieces)


def test_what_cannot_be_shown():
    bare = Design(External(6))
    with pytest.raises(GenevaError, match="no force is known"):
        bare.figure(["pin_force_N"])
    with pytest.raises(GenevaError, match=r'--pick jrk.*did you mean "jerk"'):
        bare.figure(["jrk"])
    with pytest.raises(GenevaError, match="a key that `geneva loads` names"):
        Design(External(6), load=LOADED).figure(["contact_stress_MPa"])
    with pytest.raises(GenevaError, match=f"at most {MACHINES_MAX}"):
        figure({str(i): bare.cycle for i in range(MACHINES_MAX + 1)})
    made, left = figure({"six": bare.cycle, "loaded": Design(External(6), load=LOADED).cycle})
    assert [p.y.name for p in made.panels] == ["wheel_deg", *USUAL_QUANTITIES]
    assert len(left) == 1 and left[0][0] == "six"
    assert left[0][1].startswith("no curve of pin_force_N, input_torque_Nm, ")
