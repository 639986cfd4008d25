"""The law ``table``: a motion law that a user gives as a CSV of u,s points.

A quintic spline through every point, four times continuously differentiable; its four free
conditions put velocity and acceleration to zero at both ends (SciPy, make_interp_spline).
"""

from __future__ import annotations

import math
import re
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet
from geneva_cli.keys import Spec
from geneva_cli.laws import Law

POINTS_MIN, POINTS_MAX = 6, 100_000
S_MAX = 10.0  # a law runs from 0 to 1; past ten times that it is a mistake
STEP_MIN = 1e-6  # of u: closer points make a spline of rounding errors
BYTES_MAX = 1 << 24
_WHERE = ("motion", "file")


def read_law(spec: Spec) -> Law:
    """The law in the file that ``[motion] file`` names, relative to the spec.

    Raises GenevaError naming the file and the line.
    """
    name = spec.motion.file
    if not name:
        raise GenevaError('the law "table" needs file = "points.csv", lines of u,s', _WHERE)
    path = spec.law_file
    points = _points(path, _text(path))
    u, s = [p[0] for p in points], [p[1] for p in points]
    from scipy.interpolate import make_interp_spline

    flat = [(1, 0.0), (2, 0.0)]
    spline = make_interp_spline(u, s, k=5, bc_type=(flat, flat))
    return _law(spline)


def _law(spline: Any) -> Law:
    branches = [spline, *[spline.derivative(k) for k in range(1, 6)]]

    def first(u: Coefficient, order: int) -> Jet:
        return Jet([_value(branches[k], u) / math.factorial(k) for k in range(order + 1)])

    def second(w: Coefficient, order: int) -> Jet:
        # 1 - s(1 - w): even derivatives change sign
        c = first(1.0 - w, order).c
        return Jet([1.0 - c[0], *[x if k % 2 else -x for k, x in enumerate(c) if k]])

    # The knots, where the fifth derivative jumps, are no breaks up to the fourth.
    return Law("table", first, second, (), "a spline through the points of a CSV file")


def _value(spline: Any, u: Coefficient) -> Coefficient:
    value = spline(u)
    return float(value) if isinstance(u, float) else value


def _text(path: str) -> str:
    try:
        with open(path, "rb") as file:
            data = file.read(BYTES_MAX + 1)
    except OSError as error:
        raise GenevaError(
            f"cannot read the law's points in {path}: {error.strerror}", _WHERE
        ) from None
    if len(data) > BYTES_MAX:
        raise GenevaError(f"{path}: larger than {BYTES_MAX} bytes; thin the points out")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise GenevaError(f"{path}: not UTF-8 text; save the file as UTF-8") from None


def _points(path: str, text: str) -> list[tuple[float, float]]:
    points: list[tuple[float, float]] = []
    for number, line in enumerate(text.split("\n"), 1):
        row = [re.sub(r'^"(.*)"$', r"\1", cell.strip()) for cell in line.split(",")]
        if row == [""] or row[0].startswith("#") or row == ["u", "s"]:
            continue
        try:
            u, s = (float(cell) for cell in row)
        except ValueError:
            raise GenevaError(
                f'{path}:{number}: "{",".join(row)[:60]}" is not two numbers u,s'
            ) from None
        if not (math.isfinite(u) and abs(s) <= S_MAX):
            raise GenevaError(
                f"{path}:{number}: u and s must be finite, s from -{S_MAX:g} to {S_MAX:g}"
            )
        if points and u < points[-1][0] + STEP_MIN:
            raise GenevaError(
                f"{path}:{number}: u = {u:g} must be above the one before it (by {STEP_MIN:g})"
            )
        points.append((u, s))
        if len(points) > POINTS_MAX:
            raise GenevaError(f"{path}:{number}: more than {POINTS_MAX} points; thin them out")
    if len(points) < POINTS_MIN:
        raise GenevaError(f"{path}: {len(points)} points; a law needs at least {POINTS_MIN}")
    if points[0] != (0.0, 0.0) or points[-1] != (1.0, 1.0):
        raise GenevaError(f"{path}: a law runs from 0,0 to 1,1; the first or last point does not")
    return points
