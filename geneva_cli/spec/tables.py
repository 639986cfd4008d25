"""The spec's tables and keys: type, default, range and meaning, one line each.

A key that is a Python keyword ends in an underscore here. ``None`` means: derived from the rest.
The annotations are objects, not text that would have to be evaluated when they are read.
"""

from functools import cached_property
from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.spec.processes import PROCESSES, Allowances
from geneva_cli.spec.rules import LENGTH, NOT_NEGATIVE, POSITIVE, OneOf, Range
from geneva_cli.spec.schema import SpecTable

DISTANCE_MM = 100.0  # the centre distance of a spec that gives none
Z_DRAWN = 360  # slots of a wheel that is drawn: one a degree
Z_USUAL = 24  # above it the slots leave little of a wheel: a warning


class Size(SpecTable):
    """``[size]``.

    Lengths in mm, diameters where a key says so. What is left out follows from the rest.

    >>> Design(External(6), size=Size(center_distance_mm=200.0)).mechanism.roller_radius_mm
    10.0
    """

    TABLE: ClassVar[str] = "size"

    center_distance_mm: Annotated[
        float | None,
        POSITIVE,
        "centre distance L (spherical: the sphere's radius), 100; linkages solve for it",
    ] = None
    roller_radius_mm: Annotated[float | None, POSITIVE, "roller radius r; L/20 if not given"] = None
    process: Annotated[
        str | None, OneOf(PROCESSES), "how the parts are made; sets clearances and press fit"
    ] = None
    slot_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "per side, roller to slot; 0, or the process's"
    ] = None
    lock_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "per side, locking disc to wheel; 0, or the process's"
    ] = None
    face_width_mm: Annotated[float | None, POSITIVE, "length of the roller's line of contact"] = (
        None
    )
    wheel_radius_mm: Annotated[
        float | None, POSITIVE, "rim of the wheel (inside: of its opening); where a roller enters"
    ] = None
    wheel_outer_radius_mm: Annotated[
        float | None,
        POSITIVE,
        "internal: the outside of the wheel; a roller's width past the slots",
    ] = None
    slot_bottom_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "straight slots: deepest roller to the slot's end; r/20"
    ] = None
    lock_radius_mm: Annotated[
        float | None,
        NOT_NEGATIVE,
        "locking disc, 0 for none; leaves a horn as thick as r if it can",
    ] = None
    relief: Annotated[
        str | None, OneOf(("arc", "sector")), "cut of the locking disc; what clears"
    ] = None
    relief_clearance_mm: Annotated[
        float | None, NOT_NEGATIVE, "wheel to the bottom of the relief; L/200"
    ] = None
    wall_min_mm: Annotated[
        float | None, NOT_NEGATIVE, "least wall that `check` lets pass; L/200"
    ] = None
    wheel_bore_mm: Annotated[float | None, NOT_NEGATIVE, "diameter of the wheel's bore"] = None
    wheel_hub_mm: Annotated[
        float | None, NOT_NEGATIVE, "diameter of the wheel's hub on the roller's side"
    ] = None
    wheel_hub_length_mm: Annotated[
        float | None, POSITIVE, "length of that hub below the wheel; down to below the crank arm"
    ] = None
    wheel_shaft_low_mm: Annotated[
        float | None, LENGTH, "lower end of the wheel's shaft, from the wheel's lower face; frame's"
    ] = None
    wheel_shaft_high_mm: Annotated[
        float | None, LENGTH, "upper end of the wheel's shaft, from there; the wheel's upper face"
    ] = None
    crank_bore_mm: Annotated[
        float | None,
        NOT_NEGATIVE,
        "diameter of the crank's bore; arm_bore_mm if that is given; 0: the shaft ends below",
    ] = None
    crank_hub_mm: Annotated[
        float | None, NOT_NEGATIVE, "diameter of the crank's hub in the wheel's plane"
    ] = None
    crank_hub_length_mm: Annotated[
        float | None,
        POSITIVE,
        "length of that hub, from the arm up; to the wheel's upper face",
    ] = None
    crank_shaft_low_mm: Annotated[
        float | None, LENGTH, "lower end of the crank's shaft, from the wheel's lower face; frame's"
    ] = None
    crank_shaft_high_mm: Annotated[
        float | None, LENGTH, "upper end of the crank's shaft, from there; that of arm, disc or hub"
    ] = None
    pin_mm: Annotated[float | None, NOT_NEGATIVE, "diameter of the roller's pin; r"] = None
    press_fit_mm: Annotated[
        float | None,
        NOT_NEGATIVE,
        "pin's diameter less that of its hole in the crank arm; 0, or the process's",
    ] = None
    arm_bore_mm: Annotated[
        float | None, POSITIVE, "diameter of the crank arm's bore; crank_bore_mm if there is one"
    ] = None
    arm_hub_mm: Annotated[
        float | None, POSITIVE, "width of the crank arm round its bore; 1.6 bores"
    ] = None
    arm_eye_mm: Annotated[
        float | None, POSITIVE, "width of the crank arm round a pin; 2 pins where the hub lets it"
    ] = None
    crank_keyway: Annotated[
        str | None, OneOf(("DIN 6885-1",)), "keyway in the bores of crank arm and locking disc"
    ] = None
    wheel_keyway: Annotated[str | None, OneOf(("DIN 6885-1",)), "keyway in the wheel's bore"] = None
    dial_bolts: Annotated[int, Range(0, 100), "bolts that fix the dial on the wheel, evenly"] = 0
    dial_bolt_mm: Annotated[float | None, POSITIVE, "diameter of their holes; L/40 at most"] = None
    dial_bolt_circle_mm: Annotated[
        float | None, POSITIVE, "diameter of the circle they stand on; amid bore and slots"
    ] = None
    gear_bolts: Annotated[
        int, Range(0, 100), "screws that hold a gear that stands to the frame, evenly"
    ] = 4
    gear_bolt_mm: Annotated[float | None, POSITIVE, "diameter of their holes; L/40 at most"] = None
    gear_bolt_circle_mm: Annotated[
        float | None, POSITIVE, "diameter of the circle they stand on; amid bore and pitch circle"
    ] = None
    lock_bolts: Annotated[
        int, Range(0, 100), "bolts or dowels through each sector of the locking disc and the arm"
    ] = 0
    lock_bolt_mm: Annotated[float | None, POSITIVE, "diameter of their holes; L/40"] = None
    lock_bolt_circle_mm: Annotated[
        float | None, POSITIVE, "diameter of the circle they stand on; where the disc is widest"
    ] = None
    pin_held: Annotated[
        str,
        OneOf(("cantilever", "supported", "fixed")),
        "pin fast in one plate, loose in two, or fast in two",
    ] = "cantilever"
    pin_gap_mm: Annotated[float, NOT_NEGATIVE, "from a pin's plate to the line of contact"] = 0.0
    lock_edge_mm: Annotated[
        float | None, POSITIVE, "radius to which the ends of the wheel's recesses are rounded"
    ] = None
    wheel_thickness_mm: Annotated[
        float | None, POSITIVE, "of wheel and rollers along the axis; face_width_mm, or L/10"
    ] = None
    lock_thickness_mm: Annotated[
        float | None, POSITIVE, "of the locking disc along the axis; the wheel's and pin_gap_mm"
    ] = None
    arm_thickness_mm: Annotated[
        float | None, POSITIVE, "of the crank arm along the axis; the wheel's"
    ] = None
    link_pin_mm: Annotated[
        float | None, POSITIVE, "diameter of the pins on which links turn; L/20 where there is room"
    ] = None
    link_bore_mm: Annotated[
        float | None,
        POSITIVE,
        "diameter of shafts of links alone; L/10 where there is room",
    ] = None
    link_width_mm: Annotated[
        float | None, POSITIVE, "width of the links round those pins; 2 pins"
    ] = None
    link_thickness_mm: Annotated[
        float | None, POSITIVE, "of the links along the axis; the crank arm's"
    ] = None
    washer_mm: Annotated[
        float, NOT_NEGATIVE, "thickness of the washers between links one below the other"
    ] = 0.0

    @cached_property
    def allowances(self) -> Allowances:
        """Clearances and press fit as they are given, or else the process's.

        >>> Size(process="laser", lock_clearance_mm=0.1).allowances[:3]
        (0.2, 0.1, 0.15)
        """
        usual = Allowances() if self.process is None else PROCESSES[self.process]
        given = {key: vars(self).get(key) for key in usual._fields}
        return usual._replace(**{key: v for key, v in given.items() if v is not None})


