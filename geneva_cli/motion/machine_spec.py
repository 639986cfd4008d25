"""A whole spec: the wheel, its drive, its motion, and the tables of sizes, loads and limits.

And the tables of its file whose keys depend on the kind of wheel, drive or law.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from operator import attrgetter
from typing import Any, ClassVar, NamedTuple, Self, cast

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.kept import load_named
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive, Gears
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.registry import CRANK, named, thing
from geneva_cli.motion.wheels.gearing import Gearing, Output
from geneva_cli.numerics.arrays import Truth, all_true
from geneva_cli.spec import tables
from geneva_cli.spec.rules import OneOf
from geneva_cli.spec.schema import Field, SpecTable, fields, refuse_kind
from geneva_cli.spec.tables import LISTS, Z_DRAWN, Accept, Mass

BEFORE = "drive.before"  # table of the drive that turns the input shaft of [drive]
# limits that need a load
LOADED = (
    *("pin_force_max_N", "input_torque_max_Nm", "contact_stress_max_MPa", "pv_max_W_m2"),
    "roller_life_min_h",
)
# limits that need another key, with its table and its meaning
_CONTACT = ("face_width_mm", "size", "the length of the line of contact")
NEEDED = {
    "contact_stress_max_MPa": _CONTACT,
    "pv_max_W_m2": _CONTACT,
    "lock_stress_max_MPa": _CONTACT,
    "stop_stress_max_MPa": _CONTACT,
    "lock_deflection_max_deg": _CONTACT,
    "roller_life_min_h": ("dynamic_capacity_N", "material_roller", "the roller's capacity"),
}


# examples of objects, for error messages; of tables their classes
EXAMPLES = {
    "wheel": "External(6)",
    "drive": "Crank(n_rpm=60)",
    "drive_before": "SideCrank(A=0.6)",
    "motion": "Motion(Cycloidal())",
}
NO_TABLE = ("mass", "title", "path", "files")  # fields of ``Spec`` that hold no table


class Spec(SpecTable):
    """All values from which a machine is built, as in the spec's file.

    ``path`` is that file, for messages; ``files`` are the CSV files of its points. ``drive_before``
    turns the input shaft of ``drive``.

    >>> Spec(External(6)).drive.n_rpm
    60.0
    """

    # what follows from the tables, for all who read a spec
    turns: ClassVar[int]  # of the input in one turn of the crank
    given_distance_mm: ClassVar[float]  # centre distance L, before a drive solves for another one
    gears: ClassVar[Gears | None]  # of the drive or the one before it, not circular
    has_lock: ClassVar[bool]  # the crank has a part that locks the wheel in the dwell
    output: ClassVar[Output]  # what the wheel gives out, with its units
    unloaded: ClassVar[Truth]  # there is neither inertia nor torque nor friction
    is_loaded: ClassVar[bool]  # a design, or one of a batch, is not unloaded
    unbalanced: ClassVar[bool]  # a single body stands off the wheel's axis
    dwell_holder: ClassVar[str | None]  # what holds the wheel in the dwell; None if nothing does
    wheel: Gearing
    drive: Drive = cast("Drive", None)  # by default a plain crank
    motion: Motion | None = None
    size: tables.Size = tables.Size()
    load: tables.Load = tables.Load()
    mass: tuple[Mass, ...] = ()
    support: tables.Support = tables.Support()
    motor: tables.Motor = tables.Motor()
    shaft: tables.Shaft = tables.Shaft()
    material_wheel: tables.WheelMaterial = tables.WheelMaterial()
    material_roller: tables.RollerMaterial = tables.RollerMaterial()
    tolerance: tables.Tolerance = tables.Tolerance()
    product: tables.Product = tables.Product()
    limits: tables.Limits = tables.Limits()
    accept: Accept = Accept()
    drawing: tables.TitleBlock = tables.TitleBlock()
    outline: tables.Outline = tables.Outline()
    title: str = ""
    path: str = ""
    files: tuple[str, ...] = ()
    drive_before: Drive | None = None

    def __post_init__(self) -> None:
        if vars(self)["drive"] is None:
            vars(self)["drive"] = load_named(CRANK)()
        vars(self)["mass"] = tuple(self.mass)
        for body in self.mass:
            if not isinstance(body, Mass):
                refuse_kind(body, "mass", Mass, 'Mass("disc", ...)')
        for name, one in self._parameters.items():
            value, kind = vars(self)[name], cast("Any", one.type)
            if name not in NO_TABLE and not isinstance(value, kind):
                refuse_kind(value, name, kind, EXAMPLES.get(name, ""))
        # the centre distance follows from the crank radius where only that is set
        size, radius, L = self.size, self.size.crank_radius_mm, None
        if radius is not None and size.center_distance_mm is None:
            L = self.drive.distance_mm(self.wheel, self.motion, radius)
        if L is not size.derived_distance_mm:
            vars(self)["size"] = size.replace(derived_distance_mm=L)
        L, before = self.size.distance_mm, self.drive_before
        turns = self.drive.turns * (before.turns if before else 1)
        gears = (before and before.gears) or (None if self.drive.direct else self.drive.gears)
        lock = self.drive.LOCKS and not all_true(self.size.lock_radius_mm == 0.0)
        own = {"turns": turns, "given_distance_mm": L, "gears": gears, "has_lock": lock}
        holder = self.wheel.held_by or (self.wheel.LOCK if lock else None)
        vars(self).update(own, output=self.wheel.output(L), dwell_holder=holder)
        load, support = self.load, self.support
        nothing = (load.inertia_kgm2 == 0.0) & (load.torque_Nm == 0.0)
        nothing = nothing & (load.mass_kg == 0.0) & (load.force_N == 0.0)
        support_Nmm = support.friction * support.force_N * support.radius_mm
        nothing = nothing & (support_Nmm == 0.0) & (not self.mass)
        vars(self).update(unloaded=nothing, is_loaded=not all_true(nothing))
        vars(self)["unbalanced"] = any(map(attrgetter("to_one_side"), self.mass))
        limits = vars(self.limits)
        for limit, (key, of, what) in NEEDED.items():
            if limits[limit] is not None and vars(vars(self)[of])[key] is None:
                text = f"{limit} needs {what}: set {key} in [{of.replace('_', '.')}]"
                raise GenevaError(text, ("limits", limit))
        if self.limits.product_acceleration_max_m_s2 is not None and not self.product.lies:
            key = "product_acceleration_max_m_s2"
            text = f"{key} needs the product's place: set radius_mm in [product]"
            raise GenevaError(text, ("limits", key))
        for key in LOADED:
            if limits[key] is not None:
                text = f"{key} needs a load, and without one there is nothing to limit: set "
                refuse_text(nothing, ("limits", key), text + self.output.load_keys)

    def part(self, table: str) -> SpecTable | None:
        """The table of a name, as ``material.wheel`` or ``mass.0`` of a list; None without it."""
        one_of, _, number = table.partition(".")
        if one_of in LISTS:
            exists = number.isdecimal() and int(number) < len(vars(self)[one_of])
            part = vars(self)[one_of][int(number)] if exists else None
        else:
            part = vars(self).get(table.replace(".", "_")) if "_" not in table else None
        return part if isinstance(part, SpecTable) else None

    def table(self, name: str) -> dict[str, Any]:
        """Values of a table by key; empty for a table that the spec does not have.

        >>> Spec(External(6)).table("wheel")
        {'z': 6, 'held_by': None, 'offset_mm': 0.0, 'steps_deg': None, 'stop': False}
        """
        part = self.part(name)
        return {} if part is None else part.as_dict()

    def with_(self, key: str, value: object) -> Self:
        """Return a copy with one key changed, written ``table.key``; None sets its default.

        Raises GenevaError for a key that this spec's kinds do not have, or a value out of range.

        >>> Spec(External(6)).with_("wheel.z", 8).wheel.z
        8
        """
        return self.with_keys({key: value})

    def with_keys(self, values: Mapping[str, Any]) -> Self:
        """Return a copy with several keys changed, as by ``with_``; only the result must be valid.

        >>> Spec(External(6)).with_keys({"wheel.z": 8, "drive.n_rpm": 30}).drive.n_rpm
        30.0
        """
        tables, parts = dict[str, dict[str, Any]](), dict[str, Any]()
        for key, value in values.items():
            table, _, name = key.rpartition(".")
            tables.setdefault(table, {})[name] = value
        for table, new in tables.items():
            part, (one_of, _, number) = self.part(table), table.partition(".")
            if part is None:
                text = ".".join(filter(None, (table, *new)))
                raise GenevaError(f"{text}: this spec has no [{table or text}]", (table, *new))
            if one_of in LISTS:
                parts.setdefault(one_of, [*vars(self)[one_of]])[int(number)] = part.with_keys(new)
            else:
                parts[table.replace(".", "_")] = part.with_keys(new)
        return self.replace(**parts)

    def input_deg(self, crank_deg: float) -> float:
        """Input angle from mid-motion at a crank angle from mid-motion, degrees."""
        before = self.drive_before
        if before is None and self.drive.direct:
            return float(crank_deg)
        shaft_deg = self.drive.input_deg(crank_deg)
        return shaft_deg if before is None else before.input_deg(shaft_deg)

    @property
    def is_flat(self) -> bool:
        """True if wheel and crank are flat outlines that are drawn."""
        return self.wheel.FLAT and not self.no_parts

    @property
    def is_turned(self) -> bool:
        """True if wheel and crank can be checked for collisions in a full turn of the crank."""
        # A rack of any length is checked by the slots that the crank reaches in a turn.
        few = not self.output.turns or self.wheel.z <= Z_DRAWN
        return few and bool(named(self.wheel.NAME, "parts"))

    @property
    def no_parts(self) -> str:
        """The reason why wheel and crank have no outlines; empty if they have."""
        if not named(self.wheel.NAME, "parts"):
            return f'shafts and frame of gearing = "{self.wheel.NAME}" are not built'
        before, drive = self.drive_before, self.drive
        if before is not None:
            pair = f'kind = "{before.NAME}" before kind = "{drive.NAME}" are not built'
            if len(drive.cranks) > 1:
                return f'the gears between several cranks and kind = "{before.NAME}" are not built'
            if before.gears and drive.gears:
                why = "one pair of noncircular-gears with the ratio of both does the same"
                return f"the parts of {pair}: {why}"
            if not before.gears and drive.crank and not drive.direct:
                why = "the shaft between them has no bearing, since the input crank turns below it"
                return f"the parts of {pair}: {why}"
        own: Callable[[Spec], str] | None = thing(self.wheel.NAME, "no_parts")
        if own and (reason := own(self)):
            return reason
        if self.wheel.z > Z_DRAWN:
            return f"wheels of more than {Z_DRAWN} slots are not drawn"
        return ""

    @property
    def moving(self) -> tuple[object, ...]:
        """The values from which engagements are made."""
        size, built = self.size, tuple[object, ...]()
        if size.crank_radius_mm is not None and size.center_distance_mm is not None:
            # a crank as built enters where its roller crosses the slot's axis inside the rim
            built = (size.crank_radius_mm, size.wheel_radius_mm, size.roller_radius_mm)
        own = self.wheel, self.drive, self.drive_before, self.motion
        return (*own, *built, self.given_distance_mm)


class KindTable(NamedTuple):
    """A table whose keys depend on a word in it, such as ``kind``."""

    table: str
    word: Field
    names: Collection[str]  # that the word may be
    find: Callable[[str], type[SpecTable]]  # imports the class of a kind
    shared: Sequence[Field] = ()  # keys of all kinds, which the word alone allows
    without: Sequence[Field] = ()  # keys of kinds that this table lacks

    @property
    def keys(self) -> dict[str, list[Field]]:
        """The keys of each kind; it imports all kinds."""
        return {name: self.keys_of(self.find(name)) for name in self.names}

    def keys_of(self, kind: type[SpecTable]) -> list[Field]:
        """Keys of one kind in this table."""
        return [field for field in fields(kind) if field not in self.without]


_WHEEL = Field("gearing", "", (str,), OneOf(registry.GEARINGS), "external", "type of wheel")
_DRIVE = Field("kind", "", (str,), None, "crank", "type of drive")
_LAW = Field("law", "", (str,), None, None, "motion law of curved slots (`geneva laws`)")
WHEELS = KindTable("wheel", _WHEEL, registry.GEARINGS, registry.gearing)
DRIVES = KindTable("drive", _DRIVE, registry.DRIVES, registry.drive)
LAWS = KindTable("motion", _LAW, registry.LAWS, registry.law, fields(Motion))


# whose shared keys stand in [drive]
_front = _DRIVE._replace(default=None, meaning="drive that turns the input shaft of [drive]")
DRIVES_BEFORE = DRIVES._replace(table=BEFORE, word=_front, without=fields(Drive))
# every table whose keys depend on a word, in the order of a file
KINDS = {"wheel": WHEELS, "drive": DRIVES, BEFORE: DRIVES_BEFORE, "motion": LAWS}


def kind_tables() -> list[KindTable]:
    """The tables of ``KINDS``, with the drives that may be before others; it imports all drives."""
    before = [name for name in registry.DRIVES if registry.drive(name).IN_FRONT]
    return [of._replace(names=before) if of is DRIVES_BEFORE else of for of in KINDS.values()]
