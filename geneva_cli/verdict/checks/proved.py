"""The certificate of the full turn: a gap that is proved at every input angle."""

from __future__ import annotations

from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.bounds import UNKNOWN
from geneva_cli.parts.turn.pairs import WorkLimit
from geneva_cli.parts.turn.turn_certificate import Certificate, certificate, tolerance_mm
from geneva_cli.verdict.checks.check import Check, compared


def least_gap(name: str, parts: Parts, to_mm: float | None) -> Check | None:
    """The proved lower bound of the gap, mm; None where parts are known to overlap.

    ``to_mm`` is how far below the smallest gap the bound may be, by default ``tolerance_mm``.
    """
    gap = parts.turned.turn.smallest.mm
    if gap < -parts.contact:
        return None
    to_mm = to_mm or tolerance_mm(parts)
    unproved = Check(name, None, "at least", -to_mm, None)
    try:
        found = certificate(parts, gap, to_mm)
    except WorkLimit as error:
        return unproved._replace(why=str(error))
    if found.open:
        start, end, known, _ = found.open
        unproved = unproved._replace(why=_open(found))
        if known < -max(to_mm, parts.contact):
            return unproved._replace(value=known, at_deg=0.5 * (start + end), passes=False)
        return unproved
    why = f"collision-free, proved to {1e3 * to_mm:.3g} µm ({found.intervals:,} intervals)"
    return compared(name, found.least_mm, "at least", -to_mm)._replace(why=why)


def _open(found: Certificate) -> str:
    assert found.open is not None
    start, end, gap, least = found.open
    bound = "no bound is known" if least <= -0.5 * UNKNOWN else f"at least {least:.4g} mm"
    return (
        f"sampled collision check; the proof is open from {start:.9g} to {end:.9g}° between "
        f"{found.between}, after {found.intervals:,} intervals. There the gap is {gap:.4g} mm in "
        f"the middle and {bound} throughout"
    )
