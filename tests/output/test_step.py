"""STEP files, read back by ``step_witness``: closed, the way round, as large as their outlines.

`tests/stress/solids_in_cad.py` has a CAD kernel read them.
"""

import math

import pytest
import repo
from step_witness import File, Solid, references

from geneva_cli import Design, External
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Plate, moments
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, backwards, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.inks import INKS
from geneva_cli.output.step import chunks
from geneva_cli.output.step.entities import real, words

# Relative. Coordinates have 12 decimals: of parts of 100 mm, 14 digits, and sums of areas lose one.
VOLUME = 1e-12
NEAR = 1e-10  # mm: of a flat arc's centre, 1e5 mm off, a double holds 1.5e-11
SQUARE = closed(
    "WHEEL",
    [
        Line((0.0, 0.0), (40.0, 0.0)),
        Arc((40.0, 0.0), (40.0, 30.0), 0.4),
        Cubic((40.0, 30.0), (30.0, 36.0), (10.0, 18.0), (0.0, 30.0)),
        Arc((0.0, 30.0), (0.0, 0.0), -0.2),
    ],
)
HOLES = (
    Circle("BORE", (20.0, 15.0), 4.0),
    closed("WHEEL", [Arc((8.0, 10.0), (12.0, 10.0), 1.0), Arc((12.0, 10.0), (8.0, 10.0), 0.5)]),
)


def text(part, title=""):
    return "".join(chunks(Drawing(title, (), solid=part)))


def plates(part):
    """Plates that differ, in the order in which they are first met."""
    if isinstance(part, Plate):
        return [part]
    found = [plate for member in part.members for plate in plates(member.part)]
    return list(dict.fromkeys(found))


def require_solid(file, number, plate):
    """Closed, with a handle for each hole, and as large as the outline less its holes."""
    solid = Solid(file, number)
    assert solid.euler == 2 * (1 - len(plate.holes))
    face = abs(moments(plate.outline).area) - sum(abs(moments(hole).area) for hole in plate.holes)
    for volume in solid.volumes():
        assert volume == pytest.approx(face * (plate.high - plate.low), rel=VOLUME)
    assert solid.off < NEAR


@pytest.mark.parametrize("turn", [False, True])
@pytest.mark.parametrize("holes", [(), HOLES[:1], HOLES])
@pytest.mark.parametrize(("low", "high"), [(0.0, 12.0), (-3.5, 0.25)])
def test_any_outline_is_a_closed_solid(turn, holes, low, high):
    """Whichever way the contours run."""
    outline = backwards(SQUARE) if turn else SQUARE
    holes = [backwards(h) if turn and isinstance(h, Contour) else h for h in holes]
    plate = Plate("plate", "WHEEL", outline, tuple(holes), low, high)
    file = File(text(plate))
    (body,) = file.all("MANIFOLD_SOLID_BREP")
    require_solid(file, body, plate)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("curves", ["arcs", "spline"])
@pytest.mark.parametrize("name", ["turret", "internal-z6", "press-curved", "two-pins-z4"])
def test_machines(name, curves):
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    for part in ("wheel", "crank", "arm", "assembly"):
        drawing = design.drawing(part, 0.01, curves)
        file = File("".join(chunks(drawing)))
        bodies, wanted = file.all("MANIFOLD_SOLID_BREP"), plates(drawing.solid)
        assert len(bodies) == len(wanted)
        for body, plate in zip(bodies, wanted, strict=True):
            require_solid(file, body, plate)


def tree(file):
    """An assembly as the file has it: who uses whom, under what name and where."""
    shapes = {}
    for number in file.all("SHAPE_DEFINITION_REPRESENTATION"):
        defined, shape = file.values(number)
        shapes[shape] = file.values(defined)[2]
    names = {}
    for number in file.all("PRODUCT_DEFINITION"):
        formation = file.values(number)[2]
        names[number] = file.values(file.values(formation)[2])[0]
    out = []
    for number in file.all("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"):
        related, used = file.values(number)
        parts = dict(file.of[related][1])
        part, whole = parts["REPRESENTATION_RELATIONSHIP"][2:]
        (moved,) = parts["REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION"]
        use = file.values(used)[2]
        _, name, _, user, one, _ = file.values(use, "NEXT_ASSEMBLY_USAGE_OCCURRENCE")
        assert (shapes[part], shapes[whole]) == (one, user)
        start, end = file.values(moved)[2:]
        assert file.frame(start) == ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
        assert end in file.values(whole)[1]  # the place is one of the assembly's own items
        origin, axis, ahead = file.frame(end)
        assert axis == (0.0, 0.0, 1.0)
        out.append((names[user], name, origin[:2], math.atan2(ahead[1], ahead[0])))
    return out


def test_the_machine_is_an_assembly_at_input_angle_0():
    design = Design(External(6), title="Machine")
    file = File("".join(chunks(design.drawing("assembly"))))
    found = {name: (user, at, turn) for user, name, at, turn in tree(file)}
    assert found["wheel"] == ("Machine", (0.0, 0.0), 0.0)
    # the crank is in its own frame, its roller ahead: that points at the wheel's axis
    user, at, turn = found["crank"]
    assert (user, at, abs(turn)) == ("Machine", (100.0, 0.0), pytest.approx(math.pi, abs=1e-15))
    assert found["locking disc"] == ("crank", (0.0, 0.0), 0.0)
    assert found["roller"] == ("crank", (pytest.approx(50.0), 0.0), 0.0)


def test_like_parts_are_one_product():
    design = load(str(repo.DESIGNS / "three-rollers-z4.toml"))
    file = File("".join(chunks(design.drawing("crank"))))
    assert len(file.all("PRODUCT")) == 4  # crank, disc, roller, pin
    uses = [name for _, name, _, _ in tree(file)]
    assert sorted(uses) == ["locking disc", *["pin"] * 3, *["roller"] * 3]


def test_colours():
    file = File("".join(chunks(Design(External(6)).drawing("assembly"))))
    styled = [file.values(number) for number in file.all("STYLED_ITEM")]
    assert [body for _, _, body in styled] == file.all("MANIFOLD_SOLID_BREP")
    found = []
    for _, rest, _ in styled:
        while not (colours := [v for v in rest if file.of[v][0] == "COLOUR_RGB"]):
            rest = [n for v in rest for n in references(file.values(v))]
        found.append("#" + "".join(f"{round(255 * c):02x}" for c in file.values(colours[0])[1:]))
    layers = ("WHEEL", "CRANK", "ARM", "ROLLER", "ROLLER", "SHAFT", "SHAFT", "FRAME")
    assert found == [INKS[layer].rgb for layer in layers]


def test_titles_in_any_script():
    title = "Tür 'a' \\ Ω 😀"
    part = Group(title, (Member(Plate("p", "CRANK", HOLES[0], (), 0.0, 1.0)),))
    written = text(part, title)
    assert written.isascii()
    assert "'T\\X2\\00FC\\X0\\r ''a'' \\\\ \\X2\\03A9\\X0\\ \\X4\\0001F600\\X0\\'" in written
    assert words("a") == "'a'"
    assert [real(x) for x in (-1e-17, 1.0, 1e-7)] == ["0.", "1.", "0.0000001"]


@pytest.mark.parametrize(
    ("drawing", "said"),
    [
        (Drawing("", (SQUARE,)), "no solid"),
        (Drawing("", (), solid=Plate("p", "CRANK", SQUARE, (), 1.0, 1.0)), "must be thicker"),
    ],
)
def test_refused(drawing, said):
    with pytest.raises(GenevaError, match=said):
        list(chunks(drawing))
