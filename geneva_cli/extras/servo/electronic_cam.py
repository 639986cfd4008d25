"""The motion as an electronic cam: polynomials, or points between which CODESYS interpolates.

The master is the input, in degrees from the first entry; the slave is the wheel, in degrees from
its place there. Each error is that of the controller's own interpolation, evaluated at 33 places of
a piece. One is the middle, where a smooth error of one sign is greatest or nearly so.

Source: CODESYS SoftMotion, library SM3_Basic, MC_CAM_REF and SMC_CAMXYVA.
"""

import math
from collections.abc import Iterator
from decimal import ROUND_CEILING, Context

import numpy as np
from numpy.polynomial.polynomial import polyval

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import Stretch, periods, stretches
from geneva_cli.numerics.jet import Array
from geneva_cli.output import CONTROLLERS
from geneva_cli.table import Table

TOLERANCE_MIN_DEG = 1e-12  # an angle of 360 degrees is rounded by up to 3e-14, a sum by some more
INSIDE = (np.arange(33) + 0.5) / 33.0  # places in a piece, its middle among them
# The greatest error over that at these places. An error of degree six with three zeros at each end
# is 0.3 % more at most, one that also changes its sign in the middle 0.8 %.
BETWEEN = 1.01
RAMP_DEG = 0.01  # length of the ramp that takes a jump's place
UNKNOWN = np.full(3, np.nan)  # state before the first stretch
LEAST_DEG = 1e-3  # shorter pieces are not halved: a servo's cycle is longer


def cam(
    design: Design, controller: str, turns: int | None, tolerance_deg: float
) -> tuple[Table | str, int, float]:
    """The cam of a controller as a table or a text, the number of its rows, and its error, degrees.

    Without ``turns`` it covers a period. Raises GenevaError for an unknown controller, and for
    turns that are no whole periods.

    >>> _, points, error_deg = cam(Design(External(6)), "codesys", None, 1e-4)
    >>> points, error_deg < 1e-4
    (13, True)
    """
    if controller not in CONTROLLERS:
        raise GenevaError(f"--for {cut(controller)}: it must be one of {', '.join(CONTROLLERS)}")
    if not TOLERANCE_MIN_DEG <= tolerance_deg < 360.0:
        raise GenevaError(
            f"--tolerance {tolerance_deg:.6g}: must be at least {TOLERANCE_MIN_DEG:g}, which is "
            "rounding, and below 360 degrees"
        )
    mechanism = design.mechanism
    if not mechanism.output.turns:
        raise GenevaError(
            "--for: an electronic cam has angles, and this machine moves a rack: write its motion "
            "as a table, with --turns"
        )
    count = periods(mechanism, turns)
    if controller == "polynomial":
        table = _pieces(mechanism, count, tolerance_deg)
        return table, len(table), float(max(table.to_dict()["error_deg"]))
    points, error_deg = _points(mechanism, count, tolerance_deg)
    text = "".join(_codesys(points, error_deg, design.spec.title))
    return text, points.shape[1], error_deg


def words(rows: int, error_deg: float, tolerance_deg: float | None) -> tuple[str, bool]:
    """A cam's rows and error in words, and True if it meets a tolerance that was given."""
    text = f"{rows} rows, greatest error {rounded_up(error_deg)} degrees of the wheel"
    is_met = tolerance_deg is None or error_deg <= tolerance_deg
    return text + ("" if is_met else f", more than --tolerance {tolerance_deg:g}"), is_met


def rounded_up(error_deg: float) -> str:
    """An error in two digits, never less than it is.

    >>> rounded_up(1.131e-3)
    '0.0012'
    """
    return f"{float(Context(2, ROUND_CEILING).create_decimal(repr(error_deg))):.2g}"


def _codesys(points: Array, error_deg: float, title: str) -> Iterator[str]:
    """A declaration in structured text: polynomials of degree five between points (4, k)."""
    # a title that ends no comment, in letters that every controller reads
    plain = " ".join(title.encode("ascii", "replace").decode().replace("*", "").split())
    count, end = points.shape[1], float(points[0, -1])
    yield f"(* {plain} *)\n"
    yield f"(* greatest error {rounded_up(error_deg)} degrees of the slave *)\n"
    yield "(* before MC_CamTableSelect: cam.pce := ADR(points); *)\n"
    yield "VAR\n"
    yield "  cam : MC_CAM_REF := (byType := 3, "
    yield f"xStart := 0.0, xEnd := {end!r}, nElements := {count});\n"
    yield f"  points : ARRAY[1..{count}] OF SMC_CAMXYVA := [\n"
    for i, (x, y, v, a) in enumerate((points + 0.0).T.tolist(), 1):  # without a minus before 0
        comma = "," if i < count else ""
        yield f"    (dX := {x!r}, dY := {y!r}, dV := {v!r}, dA := {a!r}){comma}\n"
    yield "  ];\nEND_VAR\n"


