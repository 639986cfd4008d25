"""The list of parts: each machine is rebuilt from what is printed, by other formulas."""

import csv
import io
import math
from pathlib import Path

import numpy as np
import pytest
from drawing_witness import polygon
from scipy.integrate import quad
from scipy.interpolate import make_interp_spline
from typer.testing import CliRunner
from witness import LAWS, krasniqi

from geneva_cli import Design
from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import moments
from geneva_cli.motion import registry
from geneva_cli.motion.registry import of_wheel

DESIGNS = sorted(Path(__file__, "../../../designs").resolve().glob("*.toml"))
SAME = 1e-9  # radians, as far as a machine must come out from its printed dimensions


def through_points(d, folder):
    """SciPy's quintic spline through the points of the file that the list names, at rest."""
    rows = np.loadtxt(folder / d["law's file"], delimiter=",", skiprows=1)
    ends = 2 * ([(1, 0.0), (2, 0.0)],)
    return make_interp_spline(*rows.T, k=5, bc_type=ends)


def law_of(d, folder):
    """A law by its printed name and numbers."""
    name = d["law"]
    if name == "table":
        return through_points(d, folder)
    law = krasniqi(d["law's lambda"]) if name == "sine-group" else LAWS[name]
    return lambda u: float(law(u, 1)[0])


def printed(path):
    """The list as csv: parts, pivots and dimensions by name."""
    run = CliRunner().invoke(app, ["profile", str(path), "--part", "parts", "--format", "csv"])
    assert run.exit_code == 0, run.output
    rows = list(csv.DictReader(io.StringIO(run.stdout)))
    parts = {r["name"]: r for r in rows if r["row"] == "part"}
    pivots = {
        r["name"]: complex(float(r["x_mm"]), float(r["y_mm"])) for r in rows if r["row"] == "pivot"
    }
    numbers = {r["name"]: number(r["value"]) for r in rows if r["row"] == "dimension"}
    assert all((r["value"] == "") == (r["row"] != "dimension") for r in rows)
    return parts, pivots, numbers


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def turn(deg):
    return complex(math.cos(math.radians(deg)), math.sin(math.radians(deg)))


def crank_angle(p, d, phi):
    """The Geneva crank's angle, radians, from the line of centres, behind what drives it."""
    sign = -1.0 if d["wheel"] == "internal" else 1.0
    if "input crank axis" in p:  # the coulisse points from its own axis through the crank's pin
        pin = p["input crank axis"] - sign * d["input crank r"] * turn(-phi * sign)
        way = -sign * (pin - p["crank axis"])
        return -sign * math.atan2(way.imag, way.real)
    if "gears' focus from centre" in d:  # two equal ellipses roll on each other
        a, e = d["gears' semi-major axis"], d["gears' focus from centre"]
        e = e / a if d["index in the gears' phase"] == "slow" else -e / a

        far = d["gears' axes"]

        def ratio(t):  # the driver's radius is least where the driven gear is slow
            driver = a * (1.0 - e * e) / (1.0 + e * math.cos(t))
            return driver / (far - driver)

        return quad(ratio, 0.0, math.radians(phi), epsabs=1e-13)[0]
    if "gears' ratio as of side-crank A" in d:
        A, t = d["gears' ratio as of side-crank A"], math.radians(phi)
        return math.atan2(math.sin(t), A + math.cos(t))
    if "first crank radius" in d:
        pin = d["first centre distance"] - d["first crank radius"] * turn(-phi)
        return math.atan2(pin.imag, pin.real)
    return math.radians(phi)


def roller(p, d, i):
    """The i-th roller's place, in units of mm from the wheel's axis, for an input angle."""
    L, sign = d["centre distance"], -1.0 if d["wheel"] == "internal" else 1.0
    if "carrier R0" in d:
        ratio = d["fixed teeth / planet teeth"]
        c = 1.0 + ratio if d["fixed gear"] == "sun" else 1.0 - ratio

        def on_planet(phi):
            return L - d["carrier R0"] * turn(-phi) - d["planet crank rp"] * turn(-c * phi)

        return lambda phi: on_planet(math.degrees(crank_angle(p, d, phi)))
    if "crank pin A" in p:
        own = linkage(p, d)
        return lambda phi: own(math.degrees(crank_angle(p, d, phi)))
    R = d[f"roller {i}: crank radius"]
    behind = math.radians(d[f"roller {i}: behind the first"])

    def place(phi):
        angle = crank_angle(p, d, phi) - behind
        return L - sign * R * complex(math.cos(angle), -sign * math.sin(angle))

    return place


