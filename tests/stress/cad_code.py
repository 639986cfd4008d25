"""Run the code of the manual's page cad: `tests/stress/cad_code.py`; `make cad` installs
build123d for it.

Solids of build123d must have the volumes of their closed forms, and the lengths of their arcs and
lines those of the drawing: the kernel joins arcs of one circle.
"""

import math
import os
import re
import shutil
import sys
import tempfile
from collections import Counter

import repo
from build123d import GeomType, import_step

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import face, plates
from geneva_cli.geometry.shapes import Arc, Circle, Line
from geneva_cli.manual import page

SAME = 1e-12  # relative: the kernel integrates along these curves to rounding
DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))


def code():
    """The page's blocks of Python: the functions, the code that uses them, and the macro."""
    return re.findall(r"^```python\n(.*?)^```$", page("cad"), re.S | re.M)


def lengths(plate):
    """The length of a plate's straight lines and of its arcs, mm."""
    straight = round_ = 0.0
    for shape in (plate.outline, *plate.holes):
        if isinstance(shape, Circle):
            round_ += math.tau * shape.radius
            continue
        straight += sum(math.dist(*p) for p in shape.segments if isinstance(p, Line))
        round_ += sum(p.radius * abs(p.sweep) for p in shape.segments if isinstance(p, Arc))
    return {GeomType.LINE: straight, GeomType.CIRCLE: round_}


def of_build123d(functions):
    """Check the solids of every flat part of every design; print the greatest error of a volume."""
    checked, worst, edges = 0, 0.0, Counter()
    for path in DESIGNS:
        design = load(str(path))
        for name in ("wheel", "arm", "frame"):
            try:
                own = plates(design.drawing(name, curves="spline").solid)
            except GenevaError:
                continue  # no such part
            for plate, solid in zip(own, functions["part"](str(path), name), strict=True):
                volume = plate.thickness * face(plate).area
                error = abs(solid.volume / volume - 1.0)
                low = [e for e in solid.edges() if abs(e.center().Z - plate.low) < 1e-6]
                edges += Counter(e.geom_type for e in low)
                assert solid.is_valid and error < SAME, (path.stem, name, error)
                for kind, length in lengths(plate).items():
                    total = sum(e.length for e in low if e.geom_type == kind)
                    assert abs(total - length) < SAME * (length + 1.0), (path.stem, name, kind)
                checked, worst = checked + 1, max(worst, error)
    counts = ", ".join(f"{n} {kind.name}" for kind, n in edges.items())
    print(f"build123d: {checked} solids, volumes within {worst:.1e}; {counts}")


def page_goes_on(functions, goes_on):
    """Check the page's example: its file has one more hole."""
    exec(goes_on, functions)
    wheel, lighter = functions["wheel"], import_step("lighter.step")
    hole = wheel.volume - lighter.volume
    # a difference of two volumes has the rounding of the whole wheel's
    assert abs(hole - math.pi * 15.0**2 * 18.0) < SAME * wheel.volume, hole
    print(f"the page's example: {hole:.3f} mm³ less")


def main():
    functions = {}
    definitions, goes_on, _ = code()
    exec(definitions, functions)
    of_build123d(functions)
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(repo.DESIGNS / "turret.toml", folder)
        os.chdir(folder)
        page_goes_on(functions, goes_on)


if __name__ == "__main__":
    sys.exit(main())
