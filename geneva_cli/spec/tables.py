"""The spec's tables and keys: type, default, range and meaning, one line each.

The attribute of a key that is a Python keyword ends in an underscore. ``None`` means: derived from
other keys. The annotations are objects, since evaluating text on import would take longer.
"""

from collections.abc import Iterable
from dataclasses import field
from operator import attrgetter
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.kept import cached_property
from geneva_cli.numerics.arrays import value_or
from geneva_cli.spec.rules import POSITIVE, FromZero, Height, NotNegative, OneOf, Positive, Range
from geneva_cli.spec.schema import SpecTable, fields
from geneva_cli.spec.workshops import PROCESSES, WORKSHOPS, Allowances

# types of keys that wheel and crank have alike, with their meaning
Keyway = Annotated[str | None, OneOf(("DIN 6885-1",)), "keyway in all bores on this shaft"]
BoreShape = Annotated[
    str, OneOf(("round", "D", "hex")), "shape of all bores on this shaft; hex: across flats"
]

DISTANCE_MM = 100.0  # the centre distance of a spec that gives none
Z_DRAWN = 360  # slots of a wheel that is drawn: one a degree
Z_USUAL = 24  # above it the slots leave little of a wheel: a warning


class Thicknesses(NamedTuple):
    """The parts' thicknesses along the axis, mm."""

    wheel: float
    lock: float
    arm: float
    link: float