def linkage(p, d):
    """Joints by circles, on the side on which they are printed at input 0."""
    axis, A0, C0 = p["crank axis"], p["crank pin A"], p["roller C"]
    sense = 1.0 if d["crank turns"] == "counterclockwise" else -1.0

    def joints(A):
        if "rocker axis" in p:
            far = p["rocker axis"] - A
            D, b, c = abs(far), d["coupler b"], d["rocker c"]
            along = (D * D + b * b - c * c) / (2.0 * D)
            aside = math.sqrt(b * b - along * along)
            return [A + far / D * complex(along, side * aside) for side in (1.0, -1.0)]
        foot, ahead = p["slider's line, foot"], p["slider's line, ahead"]
        line = (ahead - foot) / abs(ahead - foot)
        off = ((A - foot) / line).imag
        at = ((A - foot) / line).real + math.sqrt(d["rod b"] ** 2 - off * off)
        return [foot + at * line]

    def point(A, B):
        arm = d["roller from A"] * turn(sense * d["angle BAC"])
        return A + arm * (B - A) / abs(B - A)

    side = min(range(len(joints(A0))), key=lambda k: abs(point(A0, joints(A0)[k]) - C0))
    assert abs(point(A0, joints(A0)[side]) - C0) < 1e-9 * abs(axis)

    def place(phi):
        A = axis + (A0 - axis) * turn(sense * phi)
        return point(A, joints(A)[side])

    return place


def angle(p, d, i, one, folder):
    """The wheel's angle, radians, from any zero, in the i-th engagement.

    Of a rack it is that of a pinion of the crank's radius.
    """
    if d["wheel"] == "linear":
        return lambda x: math.sin(math.radians(x))
    if "law" in d:
        law = law_of(d, folder)
        entry, exit_ = one["entry"], one["exit"]
        return lambda x: one["step"] * law((x - entry) / (exit_ - entry))
    if "sphere's radius" in d:
        S, th = (
            math.radians(d["angle of the shafts"]),
            math.asin(d[f"roller {i}: crank radius"] / d["sphere's radius"]),
        )
        return lambda x: math.atan2(
            math.sin(th) * math.sin(math.radians(x)),
            math.sin(S) * math.cos(th) - math.cos(S) * math.sin(th) * math.cos(math.radians(x)),
        )
    if "sector's angle" in d:
        return in_gear(d)
    place, e = roller(p, d, i), d.get("slots' axes offset from the wheel's", 0.0)

    def found(x):
        pin = place(one["mid"] + x)
        return math.atan2(pin.imag, pin.real) + math.asin(e / abs(pin))

    return found


def in_gear(d):
    """Slot, gears at a constant ratio, slot."""
    half = 0.5 * d["sector's angle"]

    def slot(deg):
        pin = d["centre distance"] - d["crank radius"] * turn(-deg)
        return math.atan2(pin.imag, pin.real)

    turned = d["gears' ratio u"] * math.radians(half)

    def found(x):
        if abs(x) <= half:
            return d["gears' ratio u"] * math.radians(x)
        return slot(math.copysign(abs(x) - half, x)) + math.copysign(turned, x)

    return found


@pytest.mark.sampled(40)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_a_machine_is_rebuilt_from_what_is_printed(path):
    _, pivots, d = printed(path)
    machine = load(str(path)).mechanism
    many, turned = len(machine.engagements) > 1, machine.output.noun
    for i, engagement in enumerate(machine.engagements, 1):
        name = f"engagement {i}: " if many else ""
        one = {
            "step": math.radians(d[f"{name}{turned}'s step"])
            if machine.output.turns
            else d["rack's step"] / d["crank radius"],
            "mid": d[f"{name}input at mid-motion"],
            "entry": d[f"{name}entry, from mid-motion"],
            "exit": d[f"{name}exit, from mid-motion"],
        }
        rebuilt = angle(pivots, d, i, one, path.parent)
        ends = [rebuilt(one[end]) for end in ("entry", "exit")]
        assert math.remainder(ends[1] - ends[0] - one["step"], math.tau) == (
            pytest.approx(0.0, abs=SAME)
        )
        for x in np.linspace(one["entry"], one["exit"], 13):
            psi = float(engagement.motion(float(x), 0).c[0]) + engagement.half_step
            assert math.remainder(rebuilt(x) - ends[0] - psi, math.tau) == pytest.approx(
                0.0, abs=SAME
            )


