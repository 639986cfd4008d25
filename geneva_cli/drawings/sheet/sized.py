"""Sizes as texts, with the deviation from the spec, or else as the part's workshop keeps it."""

from __future__ import annotations

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.parts.written import deviation, length
from geneva_cli.spec.tables import Size


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
    """Return the diameter of the pin's hole: P7, or H7 if ``press_fit_mm`` makes it smaller."""
    smaller = mechanism.spec.size.allowances.press_fit_mm
    return fitted(fits, 2.0 * radius, "Ø ", "H7" if smaller else "P7")


def roller_bore(fits: Fits, mechanism: Mechanism, radius: float) -> str:
    """Return the diameter of a bore that turns on a pin: F7, or H7 if already wider by a fit."""
    wider = mechanism.spec.size.allowances.shaft_fit_mm
    return fitted(fits, 2.0 * radius, "Ø ", "H7" if wider else "F7")


def bore(fits: Fits, radius: float) -> str:
    """Return the diameter of a bore."""
    return fitted(fits, 2.0 * radius, "Ø ", "H7")


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