class Load(SpecTable):
    """``[load]``.

    >>> Design(External(6), load=Load(torque_Nm=15.0)).loads["input_torque_Nm"].max
    15.0
    """

    TABLE: ClassVar[str] = "load"

    inertia_kgm2: Annotated[float, NOT_NEGATIVE, "of everything the wheel turns"] = 0.0
    torque_Nm: Annotated[float, NOT_NEGATIVE, "torque that resists motion"] = 0.0
    dwell_torque_Nm: Annotated[
        float | None, NOT_NEGATIVE, "torque that the lock holds in the dwell; torque_Nm"
    ] = None
    efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "eta of the wheel"] = 1.0
    friction: Annotated[float, NOT_NEGATIVE, "roller against slot, coefficient"] = 0.0
    friction_at: Annotated[
        str,
        OneOf(("slot", "pin")),
        "where it rubs: in the slot, fast on its pin; or on the pin, and rolls in the slot",
    ] = "slot"

    @property
    def rubs_in_slot(self) -> bool:
        """Whether the roller is fast on its pin."""
        return self.friction_at == "slot"


class Mass(SpecTable):
    """One ``[[mass]]``: a body that the wheel carries, or several alike.

    >>> Mass("disc", mass_kg=2.0, diameter_mm=300.0).count
    1
    """

    TABLE: ClassVar[str] = "mass"

    shape: Annotated[str, OneOf(("disc", "ring", "block", "point")), "shape of the body"]
    mass_kg: Annotated[float | None, POSITIVE, "of one; or density_kgm3 and its sizes"] = None
    density_kgm3: Annotated[float | None, POSITIVE, "with all sizes, instead of mass_kg"] = None
    diameter_mm: Annotated[float | None, POSITIVE, "disc and ring: outer diameter D"] = None
    bore_mm: Annotated[float | None, POSITIVE, "ring: inner diameter d"] = None
    length_mm: Annotated[float | None, POSITIVE, "block: side a, square to the axis"] = None
    width_mm: Annotated[float | None, POSITIVE, "block: side c, square to the axis"] = None
    thickness_mm: Annotated[float | None, POSITIVE, "along the axis; needed with a density"] = None
    count: Annotated[int, Range(1, 1000), "how many alike"] = 1
    radius_mm: Annotated[float, NOT_NEGATIVE, "from the wheel's axis to the body's own"] = 0.0
    name: Annotated[str, None, "what it is"] = ""

    # the sizes that each shape has, of which its mass or inertia follow
    SIZES: ClassVar[dict[str, tuple[str, ...]]] = {
        "disc": ("diameter_mm",),
        "ring": ("diameter_mm", "bore_mm"),
        "block": ("length_mm", "width_mm"),
        "point": (),
    }

    def __post_init__(self) -> None:
        super().__post_init__()
        needed = self.SIZES[self.shape]
        for key in ("diameter_mm", "bore_mm", "length_mm", "width_mm"):
            given = getattr(self, key) is not None
            if given and key not in needed:
                raise GenevaError(f"a {self.shape} has no {key}; remove it", (self.TABLE, key))
            if not given and key in needed:
                raise GenevaError(f"a {self.shape} needs {' and '.join(needed)}", (self.TABLE,))
        if self.shape == "point" and not self.radius_mm:
            raise GenevaError(
                "a point on the wheel's axis has no inertia: give its radius_mm, or its weight as "
                "force_N in [support]",
                (self.TABLE,),
            )
        self._refuse_weight()
        if self.bore_mm and self.diameter_mm and not self.bore_mm < self.diameter_mm:
            raise GenevaError(
                f"bore_mm = {self.bore_mm:g} must be below diameter_mm = {self.diameter_mm:g}",
                (self.TABLE, "bore_mm"),
            )

    def _refuse_weight(self) -> None:
        """A mass is given, or follows from a density, one of the two."""
        if (self.mass_kg is None) == (self.density_kgm3 is None):
            raise GenevaError("give mass_kg, or density_kgm3 with all sizes: one", (self.TABLE,))
        if self.density_kgm3 is not None and self.shape == "point":
            raise GenevaError("a point has no sizes: give mass_kg", (self.TABLE, "density_kgm3"))
        if self.density_kgm3 is not None and self.thickness_mm is None:
            raise GenevaError(
                "density_kgm3 needs thickness_mm, or give mass_kg", (self.TABLE, "density_kgm3")
            )