def _pieces(mechanism: Mechanism, count: int, tolerance_deg: float) -> Table:
    """Polynomials of the fifth degree over ``count`` periods, a row each.

    Columns: ``begin_deg``, ``end_deg`` of the master; ``c0`` to ``c5``, of which the slave is
    c0 + c1 t + ... + c5 t^5 degrees at t degrees after the beginning; ``error_deg``.

    Source: Hermite interpolation; value, velocity and acceleration are the true ones at both ends.
    """
    rows = [_halved(stretch, tolerance_deg)[0] for stretch in stretches(mechanism)]
    (begins, constants, *others), again = np.hstack(rows), np.arange(count)[:, None]
    begin = (again * mechanism.period_deg + begins).ravel()
    end = np.append(begin[1:], count * mechanism.period_deg)
    constant = (again * _step_deg(mechanism) + constants).ravel()
    names = ("begin_deg", "end_deg", *(f"c{k}" for k in range(6)), "error_deg")
    return Table(names, [begin, end, constant, *(np.tile(one, count) for one in others)])


def _points(mechanism: Mechanism, count: int, tolerance_deg: float) -> tuple[Array, float]:
    """Points between which polynomials of degree five are drawn, (4, k), and their greatest error.

    Rows are master and slave in degrees, velocity, and acceleration a degree. A point has one
    velocity and one acceleration: a jump becomes a ramp after it.
    """
    step = np.array([[mechanism.period_deg], [_step_deg(mechanism)], [0.0], [0.0]])
    each, end, error_deg = list[Array](), UNKNOWN, 0.0
    for _ in range(min(count, 2)):  # a period after another may begin with a jump
        rows = list[Array]()
        for stretch in stretches(mechanism):
            pieces, end = _halved(stretch, tolerance_deg, end)
            rows.append(pieces)
        begin, angle, velocity, half, *_, errors = np.hstack(rows)
        each.append(np.stack([begin, angle, velocity, 2.0 * half]))
        error_deg = max(error_deg, float(errors.max()))
    last = np.append(mechanism.period_deg, end)[:, None] + (count - 1) * step
    return np.hstack([*(each[min(k, 1)] + k * step for k in range(count)), last]), error_deg


def _step_deg(mechanism: Mechanism) -> float:
    """The wheel's angle over one period, degrees."""
    return math.degrees(sum(2.0 * one.half_step for one in mechanism.engagements))


def _halved(stretch: Stretch, tolerance_deg: float, end: Array = UNKNOWN) -> tuple[Array, Array]:
    """The pieces of a stretch, (8, k), and the state (3,) at its end.

    Rows: begin, the powers of the polynomial, and its greatest error. ``end`` is the state before
    the stretch: a jump from there becomes a ramp.
    """
    nodes = np.array([stretch.begin_deg, stretch.end_deg])
    jumps = np.abs(stretch.states(nodes[:1], 1)[1:, 0] - end[1:]).max() > 1e-9
    if jumps:
        nodes = np.insert(nodes, 1, nodes[0] + min(RAMP_DEG, 0.25 * (nodes[1] - nodes[0])))
    while True:
        after, before = stretch.states(nodes[:-1], 1), stretch.states(nodes[1:], -1)
        width = np.diff(nodes)
        wide = width > LEAST_DEG
        if jumps:
            after[1:, 0], wide[0] = end[1:], False
        powers, t = _quintic(width, after, before), width[:, None] * INSIDE
        true = stretch.slave_deg((nodes[:-1, None] + t).ravel()).reshape(t.shape)
        value = polyval(t, powers[:, :, None], tensor=False)
        error = BETWEEN * abs(value - true).max(axis=1)
        wide &= error > tolerance_deg
        if not wide.any():
            return np.vstack([nodes[:-1], powers, error]), before[:, -1]
        nodes = np.sort(np.append(nodes, nodes[:-1][wide] + 0.5 * width[wide]))


def _quintic(width: Array, after: Array, before: Array) -> Array:
    """The powers (6, k) of the polynomials with these values, slopes and curvatures at the ends."""
    y0, v0, a0 = after
    y1, v1, a1 = before
    rise = y1 - y0 - width * (v0 + 0.5 * width * a0)
    slope = width * (v1 - v0 - width * a0)
    bend = width * width * (a1 - a0)
    third = 10.0 * rise - 4.0 * slope + 0.5 * bend
    fourth = -15.0 * rise + 7.0 * slope - bend
    fifth = 6.0 * rise - 3.0 * slope + 0.5 * bend
    return np.stack([y0, v0, 0.5 * a0, third / width**3, fourth / width**4, fifth / width**5])
