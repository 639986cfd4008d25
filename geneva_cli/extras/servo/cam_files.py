"""Electronic cams as controllers read them.

Sources: CODESYS SoftMotion, library SM3_Basic, MC_CAM_REF and SMC_CAMXYVA; Beckhoff TwinCAT CNC,
cam tables in ASCII, with master and slave in steps of 1e-4 degrees.
"""

from __future__ import annotations

from collections.abc import Iterator
from decimal import ROUND_CEILING, Context

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut
from geneva_cli.extras.servo.electronic_cam import CamPoints, cam_pairs, cam_pieces, cam_points
from geneva_cli.motion.motion_table import periods
from geneva_cli.output.formats import CONTROLLERS
from geneva_cli.table import Table

TOLERANCE_MIN_DEG = 1e-12  # an angle of 360 degrees is rounded by up to 3e-14, a sum by some more

# Why a controller's cam may not meet a tolerance.
LIMITED = {
    "polynomial": "its shortest pieces are 0.001 degrees long",
    "codesys": "a jump becomes a ramp over 0.01 degrees, so --for polynomial is nearer",
    "beckhoff": "its table has 360 pairs in steps of 0.0001 degrees at most",
}


def codesys(cam: CamPoints, title: str) -> Iterator[str]:
    """A declaration in structured text: polynomials of degree five between points."""
    count, end = len(cam.master_deg), float(cam.master_deg[-1])
    yield f"(* {_plain(title)} *)\n"
    yield f"(* greatest error {rounded_up(cam.error_deg)} degrees of the slave *)\n"
    yield "(* before MC_CamTableSelect: cam.pce := ADR(points); *)\n"
    yield "VAR\n"
    yield "  cam : MC_CAM_REF := (byType := 3, "
    yield f"xStart := 0.0, xEnd := {end!r}, nElements := {count});\n"
    yield f"  points : ARRAY[1..{count}] OF SMC_CAMXYVA := [\n"
    columns = (column + 0.0 for column in cam[:4])  # without a minus before 0
    for i, row in enumerate(zip(*(column.tolist() for column in columns), strict=True), 1):
        x, y, v, a = row
        comma = "," if i < count else ""
        yield f"    (dX := {x!r}, dY := {y!r}, dV := {v!r}, dA := {a!r}){comma}\n"
    yield "  ];\nEND_VAR\n"


def beckhoff(cam: CamPoints, title: str) -> Iterator[str]:
    """A table of pairs in ASCII, between which a straight line is drawn."""
    yield f"Tablename = geneva # {_plain(title)}\n"
    yield "Table-ID = 1 # any number that is free\n"
    yield "Tabletype = 7 # pairs of whole numbers, 1e-4 degrees\n"
    yield f"Functiontype = 1 # linear; greatest error {rounded_up(cam.error_deg)} degrees\n"
    yield f"Lines = {len(cam.master_deg)}\n"
    yield "Begintable\n"
    for master, slave in zip(cam.master_deg.tolist(), cam.slave_deg.tolist(), strict=True):
        yield f"{round(1e4 * master)} {round(1e4 * slave)}\n"
    yield "EndTable\n"


def rounded_up(error_deg: float) -> str:
    """An error in two digits, never less than it is.

    >>> rounded_up(1.131e-3)
    '0.0012'
    """
    return f"{float(Context(2, ROUND_CEILING).create_decimal(repr(error_deg))):.2g}"


def _plain(title: str) -> str:
    """A title that ends no comment, in letters that every controller reads."""
    plain = title.encode("ascii", "replace").decode().replace("*", "")
    return " ".join(plain.split())


def cam(
    design: Design, controller: str, turns: int | None, tolerance_deg: float
) -> tuple[Table | str, int, float]:
    """The cam of a controller as a table or a text, the number of its rows, and its error, degrees.

    Without ``turns`` it covers a period. Raises GenevaError for an unknown controller, for turns
    that are no whole periods, and where a controller has no room for the cam.

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
        table = cam_pieces(mechanism, count, tolerance_deg)
        return table, len(table), float(max(table.to_dict()["error_deg"]))
    if controller == "codesys":
        points = cam_points(mechanism, count, tolerance_deg)
        text = codesys(points, design.spec.title)
    else:
        if count * mechanism.period_deg > 360.0 + 1e-9:
            raise GenevaError(
                "--for beckhoff: its table covers one turn of the input, and this cam is of "
                f"{count * mechanism.period_deg / 360.0:.6g}; take --for codesys"
            )
        points = cam_pairs(mechanism, count, tolerance_deg)
        text = beckhoff(points, design.spec.title)
    return "".join(text), len(points.master_deg), points.error_deg


def words(
    controller: str, rows: int, error_deg: float, tolerance_deg: float | None
) -> tuple[str, bool]:
    """A cam's rows and error in words, and True if it meets a tolerance that was given."""
    text = f"{rows} rows, greatest error {rounded_up(error_deg)} degrees of the wheel"
    if tolerance_deg is None or error_deg <= tolerance_deg:
        return text, True
    return f"{text}, more than --tolerance {tolerance_deg:g}: {LIMITED[controller]}", False