class Support(SpecTable):
    """``[support]``: the bearing of the table that the wheel turns, and the gears to it.

    >>> Support(friction=0.01, radius_mm=80.0).gear_ratio
    1.0
    """

    TABLE: ClassVar[str] = "support"

    friction: Annotated[float, NOT_NEGATIVE, "coefficient"] = 0.0
    radius_mm: Annotated[float, NOT_NEGATIVE, "at which it acts"] = 0.0
    force_N: Annotated[float, NOT_NEGATIVE, "besides the weight of the masses"] = 0.0
    axis: Annotated[str, OneOf(("vertical", "horizontal")), "how the wheel's shaft stands"] = (
        "vertical"
    )
    gear_ratio: Annotated[float, POSITIVE, "turns of table and masses per turn of the wheel"] = 1.0

    @property
    def own_torque_Nm(self) -> float:
        """The friction of ``force_N`` alone, at the table.

        >>> Support(friction=0.15, radius_mm=100.0, force_N=1000.0).own_torque_Nm
        15.0
        """
        return self.friction * self.force_N * self.radius_mm * 1e-3


class Motor(SpecTable):
    """``[motor]``: what is behind the input shaft.

    >>> Motor(gear_ratio=20.0, gear_efficiency=0.9).service_factor
    1.0
    """

    TABLE: ClassVar[str] = "motor"

    service_factor: Annotated[float, Range(1.0, 100.0), "on the load, of the makers' form"] = 1.0
    gear_ratio: Annotated[float, POSITIVE, "turns of the motor per turn of the input shaft"] = 1.0
    gear_efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "of the reducer"] = 1.0
    inertia_kgm2: Annotated[float, NOT_NEGATIVE, "of rotor and reducer, at the motor"] = 0.0
    speed_variation: Annotated[
        float | None,
        Range(0.0, 2.0, "()"),
        "greatest minus least speed over mean, of a flywheel",
    ] = None


