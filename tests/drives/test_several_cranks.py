"""Several cranks about one wheel move it as rollers on one crank do: ``geneva explain rollers``.

The cranks stand at whole numbers of steps about the wheel. They are geared to one shaft and work in
turn, crank j after an j-th part of a turn. The program's machine is one crank with that many
rollers.
"""

import functools
import math
from itertools import combinations

import numpy as np
import pytest
from drawing_witness import polygon
from sampling import some
from shapely import affinity
from shapely.ops import unary_union

from geneva_cli import Crank, Cycloidal, Design, External, Load, Motion
from geneva_cli.drawings.parts_list import parts_list

pytestmark = pytest.mark.usefixtures("no_advice")

# steps in a revolution, places of the cranks in steps, and the slots that they enter
MACHINES = [
    (6, (0, 3), (0, 2, 4)),
    (8, (0, 3), (0, 2, 4, 6)),
    (12, (0, 5), (0, 2, 4, 6, 8, 10)),
    (6, (0, 2), (0, 1, 2, 3, 4, 5)),
    (5, (0, 2), (0, 1, 2, 3, 4)),
    (4, (0, 2, 1), (0, 1, 2, 3)),
    (3, (0, 1, 2), (0,)),  # one slot, which each crank hands to the next
]


@pytest.mark.parametrize(("steps", "places", "slots"), MACHINES)
def test_each_pin_stays_in_a_slot_of_the_wheel(steps, places, slots):
    """Pins are placed about their own cranks by hand; the wheel's angle is the program's."""
    mechanism = Design(External(steps), Crank(rollers=len(places))).mechanism
    (engagement,) = mechanism.engagements
    assert mechanism.period_deg == 360.0 / len(places)
    step, l = math.tau / steps, mechanism.ratio
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 101)
    own = 1.0 - l * np.exp(-1j * np.radians(x))  # a crank turns against the wheel
    entered = set()
    for number in range(steps * len(places)):  # the cranks' turns and the wheel's end together
        place = places[number % len(places)]
        wheel = number * step + engagement.motion(x, 0).c[0]
        angles = np.angle(own * np.exp(1j * (step * place - wheel)))
        # steps from the slot at the wheel's angle 0; 1e-12: roundings of some turns, over a step
        off = angles / step - np.round(angles[0] / step)
        assert np.abs(off - steps * np.round(off / steps)).max() <= 1e-12
        entered.add(round(angles[0] / step) % steps)
        assert round(angles[0] / step) % steps == (place - number) % steps
    assert sorted(entered) == list(slots)


# cranks with parts that clear each other, also as neighbours
BUILT = [(6, (0, 3)), (6, (0, 1)), (12, (0, 5)), (5, (0, 4, 3)), (3, (0, 1, 2))]
LOAD = Load(inertia_kgm2=0.02, torque_Nm=0.3, friction=0.1)


@functools.cache
def with_cranks(z, places):
    """The machine with a crank for each roller, under a load."""
    return Design(External(z), Crank(rollers=len(places), crank_steps=places), load=LOAD)


built = pytest.mark.parametrize(("z", "places"), BUILT)


def polygons(group):
    """The plates of a crank in its own frame, with their heights."""
    out = []
    for member in group.members:
        plate = member.part
        shape = polygon(plate.outline, 1e-3)
        shape = affinity.rotate(shape, member.turn, (0.0, 0.0), use_radians=True)
        out.append((affinity.translate(shape, *member.at), plate.low, plate.high))
    return out


def moved(shape, at, turn):
    shape = affinity.rotate(shape, turn, (0.0, 0.0), use_radians=True)
    return affinity.translate(shape, at.real, at.imag)


def by_hand(z, places, j, input_deg, L=100.0):
    """Axis and direction of crank j: it turns clockwise, and points at the wheel in its turn."""
    place = math.tau * places[j] / z
    after = math.radians(input_deg - 360.0 * j / len(places))
    return L * np.exp(1j * place), place + math.pi - after