class Size(SpecTable, table="size"):
    """``[size]``: sizes of the parts.

    Lengths in mm; diameters where a key says so. Keys that are not set follow from the others.

    >>> Design(External(6), size=Size(center_distance_mm=200.0)).mechanism.roller_radius_mm
    10.0
    """

    center_distance_mm: Annotated[
        Positive, "centre distance L; spherical: sphere radius; linear: crank radius; default 100"
    ] = None
    crank_radius_mm: Annotated[
        Positive,
        "crank radius R, to the roller; alone it sets L; with another R/L than needed: as built",
    ] = field(default=None, kw_only=True)
    roller_radius_mm: Annotated[Positive, "roller radius r; default L/20"] = None
    process: Annotated[str | None, OneOf(PROCESSES), "sets clearances, fits and limits"] = None
    slot_clearance_mm: Annotated[NotNegative, "per side; default 0, or by process"] = None
    lock_clearance_mm: Annotated[NotNegative, "per side; default 0, or by process"] = None
    face_width_mm: Annotated[Positive, "length of the contact line between roller and slot"] = None
    wheel_radius_mm: Annotated[
        Positive,
        "rim radius; internal: of the opening; linear: the edge; default: roller at entry",
    ] = None
    wheel_outer_radius_mm: Annotated[Positive, "internal: outer radius; default slots + 2 r"] = None
    slot_bottom_clearance_mm: Annotated[NotNegative, "roller to a slot's end; default r/20"] = None
    lock_radius_mm: Annotated[NotNegative, "locking disc's radius; 0 none; default by horns"] = None
    relief: Annotated[str | None, OneOf(("arc", "sector")), "cut; default: one that clears"] = None
    relief_clearance_mm: Annotated[NotNegative, "wheel to relief's bottom; default L/200"] = None
    wall_min_mm: Annotated[NotNegative, "least wall; default L/200, or by process"] = None
    wheel_bore_mm: Annotated[NotNegative, "wheel's shaft; default up to L/6, or by load"] = None
    wheel_hub_mm: Annotated[NotNegative, "diameter of the wheel's hub, towards the arm"] = None
    wheel_hub_length_mm: Annotated[Positive, "below the wheel; default: past the crank arm"] = None
    wheel_shaft_low_mm: Annotated[Height, "shaft's lower end, from the wheel's lower face"] = None
    wheel_shaft_high_mm: Annotated[Height, "shaft's upper end, from the wheel's lower face"] = None
    crank_bore_mm: Annotated[
        NotNegative,
        "diameter of the crank's shaft in the disc; default arm_bore_mm; 0: it ends below",
    ] = None
    crank_hub_mm: Annotated[NotNegative, "diameter of the crank's hub in the wheel's plane"] = None
    crank_hub_length_mm: Annotated[Positive, "from the arm up; default: wheel's upper face"] = None
    crank_shaft_low_mm: Annotated[Height, "shaft's lower end, from the wheel's lower face"] = None
    crank_shaft_high_mm: Annotated[Height, "shaft's upper end, from the wheel's lower face"] = None
    pin_mm: Annotated[NotNegative, "diameter of the roller's pin; default r, or by load"] = None
    press_fit_mm: Annotated[NotNegative, "pin minus its hole; default 0, or by process"] = None
    shaft_fit_mm: Annotated[NotNegative, "bores minus shafts; default 0, or by process"] = None
    arm_bore_mm: Annotated[Positive, "crank's shaft in it; default crank_bore_mm or by load"] = None
    arm_hub_mm: Annotated[Positive, "width of the arm round its bore; default 1.6 bores"] = None
    arm_eye_mm: Annotated[Positive, "width of the arm round a pin; default up to 2 pins"] = None
    crank_keyway: Keyway = None
    crank_bore: BoreShape = "round"
    crank_flat_mm: Annotated[Positive, "depth of a D bore's flat; default bore/10"] = None
    wheel_keyway: Keyway = None
    wheel_bore: BoreShape = "round"
    wheel_flat_mm: Annotated[Positive, "depth of a D bore's flat; default bore/10"] = None
    dial_bolts: Annotated[int, Range(0, 100), "number of bolts between dial and wheel"] = 0
    dial_bolt_mm: Annotated[Positive, "dial's bolt holes; default for a screw up to L/40"] = None
    dial_bolt_circle_mm: Annotated[Positive, "diameter; default amid bore and slots"] = None
    gear_bolts: Annotated[int, Range(0, 100), "screws between a fixed gear and the frame"] = 4
    gear_bolt_mm: Annotated[Positive, "fixed gear's screw holes; default up to L/40"] = None
    gear_bolt_circle_mm: Annotated[Positive, "diameter; default amid bore and pitch circle"] = None
    lock_bolts: Annotated[int | None, Range(0, 100), "in each sector; default 2 if they fit"] = None
    lock_bolt_mm: Annotated[Positive, "lock's bolt holes; default for a screw up to L/40"] = None
    lock_bolt_circle_mm: Annotated[Positive, "diameter; default where the disc is widest"] = None
    pin_held: Annotated[
        str,
        OneOf(("cantilever", "supported", "fixed")),
        "support of the roller's pin: fixed in one plate, loose in two, or fixed in two",
    ] = "cantilever"
    pin_gap_mm: Annotated[NotNegative, "pin's plate to contact; default 0, or by process"] = None
    mouth_radius_mm: Annotated[FromZero, "rounding radius of straight slots' mouths"] = 0.0
    horn_tip_mm: Annotated[FromZero, "horns thinner at their tips are cut to flats so wide"] = 0.0
    lock_edge_mm: Annotated[Positive, "rounding of recesses' ends; with stop the disc's too"] = None
    wheel_thickness_mm: Annotated[Positive, "wheel; default face_width_mm, L/10 or by load"] = None
    lock_thickness_mm: Annotated[Positive, "locking disc; default wheel plus pin_gap_mm"] = None
    arm_thickness_mm: Annotated[Positive, "crank arm; default the wheel's, or by load"] = None
    link_pin_mm: Annotated[Positive, "pins between links; default up to L/20"] = None
    link_bore_mm: Annotated[Positive, "shafts of links only; default up to L/10, or by load"] = None
    link_width_mm: Annotated[Positive, "links round their pins; default 2 pin diameters"] = None
    link_thickness_mm: Annotated[Positive, "links; default the crank arm's, or by load"] = None
    washer_mm: Annotated[FromZero, "thickness of washers between stacked links"] = 0.0
    edge_chamfer_mm: Annotated[Positive, "chamfer of all edges, at 45 degrees"] = None
    edge_fillet_mm: Annotated[Positive, "rounding radius of all edges"] = None
    # no key: L of a machine that is given by crank_radius_mm, which its ``Spec`` computes
    derived_distance_mm: float | None = field(default=None, kw_only=True, repr=False)

    @property
    def distance_mm(self) -> float:
        """Centre distance L: its key, or derived from the crank radius, or the default."""
        usual = value_or(self.derived_distance_mm, DISTANCE_MM)
        return value_or(self.center_distance_mm, usual)

    @property
    def edge_mm(self) -> float:
        """Height of a face that its chamfer or rounding takes at each edge; 0 for sharp edges."""
        return value_or(self.edge_chamfer_mm, value_or(self.edge_fillet_mm, 0.0))

    def has_hub(self, part: str) -> bool:
        """True if the spec has a size of a part's hub; otherwise only its space is kept free."""
        own = vars(self)
        return own[f"{part}_hub_mm"] is not None or own[f"{part}_hub_length_mm"] is not None

    def roller_radius(self, L: float) -> float:
        """Radius of a roller for a centre distance, mm; by default a twentieth of it."""
        return value_or(self.roller_radius_mm, L / 20.0)

    def thicknesses(self, usual: float) -> Thicknesses:
        """Thicknesses of the plates, mm; by default all are the wheel's, and that is ``usual``."""
        between = None if self.face_width_mm is None else self.face_width_mm + 2.0 * self.edge_mm
        wheel = value_or(self.wheel_thickness_mm, value_or(between, usual))
        arm = value_or(self.arm_thickness_mm, wheel)
        # a gap of the process does not ask for a plate of another thickness
        lock = value_or(self.lock_thickness_mm, wheel + value_or(self.pin_gap_mm, 0.0))
        return Thicknesses(wheel, lock, arm, value_or(self.link_thickness_mm, arm))

    @cached_property
    def allowances(self) -> Allowances:
        """Clearances and press fit from the spec, or else from the process.

        Those of a cut follow the plates' thicknesses.

        >>> Size(process="laser", wheel_thickness_mm=3.0, lock_clearance_mm=0.1).allowances[:3]
        (0.2, 0.1, 0.15)
        """
        own, shop = vars(self), WORKSHOPS[self.process]
        values, cut_mm = shop.allowances._asdict(), shop.cut_mm
        if cut_mm:
            # Parts are all off by the deviation of their cut. The roller is wide and its slot
            # narrow, each by half a side; and so disc and recess, whose diameter is about the
            # centre distance. A hole that is wide still holds its pin, and a narrow bore lets in
            # its shaft. Sizes that are not set have their defaults without a load, before they
            # are rounded down.
            L = self.distance_mm
            roller, thick = self.roller_radius(L), self.thicknesses(L / 10.0)
            across = L if self.lock_radius_mm is None else 2.0 * self.lock_radius_mm
            disc = cut_mm(thick.wheel, across) + cut_mm(thick.lock, across)
            values["slot_clearance_mm"] = cut_mm(thick.wheel, 2.0 * roller)
            values["lock_clearance_mm"] = 0.5 * disc
            values["press_fit_mm"] = cut_mm(thick.arm, value_or(self.pin_mm, roller))
            values["shaft_fit_mm"] = cut_mm(thick.wheel, value_or(self.wheel_bore_mm, L / 6.0))
        for key in values:
            if own.get(key) is not None:
                values[key] = own[key]
        return Allowances(**values)