class Shaft(SpecTable):
    """``[shaft]``: the shafts of wheel and crank, and what is elastic between wheel and load.

    >>> Shaft(wheel_diameter_mm=25.0, wheel_overhang_mm=30.0).damping_ratio
    0.0
    """

    TABLE: ClassVar[str] = "shaft"

    stiffness_Nm_rad: Annotated[float | None, POSITIVE, "between wheel and load"] = None
    damping_ratio: Annotated[float, Range(0.0, 1.0, "[)"), "of that spring, over critical"] = 0.0
    wheel_diameter_mm: Annotated[float | None, POSITIVE, "wheel shaft"] = None
    crank_diameter_mm: Annotated[float | None, POSITIVE, "crank shaft"] = None
    wheel_overhang_mm: Annotated[
        float | None, NOT_NEGATIVE, "slot's mid-plane to the nearer bearing"
    ] = None
    wheel_span_mm: Annotated[float | None, POSITIVE, "between its two bearings"] = None
    crank_overhang_mm: Annotated[
        float | None, NOT_NEGATIVE, "roller's mid-plane to the nearer bearing"
    ] = None
    crank_span_mm: Annotated[float | None, POSITIVE, "between its two bearings"] = None
    shear_stress_max_MPa: Annotated[
        float | None, POSITIVE, "allowable; ASME B17c: 0.3 yield or 0.18 tensile strength, the less"
    ] = None
    bending_factor: Annotated[float, Range(1.0, 10.0), "ASME B17c: shock and fatigue"] = 1.5
    torsion_factor: Annotated[float, Range(1.0, 10.0), "ASME B17c: shock and fatigue"] = 1.0
    shear_modulus_GPa: Annotated[float, POSITIVE, "shear modulus G"] = 80.8


class Material(SpecTable):
    """What a part is made of; steel where nothing is said."""

    youngs_modulus_GPa: Annotated[float, POSITIVE, "Young's modulus E"] = 210.0
    poisson_ratio: Annotated[float, Range(0.0, 0.5), "Poisson's ratio nu"] = 0.3
    density_kgm3: Annotated[float, POSITIVE, "density"] = 7850.0
    stress_max_MPa: Annotated[float | None, POSITIVE, "allowable stress"] = None


