"""Sizes as texts: with the deviation that the spec gives, or else a fit by ISO 286."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.fits import toleranced
from geneva_cli.parts.sheet.view import number


def plain(value: float, sign: str = "", deviation: float = 0.0) -> str:
    """A size, and plus or minus where that is given.

    >>> plain(5.0, "R "), plain(100.0, deviation=0.02)
    ('R 5', '100 ±0.02')
    """
    return f"{sign}{number(value)}" + (f" ±{deviation:g}" if deviation else "")


def fitted(value: float, sign: str, fit: str, deviation: float = 0.0) -> str:
    """A size with a fit; ``deviation``, where the spec gives one, goes before it."""
    shown = plain(value, sign, deviation)
    return shown if deviation else toleranced(value, shown, fit)


def slot_width(mechanism: Mechanism, half: float) -> str:
    """The slot's width."""
    return fitted(2.0 * half, "", "H7", mechanism.spec.tolerance.slot_width_mm)


def roller(mechanism: Mechanism, radius: float) -> str:
    """The roller's diameter: with play in the slot by its fit where the spec gives none."""
    spec = mechanism.spec
    fit = "h6" if spec.size.allowances.slot_clearance_mm else "g6"
    return fitted(2.0 * radius, "Ø ", fit, spec.tolerance.roller_diameter_mm)


def lock(mechanism: Mechanism, radius: float) -> str:
    """The locking disc's diameter, likewise in the wheel's recesses."""
    spec = mechanism.spec
    fit = "h6" if spec.size.allowances.lock_clearance_mm else "g6"
    return fitted(2.0 * radius, "Ø ", fit, 2.0 * spec.tolerance.lock_radius_mm)


def recess(mechanism: Mechanism, radius: float) -> str:
    """The diameter of the wheel's recesses."""
    return fitted(2.0 * radius, "Ø ", "H7", 2.0 * mechanism.spec.tolerance.recess_radius_mm)


def pin(radius: float) -> str:
    """The pin's diameter, the same all along: it is pressed into what is P7, and F7 turns on it."""
    return fitted(2.0 * radius, "Ø ", "h6")


def pin_hole(mechanism: Mechanism, radius: float) -> str:
    """The hole that holds the pin: P7, unless it is drawn smaller by ``press_fit_mm``."""
    smaller = mechanism.spec.size.allowances.press_fit_mm
    return fitted(2.0 * radius, "Ø ", "H7" if smaller else "P7")


def roller_bore(radius: float) -> str:
    """What turns on the pin."""
    return fitted(2.0 * radius, "Ø ", "F7")


def bore(radius: float) -> str:
    """A bore's diameter."""
    return fitted(2.0 * radius, "Ø ", "H7")


def shaft(radius: float) -> str:
    """A shaft's diameter, in such a bore."""
    return fitted(2.0 * radius, "Ø ", "h6")