@pytest.mark.sampled(5)
@built
def test_parts_are_drawn_where_the_cranks_stand(z, places):
    design = with_cranks(z, places)
    parts = design.parts.flat
    for j, crank in enumerate(parts.cranks):
        at, turn = by_hand(z, places, j, 0.0)
        assert complex(*crank.at) == pytest.approx(at, abs=1e-11)
        assert math.remainder(crank.turn - turn, math.tau) == pytest.approx(0.0, abs=1e-14)
    shafts = [one for one in parts.shafts if one.part.name == "crank's shaft"]
    assert [one.at for one in shafts] == [one.at for one in parts.cranks]
    holes = [complex(*hole.centre) for hole in parts.frame.part.holes]
    for j in range(len(places)):
        assert min(abs(at - by_hand(z, places, j, 0.0)[0]) for at in holes) < 1e-11
    listed = parts_list(design.parts).to_dict()
    counts = dict(zip(listed["name"], listed["count"], strict=True))
    for name in ("locking disc", "arm", "roller", "pin", "crank's shaft"):
        assert counts[name] == len(places)


SHAPED = [  # slots of other shapes
    Design(External(6), Crank(rollers=2, crank_steps=(0, 2)), Motion(Cycloidal())),
    Design(External(6, offset_mm=5), Crank(rollers=2, crank_steps=(0, 3))),
]


@pytest.mark.long
@pytest.mark.parametrize("design", [*(with_cranks(*one) for one in BUILT), *SHAPED])
def test_no_crank_meets_the_wheel_or_another_one(design):
    """Polygons at dense angles, each crank placed by hand; the program's gaps are of one crank.

    Chords miss arcs by 1e-3 mm, and the curves touch by design: overlaps are below 0.02 mm² there.
    """
    z, places = design.spec.wheel.z, design.spec.drive.crank_steps
    parts, mechanism = design.parts.flat, design.mechanism
    (engagement,) = mechanism.engagements
    plates, wheel = polygons(parts.crank.part), polygon(parts.wheel.part.outline, 1e-3)
    hull = unary_union([shape for shape, _, _ in plates]).convex_hull
    spacing, gap = 360.0 / len(places), math.inf
    for x in np.arange(0.0, 360.0, some(1.5, 4.5)):
        number = round(x / spacing)
        own = np.clip(x - number * spacing, engagement.entry_deg, engagement.exit_deg)
        psi = number * math.tau / z + engagement.motion(np.array([own]), 0).c[0][0]
        turned = moved(wheel, 0.0 + 0.0j, psi)
        hulls = []
        for j in range(len(places)):
            at, turn = by_hand(z, places, j, x)
            hulls.append(moved(hull, at, turn))
            for shape, _, high in plates:
                if high > 1e-9:  # in the wheel's plane; arms pass below it
                    assert moved(shape, at, turn).intersection(turned).area < 0.02
        gap = min(gap, *(a.distance(b) for a, b in combinations(hulls, 2)))
    (check,) = (one for one in design.checks if one.name == "cranks_apart_mm")
    assert check.passes
    # the program's bound is below the gap by less than a thousandth of the axes' distance, 2 L
    assert gap - 0.2 <= check.value <= gap + 1e-2
    (proof,) = (one for one in design.checks if one.name == "gap_proved_mm")
    assert proof.passes and proof.why


def test_cranks_that_meet_fail():
    """Two neighbours at a wheel of twelve slots; their discs alone take 2 lock_radius_mm."""
    (check,) = (c for c in with_cranks(12, (0, 1)).checks if c.name == "cranks_apart_mm")
    assert check.passes is False
    assert check.value < 0.0


@pytest.mark.sampled(9)
@pytest.mark.parametrize(("steps", "places", "slots"), MACHINES)
def test_the_listed_slots_are_those_that_pins_enter(steps, places, slots):
    design = Design(External(steps), Crank(rollers=len(places), crank_steps=places))
    table = design.report.table.to_dict()["cranks"]
    listed = {s for row in table for s in range(row["slot"], steps, row["slot_every"])}
    assert sorted(listed) == list(slots)


def test_backwards_the_second_of_two_cranks_stands_at_the_other_steps():
    """z - 2 steps from the first, not 2."""
    design = Design(External(6), Crank(rollers=2, crank_steps=(0, 2)))
    turned = [design.with_("wheel.z", z).backwards.spec.drive for z in (6, 7)]
    assert [drive.crank_steps for drive in turned] == [(0.0, 4.0), (0.0, 5.0)]
