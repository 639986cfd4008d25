"""Ways to make the parts, selected by ``[size] process``: their clearances, and their limits.

Clearances are the least that two parts need if they are as accurate as the source says. The gap
between wheel and arm is as thick as a shim ring of DIN 988. Thermal cuts deviate by ISO 9013:2017,
tolerance class 1, which lasers keep. Turned parts have the fits of ISO 286: H7 is for holes, g6 and
h6 for shafts. A pin is h6: parts on it are P7 if pressed, F7 if they turn.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

# Limit deviations in micrometres, plus and minus, of nominal sizes from 0, 3, 10, 35, 125, 315,
# 1000 and 2000 mm on, by the greatest thickness of the plate, mm (table for class 1). Where the
# standard has none, for a small size in a thick plate, that of the next larger size stands.
# Two shops print it: modulusmetal.com/iso-9013-thermal-cutting-dimensional-tolerances and
# lip-technik.de/Blech-und-Laserschneiden/Toleranzen. Up to 10 mm of plate, the only rows that were
# compared, they differ for sizes of 3 to 10 mm in 3.15 mm: 0.15 and 0.1. The larger stands here.
ISO_9013 = {
    1.0: (75, 100, 100, 200, 200, 300, 400, 650),
    3.15: (100, 150, 200, 250, 250, 350, 400, 650),
    6.3: (200, 200, 250, 250, 300, 400, 450, 700),
    10.0: (250, 250, 300, 300, 350, 450, 550, 750),
    15.0: (300, 300, 350, 400, 450, 550, 650, 850),
    20.0: (400, 400, 400, 450, 550, 750, 850, 1200),
    25.0: (450, 450, 500, 600, 700, 900, 1100, 1600),
    32.0: (700, 700, 700, 700, 800, 1000, 1600, 2250),
    50.0: (700, 700, 700, 700, 800, 1000, 1600, 2500),
    100.0: (1300, 1300, 1300, 1300, 1400, 1700, 2200, 3100),
}


def deviation_mm(thickness_mm: float, nominal_mm: float) -> float:
    """Return the limit deviation of a size that is cut out of a plate, mm; also of arrays.

    Plates above the table's 100 mm, and sizes above its 4000 mm, have those of its end.

    >>> deviation_mm(3.0, 12.0), deviation_mm(18.0, 24.0)
    (0.2, 0.4)
    """
    sizes = [nominal_mm >= least for least in (3.0, 10.0, 35.0, 125.0, 315.0, 1000.0, 2000.0)]
    rows = [_step(row, sizes) for row in ISO_9013.values()]
    # micrometres are whole numbers, whose sums are exact
    return _step(rows, [thickness_mm > most for most in [*ISO_9013][:-1]]) / 1000.0


def _step(values: Sequence[float], passed: Sequence[bool]) -> float:
    """Return the value after the last step that is passed, of one value or of arrays."""
    steps = zip(values, values[1:], passed, strict=False)
    return values[0] + sum((after - before) * step for before, after, step in steps)


class Stock(NamedTuple):
    """A material of parts; by default C45+N (1.0503, normalised), a steel.

    Its least yield strength is 275 MPa, that of pieces of 100 to 250 mm (EN 10083-2); thinner ones
    have more. 0.6 of it is allowed in tension, bending and pressure: twice what the ASME code of
    shafts allows in shear. The code's other bound, 0.36 of the tensile strength of 560 MPa, is
    higher.
    """

    grade: str = "steel"
    youngs_modulus_GPa: float = 210.0
    poisson_ratio: float = 0.3
    density_kgm3: float = 7850.0
    allowed_MPa: float = 165.0  # 0.6 of 275 MPa

    @property
    def name(self) -> str:
        """The grade, or the density of a material without one."""
        return self.grade or f"{self.density_kgm3:g} kg/m³"


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


class Workshop(NamedTuple):
    """What a process can hold. Limits that it does not have are 0 or infinite."""

    tolerances: str  # of dimensions without their own
    fits: bool = True  # whether it holds fits of ISO 286
    slot_play_mm: float = 0.0  # per side, of a roller in a slot of its nominal width, by fits
    deviation_mm: float = 0.0  # of any size, of a process without fits and cuts
    # deviation of a size that it cuts, by thickness and size in mm; None: by fits, or not known
    cut_mm: Callable[[float, float], float] | None = None
    roughness: str = ""
    stock: Stock = Stock()  # of plates: wheel, arm and locking disc
    wall_mm: float = 0.0  # thinnest wall
    hole: float = 0.0  # smallest hole, over the plate's thickness
    plate_mm: float = float("inf")  # thickest plate
    allowances: Allowances = Allowances()


# by the process; without one, usual machining
WORKSHOPS: dict[str | None, Workshop] = {
    None: Workshop("ISO 2768-m"),
    # ISO 9013 is for lasers up to 32 mm. A hole of 0.7 thicknesses is the least that cutters take
    # (acutelaser.com.au/resources/laser-cutting, lasermaster-en.blogspot.com/2022/06); others ask
    # for a whole thickness. Fibre lasers keep its second range of roughness
    # (laserspechub.com/guides/iso-9013-practical-guide).
    "laser": Workshop(
        "ISO 9013 class 1",
        cut_mm=deviation_mm,
        roughness="ISO 9013 range 2",
        hole=0.7,
        plate_mm=32.0,
        # its clearances follow the plates' thicknesses: ``Size.allowances``
        allowances=Allowances(
            pin_gap_mm=0.5, source="ISO 9013:2017, class 1, at the thickness of each plate"
        ),
    ),
    # Milling leaves Ra 0.8 to 6.3 (tables after ASME B46.1): 3.2 is the grade between them. H7/g6
    # of a roller of 18 to 30 mm leaves at most 41 um, over both sides.
    # All sizes stay nominal, for which there are reamers and bars.
    "mill": Workshop(
        "ISO 2768-m",
        roughness="Ra 3.2",
        slot_play_mm=0.02,
        allowances=Allowances(pin_gap_mm=0.2, source="the fits of ISO 286 on the drawing sheet"),
    ),
    # A wall needs two lines of a 0.4 mm nozzle (rigidprints.co.uk/design-guide/wall-thickness);
    # sizes are within 0.2 mm (printparams.com/docs/real-world-fit). PLA has 1.24 g/cm³ (ASTM D792,
    # data sheet of Ingeo 2003D, NatureWorks); parts that are not printed solid are lighter. Across
    # its layers it has 2.4 GPa and breaks at 22.8 MPa (3D Print. Addit. Manuf. 2021,
    # doi 10.1089/3dp.2020.0109); another data sheet has 2.5 GPa and 26 MPa
    # (pro3dcomposites.com/materials/pla). Poisson's ratio: doi 10.1016/j.addr.2016.06.012.
    # It breaks before it yields, so that 0.36 of 22.8 MPa is allowed.
    "print": Workshop(
        "±0.2 mm",
        fits=False,
        deviation_mm=0.2,
        stock=Stock("PLA", 2.4, 0.36, 1240.0, 8.2),
        wall_mm=0.8,
        # A hole is printed slightly too narrow, and holds its pin without a press fit. A printed
        # shaft and its bore may both be off by 0.2 mm.
        allowances=Allowances(
            *(0.25, 0.25, 0.0, 0.4, 0.3),
            "design guides for fused filament, ±0.2 mm: 0.2 to 0.3 mm a side where parts slide "
            "(printparams.com/docs/real-world-fit)",
        ),
    ),
}

# the words for processes
PROCESSES = [*filter(None, WORKSHOPS)]

# ISO 286-1:2010, micrometres for sizes up to a number of mm: grades IT6 and IT7 by its table 1, the
# fundamental deviations g, f and p by its tables 4 and 5; up to 500 mm also IT11, and c for the
# range's larger sizes. g, f and c are below the nominal size, p above it.
# fmt: off
ISO_286 = [
    (3, 6, 10, 2, 6, 6, 60, 60), (6, 8, 12, 4, 10, 12, 75, 70), (10, 9, 15, 5, 13, 15, 90, 80),
    (18, 11, 18, 6, 16, 18, 110, 95), (30, 13, 21, 7, 20, 22, 130, 110),
    (50, 16, 25, 9, 25, 26, 160, 130), (80, 19, 30, 10, 30, 32, 190, 150),
    (120, 22, 35, 12, 36, 37, 220, 180), (180, 25, 40, 14, 43, 43, 250, 230),
    (250, 29, 46, 15, 50, 50, 290, 280), (315, 32, 52, 17, 56, 56, 320, 330),
    (400, 36, 57, 18, 62, 62, 360, 400), (500, 40, 63, 20, 68, 68, 400, 480),
    (630, 44, 70, 22, 76, 78), (800, 50, 80, 24, 80, 88), (1000, 56, 90, 26, 86, 100),
    (1250, 66, 105, 28, 98, 120), (1600, 78, 125, 30, 110, 140), (2000, 92, 150, 32, 120, 170),
    (2500, 110, 175, 34, 130, 195), (3150, 135, 210, 38, 145, 240),
]
# fmt: on


def fit_limits(nominal_mm: float, fit: str) -> tuple[int, int] | None:
    """Return a fit's upper and lower deviation in micrometres; None beyond the standard's sizes.

    >>> fit_limits(20.0, "H7"), fit_limits(20.0, "g6"), fit_limits(20.0, "h6")
    ((21, 0), (-7, -20), (0, -13))
    """
    for most, it6, it7, g, f, p, *loose in ISO_286:
        if not 0.0 < nominal_mm <= most:
            continue
        # up to 500 mm a hole P7 has as much interference as a shaft p6 (ISO 286-1, 4.3.2.5)
        top = -p + (it7 - it6 if 3.0 < nominal_mm <= 500.0 else 0)
        limits = {"H7": (it7, 0), "F7": (f + it7, f), "P7": (top, top - it7)}
        limits |= {"g6": (-g, -g - it6), "h6": (0, -it6)}
        if loose:
            it11, c = loose
            limits |= {"H11": (it11, 0), "c11": (-c, -c - it11)}
        return limits.get(fit)
    return None


def clearance_mm(nominal_mm: float, hole: str, shaft: str) -> float | None:
    """Return the greatest clearance of a fit such as H7/h6, mm of the diameter; or None.

    H11/c11 is ISO 286's loosest preferred fit.
    """
    wide, thin = fit_limits(nominal_mm, hole), fit_limits(nominal_mm, shaft)
    return (wide[0] - thin[1]) / 1000.0 if wide and thin else None
