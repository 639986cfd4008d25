"""Read every design's STEP files with a CAD kernel, OpenCASCADE: `tests/stress/solids_in_cad.py`.

Each solid must be valid and closed, with the name, colour, volume, centroid and inertia of its
closed form. An assembly's parts must be at the places of the drawing, and share no space but that
of press fits. `--set KEY=VALUE` changes all designs. `make cad`
runs it, some minutes, and installs the kernel (0.5 GB).
"""

import argparse
import math
import os
import sys
import tempfile
from itertools import combinations
from pathlib import Path

import numpy as np
import repo
from OCP.Bnd import Bnd_Box
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.collections import Sequence_TDF_Label
from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt
from OCP.GProp import GProp_GProps
from OCP.Quantity import Quantity_Color
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Plate, mass_properties
from geneva_cli.geometry.shapes import Contour, Cubic, bounds
from geneva_cli.output.inks import INKS
from geneva_cli.output.step import chunks

PARTS = ("wheel", "crank", "arm", "assembly")
STEPS = 1e-13  # relative accuracy requested from the kernel
SAME = 1e-12  # relative: the kernel integrates over faces by Gauss's points, to rounding
# The same of shells: on a sphere whose poles are elsewhere the kernel fits curves of its own to a
# face's edges, some 1e-5 mm off; with a pole in its middle a cap comes to 1e-13.
NEARLY = 1e-5
# Along splines the kernel makes its steps finer until the volume is known; where that comes early,
# as in a cam's ring, centroid and inertia are 1e-8 off. Of the same parts in arcs they are exact.
SPLINED = 1e-7


def placed(part, at=(0.0, 0.0, 0.0), turn=((1, 0, 0), (0, 1, 0), (0, 0, 1))):
    """Each solid with the place of its origin, and the matrix of its rotation there."""
    at, turn = np.array(at), np.array(turn)
    if not isinstance(part, Group):
        yield part, at, turn
        return
    for member in part.members:
        c, s = math.cos(member.turn), math.sin(member.turn)
        own = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
        if member.frame:
            own = np.column_stack(member.frame)
        yield from placed(member.part, at + turn @ (*member.at, 0.0), turn @ own)


def read(path):
    """Solids in a file, each with its name and colour and at its place."""
    document = TDocStd_Document(TCollection_ExtendedString("step"))
    reader = STEPCAFControl_Reader()
    reader.SetColorMode(True)
    reader.SetNameMode(True)
    reader.ReadFile(str(path))
    assert reader.Transfer(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    free = Sequence_TDF_Label()
    shapes.GetFreeShapes(free)
    assert free.Length() == 1
    return list(solids(shapes, colours, free.Value(1), TopLoc_Location()))


def solids(shapes, colours, label, location):
    if shapes.IsAssembly_s(label):
        members = Sequence_TDF_Label()
        shapes.GetComponents_s(label, members)
        for i in range(1, members.Length() + 1):
            member, whole = members.Value(i), TDF_Label()
            assert shapes.GetReferredShape_s(member, whole)
            at = location.Multiplied(shapes.GetLocation_s(member))
            yield from solids(shapes, colours, whole, at)
        return
    shape = shapes.GetShape_s(label)
    found = TopExp_Explorer(shape, TopAbs_SOLID)
    body = found.Current()
    found.Next()
    assert not found.More(), "a product is one solid"
    colour = Quantity_Color()
    assert any(
        colours.GetColor(shape if whole else body, XCAFDoc_ColorType.XCAFDoc_ColorSurf, colour)
        for whole in (True, False)
    )
    yield name_of(label), colour, body.Moved(location)


def name_of(label):
    name = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), name)
    return name.Get().ToExtString()


def differs(one, at, turn, name, colour, body):
    """Relative errors of volume, centroid and inertia; raises if name, colour or shape is wrong."""
    assert name == one.name, name
    srgb = "#" + "".join(
        f"{round(255 * _srgb(c)):02x}" for c in (colour.Red(), colour.Green(), colour.Blue())
    )
    assert srgb == INKS[one.layer].rgb, srgb
    assert BRepCheck_Analyzer(body).IsValid()
    found = GProp_GProps()
    # in steps, as the quick integral runs across a spline's knots, and is 1e-4 off
    BRepGProp.VolumeProperties_s(body, found, STEPS, False)
    volume, own, polar, reach = properties(one)
    centre, off = found.CentreOfMass(), 0.0
    if own is not None:
        off = math.dist((centre.X(), centre.Y(), centre.Z()), at + turn @ own)
    axis = gp_Ax1(gp_Pnt(*at.tolist()), gp_Dir(*turn[:, 2].tolist()))
    return (
        abs(found.Mass() / volume - 1.0),
        off / (reach + math.hypot(*at)),
        abs(found.MomentOfInertia(axis) / polar - 1.0),
    )