class Load(SpecTable, table="load"):
    """``[load]``: inertia, torque and friction at the wheel.

    >>> Design(External(6), load=Load(torque_Nm=15.0)).loads["input_torque_Nm"].max
    15.0
    """

    inertia_kgm2: Annotated[FromZero, "inertia of everything the wheel turns"] = 0.0
    torque_Nm: Annotated[FromZero, "torque that resists the wheel's motion"] = 0.0
    mass_kg: Annotated[FromZero, "linear: mass of the rack and all it moves"] = 0.0
    force_N: Annotated[FromZero, "linear: force that resists the rack's motion"] = 0.0
    dwell_torque_Nm: Annotated[NotNegative, "held by the lock at rest; default torque_Nm"] = None
    winding_torque_Nm: Annotated[Positive, "with stop: crank's torque against its stops"] = None
    efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "efficiency eta of the wheel"] = 1.0
    friction: Annotated[FromZero, "friction coefficient between roller and slot"] = 0.0
    friction_at: Annotated[str, OneOf(("slot", "pin")), "slides in the slot or on the pin"] = "slot"
    guide_friction: Annotated[NotNegative, "linear: of the guide; default friction"] = None


class Mass(SpecTable, table="mass"):
    """One ``[[mass]]``: a body on the wheel, or several equal ones.

    >>> Mass("disc", mass_kg=2.0, diameter_mm=300.0).count
    1
    """

    shape: Annotated[str, OneOf(("disc", "ring", "block", "point")), "shape of the body"]
    mass_kg: Annotated[Positive, "mass of one; or density_kgm3 and all sizes"] = None
    density_kgm3: Annotated[Positive, "density; the sizes then give the mass"] = None
    diameter_mm: Annotated[Positive, "disc and ring: outer diameter D"] = None
    bore_mm: Annotated[Positive, "ring: inner diameter d"] = None
    length_mm: Annotated[Positive, "block: side a, perpendicular to the axis"] = None
    width_mm: Annotated[Positive, "block: side c, perpendicular to the axis"] = None
    thickness_mm: Annotated[Positive, "thickness; required with a density"] = None
    count: Annotated[int, Range(1, 1000), "number of equal bodies"] = 1
    radius_mm: Annotated[FromZero, "distance from the wheel's axis to the body's"] = 0.0
    name: Annotated[str, None, "name of the body"] = ""

    # sizes of each shape, from which its mass or inertia follows
    SIZES: ClassVar[dict[str, tuple[str, ...]]] = {
        "disc": ("diameter_mm",),
        "ring": ("diameter_mm", "bore_mm"),
        "block": ("length_mm", "width_mm"),
        "point": (),
    }

    @property
    def to_one_side(self) -> bool:
        """True for a single body off the axis; equal bodies are spaced evenly, and balanced."""
        return self.count < 2 and self.radius_mm > 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        shape, own, needed, place = self.shape, vars(self), self.SIZES[self.shape], [self.TABLE]
        fault = ""
        if shape == "point" and not self.radius_mm:
            fault = "a point on the wheel's axis has no inertia: set radius_mm, or set its weight"
            fault += " as force_N in [support]"
        elif (self.mass_kg is None) == (self.density_kgm3 is None):
            fault = "set either mass_kg, or density_kgm3 with all sizes"
        elif self.density_kgm3 is not None and (shape == "point" or self.thickness_mm is None):
            place += ["density_kgm3"]
            fault = "density_kgm3 needs thickness_mm and a shape with sizes; or set mass_kg instead"
        elif self.bore_mm and self.diameter_mm and not self.bore_mm < self.diameter_mm:
            place += ["bore_mm"]
            fault = f"bore_mm = {self.bore_mm:g} must be below diameter_mm = {self.diameter_mm:g}"
        for key in ("diameter_mm", "bore_mm", "length_mm", "width_mm"):
            if (own[key] is None) == (key in needed):
                sizes, do = " and ".join(needed) or "no sizes", "remove" if own[key] else "set"
                fault, place = f"a {shape} has {sizes}: {do} {key}", [self.TABLE, key]
        if fault:
            raise GenevaError(fault, tuple(place))


