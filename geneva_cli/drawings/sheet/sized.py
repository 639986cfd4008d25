"""Sizes as texts, with the deviation from the spec, or else as the part's workshop keeps it."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.shafts.bores import SCREWS, screw_through
from geneva_cli.spec.workshops import WORKSHOPS, fit_limits
from geneva_cli.table import in_decimals as length


def toleranced(nominal_mm: float, shown: str, fit: str) -> str:
    """Return a size with its fit and the limits in mm.

    >>> toleranced(20.0, "Ø 20", "g6")
    'Ø 20 g6 (-0.007/-0.02)'
    """
    deviations = fit_limits(nominal_mm, fit)
    if deviations is None:
        return shown
    upper, lower = (f"{1e-3 * one:+g}" if one else "0" for one in deviations)
    return f"{shown} {fit} ({upper}/{lower})"


def degrees(angle: float) -> str:
    """Return an angle in radians as degrees."""
    return f"{length(math.degrees(angle))}°"


def plain(value: float, sign: str = "", off: float = 0.0) -> str:
    """Return a size, with a plus-minus deviation ``off`` if it is not 0.

    >>> plain(5.0, "R "), plain(100.0, off=0.02)
    ('R 5', '100 ±0.02')
    """
    shown = f"{sign}{length(value)}"
    return f"{shown} ±{off:g}" if off else shown


class Fits(NamedTuple):
    """Sizes of a part as the workshop of the machine's process makes it.

    ``thickness_mm`` is that of the plate it is cut from; None for a part that is turned.
    """

    spec: Spec
    thickness_mm: float | None = None

    @property
    def is_iso(self) -> bool:
        """True if the part has fits of ISO 286."""
        shop = WORKSHOPS[self.spec.size.process]
        return shop.fits and (self.thickness_mm is None or shop.cut_mm is None)

    @property
    def turned(self) -> Fits:
        """The fits of a turned part of the same machine."""
        return self._replace(thickness_mm=None)

    def fitted(self, value: float, fit: str, sign: str = "", off: float = 0.0) -> str:
        """Return a size with its deviation if the spec has one, otherwise as the shop keeps it.

        That is with a fit, with the deviation of a cut, or alone.
        """
        shop, shown = WORKSHOPS[self.spec.size.process], plain(value, sign, off)
        if off:
            return shown
        if self.thickness_mm is not None and shop.cut_mm:
            return f"{shown} ±{shop.cut_mm(self.thickness_mm, value):g}"
        return toleranced(value, shown, fit) if shop.fits else shown

    def made(self, what: str, half: float) -> str:
        """Return the width or the diameter, twice ``half``, of what works in the machine.

        ``what`` is slot, roller, lock, recess, "roller bore" or "pin hole". Fits have play where
        the spec has no clearance. No cut holds a press fit: by default it leaves a pin's hole that
        is never wider than the pin, to ream.
        """
        size, off = self.spec.size, self.spec.tolerance
        clear = size.allowances
        fit, deviation = {
            "slot": ("H7", off.slot_width_mm),
            "roller": ("h6" if clear.slot_clearance_mm else "g6", off.roller_diameter_mm),
            "lock": ("h6" if clear.lock_clearance_mm else "g6", 2.0 * off.lock_radius_mm),
            "recess": ("H7", 2.0 * off.recess_radius_mm),
            "roller bore": ("H7" if clear.shaft_fit_mm else "F7", 0.0),
            "pin hole": ("H7" if clear.press_fit_mm else "P7", 0.0),
        }[what]
        shown = self.fitted(2.0 * half, fit, "" if what == "slot" else "Ø ", deviation)
        is_pressed = size.press_fit_mm is not None or WORKSHOPS[size.process].cut_mm is None
        if what != "pin hole" or is_pressed:
            return shown
        pin = 2.0 * half + clear.press_fit_mm
        return f"{shown}, drill and ream to {toleranced(pin, plain(pin, 'Ø '), 'P7')}"

    def bore(self, radius: float) -> str:
        """Return the diameter of a bore."""
        return self.fitted(2.0 * radius, "H7", "Ø ")

    def shaft(self, radius: float) -> str:
        """Return the diameter of a shaft that fits a bore, or of a pin in its hole and roller."""
        return self.turned.fitted(2.0 * radius, "h6", "Ø ")


def screw_hole(radius: float, tapped: bool = False) -> str:
    """Return the diameter of a screw's hole with its thread: a clearance hole, or one to tap.

    >>> screw_hole(2.75), screw_hole(2.1, tapped=True), screw_hole(0.5)
    ('Ø 5.5 for M5', 'Ø 4.2, tapped M5', 'Ø 1')
    """
    hole = plain(2.0 * radius, "Ø ")
    screw = screw_through(2.0 * radius)
    if tapped:
        near = ((one, abs(one.thread - one.pitch - 2.0 * radius)) for one in SCREWS)
        screw = next((one for one, off in near if off < SAME_ON_SHEET), None)
    return f"{hole}{', tapped' if tapped else ' for'} M{screw.thread:g}" if screw else hole