def test_every_kind_is_rebuilt():
    """No drive, and no gearing with a parts list, is left out of the designs."""
    specs = [load(str(path)).spec for path in DESIGNS]
    assert {spec.drive.NAME for spec in specs} == set(registry.DRIVES)
    listed = {name for name in registry.GEARINGS if any(k.parts for k in of_wheel(name))}
    assert {spec.wheel.NAME for spec in specs} == listed


def test_masses_are_those_of_the_drawings():
    """Each by the areas of its own drawing: the density, the thickness, and what is cut out."""
    path = next(p for p in DESIGNS if p.stem == "limits")
    design = load(str(path))
    parts, _, _ = printed(path)
    shafts = ["wheel's shaft", "crank's shaft"]
    assert list(parts) == ["wheel", "locking disc", "arm", "roller", "pin", *shafts, "frame"]
    plates = {"wheel": "wheel", "locking disc": "crank", "arm": "arm", "frame": "frame"}
    for name, part in plates.items():
        shapes = [s for s in design.drawing(part).shapes if s.layer != "ROLLER"]
        whole, *holes = (moments(s) for s in shapes)
        row = parts[name]
        per = 7850.0 * 12e-3
        area = abs(whole.area) - sum(abs(h.area) for h in holes)
        polar = abs(whole.polar) - sum(abs(h.polar) for h in holes)
        assert float(row["mass_kg"]) == pytest.approx(per * area * 1e-6, rel=1e-4)
        assert float(row["inertia_kgm2"]) == pytest.approx(per * polar * 1e-12, rel=1e-4)
        assert float(row["thickness_mm"]) == 12.0
    roller, pin = parts["roller"], parts["pin"]
    assert float(roller["mass_kg"]) == pytest.approx(7850 * 12e-3 * math.pi * (8**2 - 4**2) * 1e-6)
    assert float(pin["inertia_kgm2"]) == pytest.approx(0.5 * float(pin["mass_kg"]) * 16e-6)


def test_centroids_are_those_of_fine_polygons():
    """Of a locking disc and an arm with their holes, by shapely; a wheel's is on its axis."""
    path = next(p for p in DESIGNS if p.stem == "limits")
    design, (parts, _, _) = load(str(path)), printed(path)
    for name, part in (("locking disc", "crank"), ("arm", "arm")):
        shapes = [s for s in design.drawing(part).shapes if s.layer != "ROLLER"]
        whole, *holes = (polygon(s, 1e-4) for s in shapes)
        for hole in holes:
            whole = whole.difference(hole)
        shown = [float(parts[name][f"centroid_{axis}_mm"]) for axis in "xy"]
        # chords of 0.1 um, and seven digits that are printed
        assert shown == pytest.approx([whole.centroid.x, whole.centroid.y], abs=1e-4)
    assert [float(parts["wheel"][f"centroid_{axis}_mm"]) for axis in "xy"] == [0.0, 0.0]


LINKED = "rollers, links, gears, shafts, frame"  # all that needs the links


@pytest.mark.sampled(4)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize(
    ("name", "key", "value", "why", "missing", "parts"),
    [
        ("epicyclic-z4", "gear_bolt_circle_mm", 300.0, "no blank of the fixed gear", LINKED, 2),
        ("epicyclic-z4", "link_bore_mm", 30.0, "no plate is left around the holes", LINKED, 2),
        ("press-straight", "arm_hub_mm", 3.0, "the hub must be above 40", "arm", 7),
    ],
)
def test_what_cannot_be_built_is_listed_with_the_reason(name, key, value, why, missing, parts):
    """And the check of the parts fails for that reason: ``profile`` does not draw the machine."""
    design = load(next(str(path) for path in DESIGNS if path.stem == name))
    design = Design.of(design.spec.with_(f"size.{key}", value))
    rows = design.part_table("parts").to_rows()
    unbuilt = [row for row in rows if row["row"] == "missing"]
    assert unbuilt[0]["name"] == missing
    assert all(why in row["why"] for row in unbuilt)
    assert sum(row["row"] == "part" for row in rows) == parts
    assert any(why in c.why for c in design.checks if c.passes is False)
    with pytest.raises(GenevaError, match=why):
        design.drawing("assembly")