class Support(SpecTable, table="support"):
    """``[support]``: the bearing of the table that the wheel turns, and the gears to it.

    >>> Support(friction=0.01, radius_mm=80.0).gear_ratio
    1.0
    """

    friction: Annotated[FromZero, "friction coefficient of the table's bearing"] = 0.0
    radius_mm: Annotated[FromZero, "radius at which that friction acts"] = 0.0
    force_N: Annotated[FromZero, "force in addition to the weight of the masses"] = 0.0
    axis: Annotated[str, OneOf(("vertical", "horizontal")), "the wheel's shaft"] = "vertical"
    gear_ratio: Annotated[float, POSITIVE, "turns of table and masses per turn of the wheel"] = 1.0


class Motor(SpecTable, table="motor"):
    """``[motor]``: the motor, its reducer and a flywheel.

    >>> Motor(gear_ratio=20.0, gear_efficiency=0.9).service_factor
    1.0
    """

    service_factor: Annotated[float, Range(1.0, 100.0), "service factor of the makers"] = 1.0
    gear_ratio: Annotated[Positive, "motor's turns for one of the input; default 1"] = None
    gear_efficiency: Annotated[float, Range(0.0, 1.0, "(]"), "efficiency of the reducer"] = 1.0
    inertia_kgm2: Annotated[FromZero, "inertia of rotor and reducer"] = 0.0
    speed_variation: Annotated[
        float | None, Range(0.0, 2.0, "()"), "(greatest - least) / mean speed; sizes a flywheel"
    ] = None

    @property
    def ratio(self) -> float:
        """Turns of the motor per turn of the input shaft: 1 without a reducer."""
        return value_or(self.gear_ratio, 1.0)