class WheelMaterial(Material):
    """``[material.wheel]``.

    >>> WheelMaterial().youngs_modulus_GPa  # steel
    210.0
    """

    TABLE: ClassVar[str] = "material.wheel"

    wear_mm3_Nm: Annotated[
        float | None, POSITIVE, "Archard: volume worn per force and way, against the roller"
    ] = None


class RollerMaterial(Material):
    """``[material.roller]``: of the roller and its pin.

    >>> RollerMaterial(stress_max_MPa=1500.0).density_kgm3
    7850.0
    """

    TABLE: ClassVar[str] = "material.roller"

    dynamic_capacity_N: Annotated[
        float | None, POSITIVE, "dynamic capacity C of the roller as a bearing (ISO 281)"
    ] = None


class Tolerance(SpecTable):
    """``[tolerance]``: the dimensions' deviations, each plus or minus.

    >>> Tolerance(center_distance_mm=0.02).distribution
    'uniform'
    """

    TABLE: ClassVar[str] = "tolerance"

    center_distance_mm: Annotated[float, NOT_NEGATIVE, "+- on the centre distance L"] = 0.0
    crank_radius_mm: Annotated[float, NOT_NEGATIVE, "+- on the crank's radius R"] = 0.0
    roller_diameter_mm: Annotated[float, NOT_NEGATIVE, "+- on the roller's diameter"] = 0.0
    slot_width_mm: Annotated[float, NOT_NEGATIVE, "+- on the slot's width"] = 0.0
    slot_angle_deg: Annotated[float, NOT_NEGATIVE, "+- on each slot's direction"] = 0.0
    lock_radius_mm: Annotated[float, NOT_NEGATIVE, "+- on the locking disc's radius"] = 0.0
    recess_radius_mm: Annotated[float, NOT_NEGATIVE, "+- on the radius of the wheel's recess"] = 0.0
    distribution: Annotated[
        str, OneOf(("uniform", "normal")), "within +-; normal: +- is three standard deviations"
    ] = "uniform"


class Limits(SpecTable):
    """``[limits]``: what ``geneva check`` holds the design against.

    >>> strict = Design(External(6), limits=Limits(velocity_max=0.8))
    >>> [check.name for check in strict.checks if not check.passes]
    ['velocity_max']
    """

    TABLE: ClassVar[str] = "limits"

    velocity_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_max: Annotated[float | None, POSITIVE, "invariant"] = None
    acceleration_entry_max: Annotated[float | None, POSITIVE, "invariant"] = None
    jerk_max: Annotated[float | None, POSITIVE, "invariant"] = None
    pin_force_max_N: Annotated[float | None, POSITIVE, "roller on slot"] = None
    input_torque_max_Nm: Annotated[float | None, POSITIVE, "on the input shaft"] = None
    pressure_angle_max_deg: Annotated[float | None, Range(0.0, 90.0, "(]"), "of the slot"] = None
    contact_stress_max_MPa: Annotated[float | None, POSITIVE, "Hertz, line contact"] = None
    pv_max_W_m2: Annotated[float | None, POSITIVE, "contact stress times sliding speed"] = None
    roller_life_min_h: Annotated[float | None, POSITIVE, "L10 of the roller"] = None
    slot_wear_max_mm_per_million: Annotated[
        float | None, POSITIVE, "depth worn off a slot's walls in a million passages"
    ] = None
    lock_stress_max_MPa: Annotated[float | None, POSITIVE, "Hertz, locking disc on wheel"] = None
    lock_deflection_max_deg: Annotated[
        float | None, POSITIVE, "how far the wheel gives in its lock under dwell_torque_Nm"
    ] = None


# The tables that every spec may have, whatever its machine, in the order of a file; each is a field
# of ``Spec``, a dot being an underscore there. Of those in LISTS there may be several.
PLAIN: dict[str, type[SpecTable]] = {
    "size": Size,
    "load": Load,
    "mass": Mass,
    "support": Support,
    "motor": Motor,
    "shaft": Shaft,
    "material.wheel": WheelMaterial,
    "material.roller": RollerMaterial,
    "tolerance": Tolerance,
    "limits": Limits,
}
LISTS = ("mass",)
