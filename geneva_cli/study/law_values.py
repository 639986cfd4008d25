"""The characteristic values C_v, C_a, C_j and C_p of motion laws, and their factors Am, Vm, Qm."""

import math

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.motion.given_motion import LawMotion
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.peaks import QUANTITIES
from geneva_cli.motion.timing import CamFactors
from geneva_cli.spec.schema import REQUIRED, fields
from geneva_cli.table import Reading, Table, rows_table

LAW_COLUMNS = ("law", "C_v", "C_a", "C_j", "C_p", *CamFactors._fields, "about")


def characteristic(law: Law) -> dict[str, float]:
    """The characteristic values of one law, from the search for a machine's peaks.

    They are the greatest sizes of ds/du, d²s/du², d³s/du³, and of ds/du times d²s/du².
    """
    # A step of 1 in a motion of 1 radian: the invariants are then the law's own derivatives.
    half = math.degrees(0.5)
    motion = LawMotion(-half, half, 0.5, law)
    # a single law has all peaks
    return {name: peak.max for name in QUANTITIES if (peak := motion.closed_peak(name))}


def laws_table(shape: float) -> Table:
    """One row for each law; ``shape`` is the sine group's lambda. Raises GenevaError beyond 10."""
    if not abs(shape) <= 10.0:
        raise GenevaError(f"--lambda {shape:g}: must be at least -10, at most 10")
    rows: list[tuple[object, ...]] = []
    for name in registry.LAWS:
        kind = registry.law(name)
        keys = fields(kind)
        if any(key.default is REQUIRED for key in keys):  # a user's own law has no values yet
            rows.append((name, *[None] * (len(LAW_COLUMNS) - 2), kind.ABOUT))
            continue
        arguments = {key.attribute: shape for key in keys if key.key == "lambda"}
        v, a, j, p = characteristic(kind(**arguments)).values()
        # Am, Vm and Qm, as a law's own step and time are 1
        rows.append((name, v, a, j, p, a, v, p / a, kind.ABOUT))
    # a narrow window keeps these columns first; the others follow in order
    return rows_table(LAW_COLUMNS, rows).replaced(reading=Reading(("law", "about")))