class Shaft(SpecTable, table="shaft"):
    """``[shaft]``: the shafts of wheel and crank, and the elastic shaft between wheel and load.

    >>> Shaft(wheel_diameter_mm=25.0, wheel_overhang_mm=30.0).damping_ratio
    0.0
    """

    stiffness_Nm_rad: Annotated[Positive, "stiffness between wheel and load"] = None
    damping_ratio: Annotated[float, Range(0.0, 1.0, "[)"), "shaft's damping over critical"] = 0.0
    wheel_diameter_mm: Annotated[Positive, "diameter of the wheel's shaft"] = None
    crank_diameter_mm: Annotated[Positive, "diameter of the crank's shaft"] = None
    wheel_overhang_mm: Annotated[
        NotNegative, "wheel's shaft: slots' mid-plane (a sphere's radius L) to the nearer bearing"
    ] = None
    wheel_span_mm: Annotated[Positive, "wheel's shaft: bearing to bearing"] = None
    crank_overhang_mm: Annotated[
        NotNegative, "crank's shaft: roller's mid-plane (a sphere's radius L) to the nearer bearing"
    ] = None
    crank_span_mm: Annotated[Positive, "crank's shaft: bearing to bearing"] = None
    shear_stress_max_MPa: Annotated[
        Positive, "allowable; ASME B17c: 0.3 yield or 0.18 tensile; default 82.5 (C45+N)"
    ] = None
    bending_factor: Annotated[float, Range(1.0, 10.0), "ASME B17c: shock factor in bending"] = 1.5
    torsion_factor: Annotated[float, Range(1.0, 10.0), "ASME B17c: shock factor in torsion"] = 1.0


class Material(SpecTable):
    """Material of a part; without its keys steel, or PLA for a printed plate."""

    youngs_modulus_GPa: Annotated[Positive, "Young's modulus E; default steel 210, PLA 2.4"] = None
    poisson_ratio: Annotated[float | None, Range(0.0, 0.5), "nu; default 0.3, PLA 0.36"] = None
    density_kgm3: Annotated[Positive, "density; default steel 7850, PLA 1240"] = None
    stress_max_MPa: Annotated[Positive, "allowable; default steel 165 (0.6 yield), PLA 8.2"] = None
    grade: Annotated[str | None, None, "grade, as drawings name it"] = None


class WheelMaterial(Material, table="material.wheel"):
    """``[material.wheel]``: material of wheel, arm, locking disc and other plates.

    >>> WheelMaterial(grade="POM", youngs_modulus_GPa=2.8).stress_max_MPa is None
    True
    """


class RollerMaterial(Material, table="material.roller"):
    """``[material.roller]``: material of rollers, their pins, and shafts.

    >>> RollerMaterial(stress_max_MPa=1500.0).stress_max_MPa
    1500.0
    """

    dynamic_capacity_N: Annotated[Positive, "capacity C of the roller as bearing (ISO 281)"] = None


class Tolerance(SpecTable, table="tolerance"):
    """``[tolerance]``: deviations of the dimensions, each plus or minus.

    >>> Tolerance(center_distance_mm=0.02).distribution
    'uniform'
    """

    center_distance_mm: Annotated[FromZero, "± of the centre distance L"] = 0.0
    crank_radius_mm: Annotated[FromZero, "± of the crank radius R, by center_distance_mm"] = 0.0
    roller_diameter_mm: Annotated[FromZero, "± of the roller diameter, 2 roller_radius_mm"] = 0.0
    slot_width_mm: Annotated[FromZero, "± of the slot's width, by roller_radius_mm"] = 0.0
    slot_angle_deg: Annotated[FromZero, "± of each slot's direction"] = 0.0
    lock_radius_mm: Annotated[FromZero, "± of the locking disc's radius"] = 0.0
    recess_radius_mm: Annotated[FromZero, "± of the recess radius, by lock_radius_mm"] = 0.0
    distribution: Annotated[str, OneOf(("uniform", "normal")), "normal: ± is 3 sigma"] = "uniform"

    @property
    def is_given(self) -> bool:
        """True if a dimension deviates."""
        return self != Tolerance(distribution=self.distribution)


class Product(SpecTable, table="product"):
    """``[product]``: what the dial, chain or film carries, and how it may slip.

    >>> Product(radius_mm=300.0).friction is None
    True
    """

    radius_mm: Annotated[Positive, "distance of the product from the axis"] = None
    sprocket_teeth: Annotated[int | None, Range(3, 10000), "teeth of its sprocket"] = None
    pitch_mm: Annotated[Positive, "pitch of chain, belt or film"] = None
    friction: Annotated[Positive, "friction coefficient between product and its seat"] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        radius, pitch = self.radius_mm, self.pitch_mm
        twice = radius is not None and pitch is not None
        unplaced = self.friction is not None and not self.lies
        if twice or unplaced or (self.sprocket_teeth is None) != (pitch is None):
            text = "the product's place is radius_mm, or sprocket_teeth and pitch_mm: set one"
            raise GenevaError(text, (self.TABLE,))

    @property
    def lies(self) -> bool:
        """True if the product's place is known."""
        return self.radius_mm is not None or self.pitch_mm is not None


