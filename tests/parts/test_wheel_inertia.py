"""The wheel's own inertia from its outline, against a polygon of it; what is said about it."""

import math

import pytest
import repo
from drawing_witness import vertices

from geneva_cli import Crank, Design, External, Load, Mass, Motor, Size, Support, load
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.warnings import carried_warnings, key_warnings


def told(spec, plate):
    return [*carried_warnings(build(spec), plate), *key_warnings(spec)]


def polygon(points):
    """Area and polar moment of a polygon about the origin, by its triangles."""
    area = polar = 0.0
    for (a, b), (c, d) in zip(points, points[1:], strict=False):
        cross = a * d - b * c
        area += cross / 2
        polar += cross * (a * a + a * c + c * c + b * b + b * d + d * d) / 12
    return area, polar


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "name", ["limits", "internal-z6", "press-curved", "offset-slots", "geneva-stop"]
)
def test_the_plate_of_a_wheel_by_its_polygon(name):
    design = load(str(repo.DESIGNS / f"{name}.toml")).with_("size.face_width_mm", 20.0)
    design = design.with_("material.wheel.density_kgm3", 2700.0)
    sizes = design.parts.sizes
    area, polar = polygon(vertices(design.parts.outlines.wheel, 1e-5))
    discs = [(sizes.outer, 1.0 if sizes.outer else 0.0), (sizes.wheel_bore, -1.0)]
    if sizes.outer:
        area, polar = -area, -polar  # the contour is the opening
    area += sum(sign * math.pi * r**2 for r, sign in discs)
    polar += sum(sign * math.pi * r**4 / 2 for r, sign in discs)
    rel = 1e-6  # chords within 1e-5 mm of the arcs
    assert design.wheel_plate.mass_kg == pytest.approx(2700 * 0.02 * area * 1e-6, rel=rel)
    assert design.wheel_plate.inertia_kgm2 == pytest.approx(2700 * 0.02 * polar * 1e-12, rel=rel)


def test_the_mass_that_is_suggested_adds_the_wheel():
    """Taken at its word, the warning is gone, and the wheel's inertia is counted."""
    size = Size(face_width_mm=20.0)
    design = Design(External(6), size=size, load=Load(inertia_kgm2=0.1))
    (said,) = told(design.spec, design.wheel_plate)
    words = said.replace(",", "").split()
    found = {key: float(words[words.index(key) + 2]) for key in ("mass_kg", "diameter_mm")}
    wheel = Mass("disc", name="wheel", **found)
    with_it = Design(External(6), size=size, load=Load(inertia_kgm2=0.1), mass=[wheel])
    assert not told(with_it.spec, with_it.wheel_plate)
    own = design.wheel_plate.inertia_kgm2
    # 1e-3: four digits are said
    counted = with_it.loads_table.to_dict()["sizing.inertia_kgm2"]
    assert counted == pytest.approx(0.1 + own, abs=1e-3 * own)
    assert design.loads_table.to_dict()["sizing.wheel_inertia_kgm2"] == own


@pytest.mark.parametrize("gearing", ["external", "internal", "spherical", "linear"])
def test_lengths_in_metres_are_said(gearing):
    """A quarter of a metre is 250 mm, and no machine is below 5 mm."""
    wheel = registry.gearing(gearing)(6)
    (said,) = told(Spec(wheel, size=Size(0.25)), None)
    assert said.name == "tiny-machine"
    assert "in metres, write 250;" in said
    assert f"in inches, {0.25 * 25.4:.4g}" in said
    assert told(Spec(wheel, size=Size(4.99)), None)
    assert not told(Spec(wheel, size=Size(5.0)), None)


def test_a_weight_to_one_side_of_a_horizontal_axis():
    """m g e, there and back in a turn."""
    one = Mass("point", mass_kg=2.0, radius_mm=100.0, name="drum")
    spec = Spec(External(6), mass=(one,), support=Support(axis="horizontal"))
    (said,) = told(spec, None)
    assert said.startswith("drum stands 100 mm off a horizontal axis. Its weight puts up to 1.961")
    assert not told(spec.with_("support.axis", "vertical"), None)
    disc = Mass("disc", mass_kg=2.0, diameter_mm=100.0)  # on the axis
    assert not told(Spec(External(6), mass=(disc,), support=spec.support), None)
    four = Mass("point", mass_kg=2.0, radius_mm=100.0, count=4)
    assert not told(Spec(External(6), mass=(four,), support=spec.support), None)


@pytest.mark.long
def test_the_force_of_a_body_off_the_axis():
    """At most m e w² hypot(v², a), at least the greatest along the motion, by differences of it."""
    arm = Mass("point", mass_kg=2.0, radius_mm=100.0, name="arm")

    def design(*masses, gear_ratio=1.0):
        drive, support = Crank(n_rpm=120.0), Support(gear_ratio=gear_ratio)
        return Design(External(6), drive, mass=masses, support=support)

    def unbalanced(design):
        return [text for text in map(str, design.warnings) if "off the wheel's axis" in text]

    (said,) = unbalanced(design(arm))
    assert said.startswith("arm stands off the wheel's axis.")
    most = float(said.partition("hold up to ")[2].split()[0])
    w = 4.0 * math.pi
    step, half = 1e-4, math.radians(60.0)  # of the crank, from mid-motion

    def psi(t):  # the direction of the roller from the wheel's axis: r = L/2
        return math.atan2(0.5 * math.sin(t), 1.0 - 0.5 * math.cos(t))

    forces = []
    for i in range(-1000, 1001):
        t = half * i / 1000
        v = (psi(t + step) - psi(t - step)) / (2 * step)
        a = (psi(t + step) - 2 * psi(t) + psi(t - step)) / step**2
        forces.append(2.0 * 0.1 * w * w * math.hypot(v * v, a))
    # v <= 1 and a <= 1.3496 (theory): together at most a quarter above both at once
    assert max(forces) < most < 1.25 * max(forces)
    assert most == pytest.approx(2.0 * 0.1 * w * w * math.hypot(1.0, 1.3496), rel=1e-3)  # 4 digits

    assert not unbalanced(design(Mass("point", mass_kg=2.0, radius_mm=100.0, count=2)))
    assert not unbalanced(design(arm, gear_ratio=2.0))
    heavy = Mass("disc", mass_kg=1000.0, diameter_mm=1000.0)  # its pin force is far greater
    assert not unbalanced(design(arm, heavy))


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (Spec(External(6), motor=Motor(service_factor=2.0)), "[motor] has no load to drive"),
        (
            Spec(External(6), load=Load(0.1), support=Support(friction=0.1)),
            "friction in [support] has no effect without radius_mm",
        ),
        (
            Spec(External(6), load=Load(0.1), support=Support(friction=0.1, radius_mm=50.0)),
            "nothing presses on the support",
        ),
    ],
)
def test_what_contradicts_itself_is_said(spec, said):
    (text,) = told(spec, None)
    assert said in text
