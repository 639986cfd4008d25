"""Clearances for ways to make the parts, selected by ``[size] process``.

Each is the least that two parts need if they are as accurate as the source says. The fit coupon
shows if a particular machine does better. The gap between wheel and arm is as thick as a shim ring
of DIN 988, which fills it.
"""

from __future__ import annotations

from typing import NamedTuple


class Allowances(NamedTuple):
    """Clearances by the keys of ``[size]``, mm, and their source.

    Each is the amount by which a part is larger than its mate.
    """

    slot_clearance_mm: float = 0.0  # per side
    lock_clearance_mm: float = 0.0  # per side
    press_fit_mm: float = 0.0  # difference of diameters, pin minus hole
    shaft_fit_mm: float = 0.0  # difference of diameters, bore minus shaft or pin in it
    pin_gap_mm: float = 0.0  # along the axis, between wheel and crank arm
    source: str | None = None
    gear_backlash_mm: float = 0.0  # of teeth; twice the clearance a side of roller and slot

    @property
    def around_shaft_mm(self) -> float:
        """Clearance per side between a bore and its shaft, mm."""
        return 0.5 * self.shaft_fit_mm


PROCESSES = {
    # its clearances follow the plates' thicknesses: ``Size.allowances``
    "laser": Allowances(
        pin_gap_mm=0.5, source="ISO 9013:2017, class 1, at the thickness of each plate"
    ),
    # It keeps the fits of a sheet. All sizes stay nominal, for which there are reamers and bars.
    # A roller g6 in its slot H7 has 6 to 35 um at 10 to 18 mm, and so have teeth: the middle.
    "mill": Allowances(
        pin_gap_mm=0.2,
        source="the fits of ISO 286 on the drawing sheet",
        gear_backlash_mm=0.02,
    ),
    # A hole is printed slightly too narrow, and holds its pin without a press fit. A printed shaft
    # and its bore may both be off by 0.2 mm.
    "print": Allowances(
        0.25,
        0.25,
        0.0,
        0.4,
        0.3,
        "design guides for fused filament, ±0.2 mm: 0.2 to 0.3 mm a side where parts slide "
        "(printparams.com/docs/real-world-fit)",
    ),
}