class TitleBlock(SpecTable, table="drawing"):
    """``[drawing]``: fields of the title block, and what drawings ask of faces and edges.

    >>> TitleBlock(number="G-106", revision="B").author is None
    True
    """

    number: Annotated[str | None, None, "drawing number"] = None
    revision: Annotated[str | None, None, "revision of the drawing"] = None
    author: Annotated[str | None, None, "author of the drawing"] = None
    date: Annotated[str | None, None, 'date of issue, as text: "2026-11-27"'] = None
    roughness_um: Annotated[Positive, "roughness Ra of all other faces; default by process"] = None
    flank_roughness_um: Annotated[Positive, "roughness Ra of faces that roll, slide or lock"] = None
    flank_hardness_HRC: Annotated[float | None, Range(20.0, 70.0), "hardness of these faces"] = None


class Outline(SpecTable, table="outline"):
    """``[outline]``: drawings of wheel and crank that replace the computed outlines.

    >>> Outline(wheel="wheel.dxf").files, Outline().files
    (('wheel.dxf',), ())
    """

    wheel: Annotated[str | None, None, "wheel: a .dxf or .svg file, its axis at the origin"] = None
    crank: Annotated[str | None, None, "a file, axis at the origin, first roller on +x"] = None
    wheel_turn_deg: Annotated[float, Range(-360.0, 360.0), "turn the wheel's drawing by this"] = 0.0
    crank_turn_deg: Annotated[float, Range(-360.0, 360.0), "turn the crank's drawing by this"] = 0.0
    mirror: Annotated[str, OneOf(("none", "wheel", "crank", "both")), "seen from behind"] = "none"
    slack_mm: Annotated[
        float | None, Range(1e-9, 1.0), "overlap that counts as touching; default 1e-6 or 1e-3"
    ] = None

    @property
    def files(self) -> tuple[str, ...]:
        """The names of the drawings."""
        return tuple([name for name in (self.wheel, self.crank) if name is not None])


class Limits(SpecTable, table="limits"):
    """``[limits]``: limits that ``geneva check`` compares the design with.

    >>> strict = Design(External(6), limits=Limits(velocity_max=0.8))
    >>> [check.name for check in strict.checks if not check.passes]
    ['velocity_max']
    """

    velocity_max: Annotated[Positive, "velocity dpsi/dtheta"] = None
    acceleration_max: Annotated[Positive, "acceleration d2psi/dtheta2"] = None
    acceleration_entry_max: Annotated[Positive, "acceleration at entry"] = None
    jerk_max: Annotated[Positive, "jerk d3psi/dtheta3"] = None
    entry_velocity_max: Annotated[Positive, "jump at entry and exit; as built: default 0.01"] = None
    pin_force_max_N: Annotated[Positive, "greatest force of roller on slot"] = None
    input_torque_max_Nm: Annotated[Positive, "greatest torque on input shaft"] = None
    pressure_angle_max_deg: Annotated[float | None, Range(0.0, 90.0, "(]"), "pressure angle"] = None
    contact_stress_max_MPa: Annotated[Positive, "Hertz stress, roller on slot"] = None
    pv_max_W_m2: Annotated[Positive, "contact stress times sliding speed"] = None
    roller_life_min_h: Annotated[Positive, "least L10 life of the roller"] = None
    lock_stress_max_MPa: Annotated[Positive, "Hertz stress, disc on wheel"] = None
    stop_stress_max_MPa: Annotated[Positive, "Hertz stress at a stop"] = None
    lock_deflection_max_deg: Annotated[Positive, "of the locked wheel under dwell_torque_Nm"] = None
    product_acceleration_max_m_s2: Annotated[Positive, "acceleration of the product, m/s²"] = None
    dwell_min_s: Annotated[Positive, "shortest time at rest"] = None
    motion_max_s: Annotated[Positive, "longest time of a motion"] = None
    cycle_max_s: Annotated[Positive, "longest time of a motion and the dwell after it"] = None
    index_play_max_deg: Annotated[Positive, "greatest play of the wheel in its motion"] = None
    dwell_play_max_deg: Annotated[Positive, "greatest play of the wheel in its dwell"] = None
    dwell_position_max_deg: Annotated[Positive, "resting wheel's error within [tolerance]"] = None


