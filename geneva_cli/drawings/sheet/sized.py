"""Sizes as texts, with the deviation from the spec, or else as the part's workshop keeps it."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.shafts.fits import Fits, toleranced
from geneva_cli.parts.shafts.screws import SCREWS, screw_through
from geneva_cli.spec.tables import Size
from geneva_cli.spec.workshops import workshop
from geneva_cli.spec.written import deviation, length


def plain(value: float, sign: str = "", off: float = 0.0, fine: bool = False) -> str:
    """Return a size, with a plus-minus deviation ``off`` if it is not 0; ``fine`` in any case.

    >>> plain(5.0, "R "), plain(100.0, off=0.02)
    ('R 5', '100 ±0.02')
    """
    shown = f"{sign}{length(value, fine or off > 0.0)}"
    return f"{shown} ±{deviation(off)}" if off else shown


def fitted(fits: Fits, value: float, sign: str, fit: str, off: float = 0.0) -> str:
    """Return a size with its deviation if the spec has one, otherwise with a fit."""
    shown = plain(value, sign, off, fine=True)
    return shown if off else fits.text(value, shown, fit)


def slot_width(fits: Fits, mechanism: Mechanism, half: float) -> str:
    """Return the slot's width."""
    return fitted(fits, 2.0 * half, "", "H7", mechanism.spec.tolerance.slot_width_mm)


def roller(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the roller's diameter; its fit has play in the slot if the spec has no clearance."""
    spec = mechanism.spec
    fit = "h6" if spec.size.allowances.slot_clearance_mm else "g6"
    return fitted(fits, 2.0 * radius, "Ø ", fit, spec.tolerance.roller_diameter_mm)


def lock(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the locking disc's diameter; its fit has play unless the spec has a clearance."""
    spec = mechanism.spec
    fit = "h6" if spec.size.allowances.lock_clearance_mm else "g6"
    return fitted(fits, 2.0 * radius, "Ø ", fit, 2.0 * spec.tolerance.lock_radius_mm)


def recess(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the diameter of the wheel's recesses."""
    return fitted(fits, 2.0 * radius, "Ø ", "H7", 2.0 * mechanism.spec.tolerance.recess_radius_mm)


def pin_hole(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the diameter of the pin's hole: P7, or H7 if ``press_fit_mm`` makes it smaller.

    No cut holds a press fit. By default it leaves a hole that is never wider than the pin, to ream.
    """
    size = mechanism.spec.size
    smaller = size.allowances.press_fit_mm
    hole = fitted(fits, 2.0 * radius, "Ø ", "H7" if smaller else "P7")
    if size.press_fit_mm is not None or workshop(size.process).cut_mm is None:
        return hole
    pin = 2.0 * radius + smaller
    return f"{hole}, drill and ream to {toleranced(pin, plain(pin, 'Ø ', fine=True), 'P7')}"


def roller_bore(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the diameter of a bore that turns on a pin: F7, or H7 if already wider by a fit."""
    wider = mechanism.spec.size.allowances.shaft_fit_mm
    return fitted(fits, 2.0 * radius, "Ø ", "H7" if wider else "F7")


def bore(fits: Fits, radius: float) -> str:
    """Return the diameter of a bore."""
    return fitted(fits, 2.0 * radius, "Ø ", "H7")


def screw_hole(radius: float, tapped: bool = False) -> str:
    """Return the diameter of a screw's hole with its thread: a clearance hole, or one to tap.

    >>> screw_hole(2.75), screw_hole(2.1, tapped=True), screw_hole(0.5)
    ('Ø 5.5 for M5', 'Ø 4.2, tapped M5', 'Ø 1')
    """
    hole = plain(2.0 * radius, "Ø ")
    if tapped:
        thread = next((s.thread for s in SCREWS if abs(s.core - 2.0 * radius) < SAME_ON_SHEET), 0.0)
        return f"{hole}, tapped M{thread:g}" if thread else hole
    screw = screw_through(2.0 * radius)
    return f"{hole} for M{screw.thread:g}" if screw else hole


def threads(holes: Iterable[Circle]) -> dict[Circle, str]:
    """Return the texts of tapped holes."""
    return {hole: screw_hole(hole.radius, tapped=True) for hole in holes}


def shaft(fits: Fits, radius: float) -> str:
    """Return the diameter of a shaft that fits into a bore, or of a pin in its hole and roller."""
    return fitted(fits.turned, 2.0 * radius, "Ø ", "h6")


def edge_note(size: Size) -> str:
    """Return the note on edges; "" where the spec has none.

    >>> edge_note(Size(edge_chamfer_mm=0.5)), edge_note(Size(edge_fillet_mm=1.0))
    ('chamfered 0.5 × 45°', 'rounded R 1')
    """
    if size.edge_chamfer_mm is not None:
        return f"chamfered {length(size.edge_chamfer_mm)} × 45°"
    rounded = size.edge_fillet_mm
    return "" if rounded is None else f"rounded {plain(rounded, 'R ')}"