def properties(one):
    """Volume, centroid and polar moment of a solid in its own frame, and its reach.

    The inertia of a shell, about an axis through the centre, shows where it is too.
    """
    if not isinstance(one, Plate):
        return one.volume, None, one.inertia, one.outer
    body = mass_properties([one], 1e9)  # mm³ and, by 1e6, mm⁵
    centre = (*body.centroid_mm, 0.5 * (one.low + one.high))
    reach = max(map(abs, (*bounds(one.outline), one.low, one.high)))
    return body.mass_kg, centre, 1e6 * body.inertia_kgm2, reach


def _srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def overlaps(found, pressed):
    """Pairs of solids that share more than 0.01 mm³; ``pressed`` pins may share it with any."""
    boxes = []
    for _, _, body in found:
        box = Bnd_Box()
        BRepBndLib.AddOptimal_s(body, box, False, False)
        boxes.append([(c.X(), c.Y(), c.Z()) for c in (box.CornerMin(), box.CornerMax())])
    for (one, (low, high)), (other, (least, most)) in combinations(
        zip(found, boxes, strict=True), 2
    ):
        depth = min(min(high[k], most[k]) - max(low[k], least[k]) for k in range(3))
        if depth < 1e-3 or (pressed and "pin" in (one[0], other[0])):
            continue
        both = GProp_GProps()
        BRepGProp.VolumeProperties_s(BRepAlgoAPI_Common(one[2], other[2]).Shape(), both)
        if both.Mass() > 0.01:
            yield f"{one[0]} and {other[0]} share {both.Mass():.3g} mm³"


def carries(built):
    """True if an arm that carries rollers on pins is drawn: gears have none, a sphere's is not."""
    return getattr(built, "arm", None) is not None and not hasattr(built, "ball")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", nargs="*")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    options = parser.parse_args()
    paths = options.designs or sorted(map(str, (repo.ROOT / "designs").glob("*.toml")))
    bad = 0
    for path in paths:
        name = Path(path).stem
        try:
            design = load(path, options.set)
            parts = design.parts.built
        except GenevaError as error:
            print(f"{name:24} {str(error).partition(': ')[2][:70]}")
            continue
        for part in PARTS:
            if part == "arm" and not carries(parts):
                continue
            for curves in ("arcs", "spline"):
                bad += not one(design, name, part, curves)
    return 1 if bad else 0


def one(design, name, part, curves):
    drawing = design.drawing(part, 0.001, curves)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.step"
        path.write_text("".join(chunks(drawing)), encoding="ascii")
        found, size = read(path), os.path.getsize(path)
    wanted = list(placed(drawing.shells or drawing.solid))
    assert len(found) == len(wanted)
    worst = [
        max(errors)
        for errors in zip(
            *(differs(*plate, *body) for plate, body in zip(wanted, found, strict=True)),
            strict=True,
        )
    ]
    splined = curves == "spline" or any(has_cubics(plate) for plate, *_ in wanted)
    beside = SPLINED if splined else SAME  # of centroid and inertia
    limits = 3 * (NEARLY,) if drawing.shells else (SAME, beside, beside)
    good = all(error < limit for error, limit in zip(worst, limits, strict=True))
    if part == "assembly" and curves == "arcs":
        for text in overlaps(found, design.spec.size.allowances.press_fit_mm > 0.0):
            print(f"{name:24} {text}")
            good = False
    numbers = "  ".join(f"{error:.1e}" for error in worst)
    print(
        f"{name:24} {part:8} {curves:6} {len(found):3} solids {size / 1000:6.1f} kB  {numbers}"
        f"{'' if good else '  BAD'}",
        flush=True,
    )
    return good


def has_cubics(plate):
    """True if cubics bound a plate, as they do gears' pitch curves, whatever the slots are."""
    outline = plate.outline if isinstance(plate, Plate) else None
    return isinstance(outline, Contour) and any(isinstance(p, Cubic) for p in outline.segments)


if __name__ == "__main__":
    sys.exit(main())