# Keys of ``[limits]``, which name their checks too, and what they bound: from below if the key has
# _min in it.
LIMITED = {
    "velocity_max": "velocity.max",
    "acceleration_max": "acceleration.max",
    "acceleration_entry_max": "acceleration.entry",
    "jerk_max": "jerk.max",
    "pin_force_max_N": "loads.pin_force_N.max",
    "input_torque_max_Nm": "loads.input_torque_Nm.max",
    "contact_stress_max_MPa": "loads.contact_stress_MPa.max",
    "pv_max_W_m2": "life.pv_max_W_m2",
    "roller_life_min_h": "life.roller_life_h",
    "dwell_min_s": "timing.dwell_s",
    "motion_max_s": "timing.motion_s",
    "cycle_max_s": "timing.cycle_s",
}


# the warnings that a reason may accept
ACCEPTED = (
    *("many_slots", "no_centre_distance", "nothing_holds", "stop_in_motion", "loose_fit"),
    *("rounded_points", "turns_back", "off_mid_condition", "soft_shock_at_ends"),
    *("soft_shock_at_mid", "not_positively_driven", "steep_hand_over", "undercut"),
    *("friction_holds_the_wheel", "sharp_wall", "drives_the_motor", "heavy_inertia"),
    *("tiny_machine", "wheel_left_out", "weight_to_one_side", "unbalanced", "nothing_to_act_on"),
    *("driven_by_one_wall", "lags_behind", "short_motion", "stout_horns", "tolerance_left_out"),
    *("not_every_machine_turns", "small_hole", "no_bearing", "gears_without_teeth"),
    *("taken_as_built", "outline_units", "ideal_machine", "narrow_for_process"),
)
Reason = Annotated[str | None, None, "reason for accepting this warning"]


class Accept(SpecTable, names=ACCEPTED, of=Reason, table="accept"):
    """``[accept]``: the reason for each accepted warning, by its name.

    >>> Accept(many_slots="a dial of 30 stations").reasons
    {'many-slots': 'a dial of 30 stations'}
    """

    WORDS_APART: ClassVar[str] = "-"  # in the names of warnings

    # warnings of `geneva vibration` and `geneva tolerance` alone
    ELSEWHERE: ClassVar[tuple[str, ...]] = (
        *("short-motion", "tolerance-left-out", "not-every-machine-turns"),
    )

    reasons: ClassVar[dict[str, str]]  # of each record, by the names of the accepted warnings

    if TYPE_CHECKING:

        def __init__(self, **reasons: str | None) -> None: ...

    def __post_init__(self) -> None:
        super().__post_init__()
        reasons = vars(self)["reasons"] = dict[str, str]()
        for name, attribute, *_ in fields(Accept):
            reason = vars(self)[attribute]
            if reason is not None:
                reasons[name] = reason
                if not reason.strip():
                    text = f'{name} needs the reason for accepting it, as {name} = "agreed"'
                    raise GenevaError(text, (self.TABLE, name))

    def applied(self, notices: Iterable[Notice]) -> list[Notice]:
        """The warnings, the accepted ones with their reason."""
        reasons, out = self.reasons, list(notices)
        for i, one in enumerate(out):
            if one.name in reasons:
                out[i] = Notice(one.name, one.plain, reasons[one.name])
        return out

    def unused(self, notices: Iterable[Notice]) -> list[str]:
        """Names of accepted warnings that do not occur among those of ``check``."""
        unused = dict(self.reasons)
        for name in (*self.ELSEWHERE, *map(attrgetter("name"), notices)):
            unused.pop(name, None)
        return list(unused)


# The tables of every kind of machine, in the order of a file; those in LISTS may be repeated.
PLAIN: dict[str, type[SpecTable]] = {}
for _table in (
    *(Size, Load, Mass, Support, Motor, Shaft, WheelMaterial, RollerMaterial, Tolerance),
    *(Product, TitleBlock, Outline, Limits, Accept),
):
    PLAIN[_table.TABLE] = _table
LISTS = ("mass",)
