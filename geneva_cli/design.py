"""Design: one spec and all its results, each computed once and cached.

    >>> from geneva_cli import Design, External, SideCrank
    >>> slow = Design(External(6), SideCrank(A=0.6))
    >>> slow.peaks.velocity.max
    0.625
    >>> slow.with_("drive.A", 0.0).timing.motion_deg
    120.0

The modules for a result are imported at its first use, and only here.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext, suppress
from functools import wraps
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, Self, TypeVar

from geneva_cli.errors import GenevaError, Notice, cut
from geneva_cli.kept import cached_property, load_extra, load_named
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec import tables
from geneva_cli.spec.rules import Range, plain, require_mm
from geneva_cli.spec.schema import refuse_keywords
from geneva_cli.table import Table, record_table

if TYPE_CHECKING:
    from geneva_cli.extras.certify.certificate import Certificate
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.plates import MassProperties
    from geneva_cli.geometry.sheet import Drawing, Sheet
    from geneva_cli.loads.cycle import Cycle
    from geneva_cli.loads.load_peaks import LoadSummary
    from geneva_cli.motion.peaks import Peaks
    from geneva_cli.motion.timing import Timing
    from geneva_cli.parts.chosen import ByLoad, Chosen
    from geneva_cli.parts.parts import Parts
    from geneva_cli.specfile.reader import Text
    from geneva_cli.verdict.checks import Check
    from geneva_cli.verdict.report import Report
    from geneva_cli.verdict.strength import Strength

T = TypeVar("T")
P = ParamSpec("P")
CURVES = {"arcs": "arcs", "spline": "cubics"}  # forms in which curved walls are written


def load(path: str, settings: Iterable[str] = (), reverse: bool = False) -> Design:
    """Return the design in a spec file; ``-`` is standard input.

    ``settings`` replace keys of the file, as ``["drive.A=0.6"]``. With ``reverse`` it is
    ``Design.backwards``. Raises GenevaError, ``FILE:LINE: what is wrong; what would be right``, as
    every result does if the design cannot be built.

    >>> load("designs/side-crank-z6.toml", ["drive.A=0.3"]).spec.drive.A
    0.3
    """
    text: Text = load_named("specfile.reader:read")(path, settings)
    design = Design.of(text.spec(), text)
    return design.backwards if reverse else design


def form_of(curves: str) -> str:
    """The form in which curved walls are written, of the option ``--curves``."""
    if curves not in CURVES:
        raise GenevaError(f"--curves {cut(curves)}: it must be arcs or spline")
    return CURVES[curves]


def _with_chosen(size: tables.Size, chosen: Mapping[str, Chosen]) -> tables.Size:
    """Sizes with chosen ones, which are by their keys with the table."""
    return size.replace(**{key.partition(".")[2]: one.value for key, one in chosen.items()})


class answer(cached_property[T]):
    """A result that is computed once; its errors are located at the spec's line."""

    def __get__(self, design: Any, owner: type | None = None) -> Any:
        if design is None:
            return self
        kept = vars(design)
        if self.attrname not in kept:
            text = design.text
            with text.located() if text else nullcontext():
                kept[self.attrname] = self.func(design)
        return kept[self.attrname]


def question(ask: Callable[Concatenate[Any, P], T]) -> Callable[Concatenate[Any, P], T]:
    """A method that takes NumPy's scalars and known keywords only; its errors are located."""
    *known, _ = ask.__annotations__  # the last one is what it returns

    @wraps(ask)
    def method(design: Any, /, *values: P.args, **named: P.kwargs) -> T:
        refuse_keywords(f"{ask.__name__}()", named, known)
        keywords = {name: plain(value) for name, value in named.items()}
        text = design.text
        with text.located() if text else nullcontext():
            return ask(design, *map(plain, values), **keywords)

    return method


class Design:
    """A Geneva mechanism: its inputs, and the results that follow from them.

    Values are checked when they are created. Units are degrees, millimetres, newtons, newton metres
    and megapascals; velocity, acceleration and jerk are derivatives by the input's radians.

    >>> Design(External(6), SideCrank(A=0.6)).timing.motion_s  # at 60 rpm
    0.5072580347148502
    """

    is_backwards = False  # True of a design made by ``backwards``
    spec: Spec
    text: Text | None  # of the file that the design was read from; None for one made in Python
    is_drawn: bool  # drawings replace the outlines of its parts: [outline]

    def __new__(cls, *_: object, **named: object) -> Self:
        """Refuse an unknown keyword, with the nearest known one."""
        refuse_keywords(cls.__name__, named, [*cls.__init__.__annotations__][:-1])
        return super().__new__(cls)

    def __init__(
        self,
        wheel: Gearing,
        drive: Drive | None = None,
        motion: Motion | None = None,
        *,
        size: tables.Size | None = None,
        load: tables.Load | None = None,
        mass: Sequence[tables.Mass] = (),
        support: tables.Support | None = None,
        motor: tables.Motor | None = None,
        shaft: tables.Shaft | None = None,
        material_wheel: tables.WheelMaterial | None = None,
        material_roller: tables.RollerMaterial | None = None,
        tolerance: tables.Tolerance | None = None,
        product: tables.Product | None = None,
        limits: tables.Limits | None = None,
        accept: tables.Accept | None = None,
        drawing: tables.TitleBlock | None = None,
        outline: tables.Outline | None = None,
        title: str = "",
        drive_before: Drive | None = None,
    ) -> None:
        inputs = {name: value for name, value in locals().items() if value is not None}
        del inputs["self"]
        vars(self).update(vars(Design.of(Spec(**inputs))))

    @classmethod
    def of(cls, spec: Spec, text: Text | None = None) -> Design:
        """Return the design of a spec; ``text`` is the file that it was read from.

        >>> Design.of(Spec(External(6))).spec.wheel.z
        6
        """
        design = object.__new__(cls)
        design.spec, design.text = spec, text
        design.is_drawn = spec.outline.wheel is not None or spec.outline.crank is not None
        return design

    def __getstate__(self) -> dict[str, object]:
        """The inputs without the answers, which a pickled copy computes again."""
        inputs = ("spec", "text", "is_backwards", "is_drawn")
        return {name: value for name, value in vars(self).items() if name in inputs}

    def __repr__(self) -> str:
        """The design as a Python expression, without default values.

        >>> Design(External(6), SideCrank(A=0.6), title="feed")
        Design(wheel=External(z=6), drive=SideCrank(A=0.6), title='feed')
        """
        return f"Design{repr(self.spec.replace(path='', files=())).removeprefix('Spec')}"

    def with_(self, key: str, value: Any) -> Design:
        """Return the design with one key changed, ``table.key`` as in the file; None: its default.

        >>> Design(External(6)).with_("wheel.z", 8).timing.motion_deg
        135.0
        """
        return Design.of(self.spec.with_(key, plain(value)))

    @answer
    def mechanism(self) -> Mechanism:
        """The machine: its engagements over a period. Raises GenevaError if it cannot be built.

        >>> round(Design(External(6)).mechanism.ratio, 12)  # crank over centre distance
        0.5
        """
        return build(self.spec)

    @answer
    def backwards(self) -> Design:
        """The same machine turning the other way, as one that turns forwards seen from behind.

        Entry and exit change places, slots are offset to the other side, a law s(u) becomes
        1 - s(1 - u). Sizes that the load chose stay.

        >>> offset = Design(External(6, offset_mm=12.0))
        >>> [round(d.peaks.ends.acceleration_entry, 4) for d in (offset, offset.backwards)]
        [0.5342, 0.6281]
        """
        spec, plan, motion = self.spec, self.mechanism.plan, self.spec.motion
        if motion:
            law = load_named("motion.given_motion:run_backwards")(motion.law)
            motion = motion.replace(law=law)
        loaded: Mapping[str, Chosen] = {}
        with suppress(GenevaError):  # sizes that leave no parts: the checks say why
            loaded = self.chosen_by_load.sizes
        turned = spec.replace(
            wheel=spec.wheel.backwards,
            drive=spec.drive.backwards(plan),
            drive_before=spec.drive_before and spec.drive_before.backwards(plan),
            motion=motion,
            size=_with_chosen(spec.size, loaded),
            title=", ".join(text for text in (spec.title, "backwards") if text),
        )
        design = Design.of(turned, self.text)
        design.is_backwards = True
        return design

    @answer
    def size(self) -> tables.Size:
        """The sizes, mm; None for those that the machine lacks, or that only its parts know.

        >>> Design(External(6)).size.wheel_thickness_mm
        10.0
        """
        return load_named("parts.machine_sizes:built")(self.mechanism)

    @answer
    def chosen(self) -> dict[str, Chosen]:
        """Every size that a rule or the load chose, by its key; ``geneva size`` writes them.

        >>> Design(External(6)).chosen["size.pin_mm"]
        Chosen(value=5.0, why='default r')
        """
        from geneva_cli.parts.chosen import chosen, detail_sizes

        if not self.spec.no_parts:
            _ = self.parts.built
        return chosen(self.mechanism, detail_sizes(self.mechanism))

    @answer
    def sized(self) -> Design:
        """The same machine, all of whose chosen sizes are in its spec, so that they stay.

        >>> fast = Design(External(6), load=Load(torque_Nm=15.0)).sized.with_("drive.n_rpm", 90.0)
        >>> fast.spec.size.pin_mm
        5.0
        """
        return Design.of(self.spec.replace(size=_with_chosen(self.spec.size, self.chosen)))

    @answer
    def chosen_by_load(self) -> ByLoad:
        """The sizes that the load chose, and those of the file where an option changed them.

        >>> Design(External(6), load=Load(torque_Nm=15.0)).chosen_by_load.words
        'crank shaft 12, wheel shaft 15, pin 5, arm 10 thick, wheel 10 thick'
        """
        from geneva_cli.parts.chosen import ByLoad, by_load

        written: dict[str, Chosen] = {}
        if self.text and self.text.set_keys:
            with suppress(GenevaError):  # the file may be no machine without its options
                written = by_load(build(self.text._replace(set_keys=()).spec()))
        return ByLoad(by_load(self.mechanism), written)

    @answer
    def timings(self) -> list[Timing]:
        """Motion, dwell and cycle of each engagement in a period: degrees and seconds.

        >>> [t.index_deg for t in Design(External(6, steps_deg=(72, 48))).timings]
        [72.0, 48.0]
        """
        return load_named("motion.timing:timings")(self.mechanism)

    @property
    def timing(self) -> Timing:
        """Motion, dwell and cycle of the first engagement.

        >>> Design(External(6)).timing.dwell_deg
        240.0
        """
        return self.timings[0]

    @answer
    def peaks(self) -> Peaks:
        """Greatest velocity, acceleration, jerk and power of a period, and their input angles.

        >>> peak = Design(External(6)).peaks.acceleration
        >>> round(peak.max, 12), round(peak.at_deg, 9)
        (1.349637275902, -22.903061866)
        """
        return load_named("motion.peaks:worst")(self.mechanism)

    @answer
    def peaks_table(self) -> Table:
        """The peaks as ``geneva peaks`` prints them, with each engagement if they differ.

        >>> Design(External(6)).peaks_table.to_dict()["velocity.max"]
        1.0
        """
        if self.is_drawn:
            return self._of_drawing("peaks")
        return load_named("motion.peaks:peaks_table")(self.mechanism)

    @question
    def certificate(self, quantity: str, intervals: int | None = None) -> Certificate:
        """Proved bounds of a peak, with all places where it may be; needs python-flint.

        ``quantity`` is velocity, acceleration, jerk or power; or wheel_torque_Nm, input_torque_Nm
        or pin_force_N, of straight slots. At most so many ``intervals`` a motion (2,000) are used.

        >>> Design(External(6)).certificate("acceleration").text
        'acceleration.max in [1.34963727590190, 1.34963727590191], at two mirrored places, proved'
        """
        limit = {} if intervals is None else {"limit": intervals}
        return load_extra("certify", "certificate")(self.mechanism, quantity, **limit)

    @question
    def certified_peaks(self, for_people: bool = False) -> Table:
        """The peaks with the certificate of each, a row; ``for_people`` a line of text.

        >>> Design(External(6)).certified_peaks(for_people=True).to_dict()["certificate"][2]
        'jerk.max in [5.99999999999999, 6.00000000000001], unique, proved'
        """
        return load_extra("certify", "peaks")(self.peaks_table, self.mechanism, for_people)

    @question
    def certified_loads(self, for_people: bool = False) -> Table:
        """Certificates of the greatest loads, a row each; ``for_people`` a line of text.

        >>> table = Design(External(6), load=Load(0.4, 15)).certified_loads()
        >>> [row["proved"] for row in table.to_dict()["certificate"]]
        [True, True, True]
        """
        own = {"spec": self.spec.path, "title": self.spec.title or None}
        certificates = load_extra("certify", "loads")(self.mechanism, for_people)
        return record_table(own | {"certificate": certificates})

    @question
    def motion(
        self, samples: int = 361, turns: int | None = None, at_deg: Sequence[float] | None = None
    ) -> Table:
        """``samples`` rows over a period from the first entry, evenly spaced in the input angle.

        With ``turns`` of the input there is also a row at each entry, exit and jump. With
        ``at_deg`` the rows are at those input angles from mid-motion instead.

        >>> Design(External(6)).motion(at_deg=[0.0]).to_dict()["velocity"].tolist()
        [1.0]
        """
        from geneva_cli.motion.motion_table import angles_table, motion_table, turns_table

        if self.is_drawn and turns is not None:
            raise GenevaError("--turns: a drawing's motion is that of one turn; leave it out")
        if self.is_drawn:
            return self._of_drawing("motion", samples, at_deg)
        if at_deg is not None:
            return angles_table(self.mechanism, at_deg)
        if turns is not None:
            return turns_table(self.mechanism, samples, turns)
        return motion_table(self.mechanism, samples)

    @question
    def figure(self, pick: Sequence[str] = ()) -> Figure:
        """Curves of motion and loads over a cycle, one panel for each quantity.

        ``pick`` are names of quantities, as ``jerk`` or ``pin_force_N``; without, the usual ones.
        ``geneva_cli.output.show_figure`` writes it.

        >>> panels = Design(External(6)).figure(["velocity", "jerk"]).panels
        >>> [mark.y for mark in panels[1].curves[0].marks]
        [-6.0]
        """
        return load_named("loads.cycle_figures:figure")({self.spec.title: self.cycle}, pick)[0]

    @answer
    def cycle(self) -> Cycle:
        """The cycle under load: states at any input angles, and exact extremes.

        >>> cycle = Design(External(6), load=Load(torque_Nm=15)).cycle
        >>> round(cycle.extremes["input_torque_Nm"].mean, 9)  # of 15 N m in a sixth of a turn
        2.5
        """
        return load_named("loads.cycle:cycle_of")(self.mechanism)

    @answer
    def loads(self) -> Mapping[str, LoadSummary[float | None]]:
        """Greatest, least, mean and root-mean-square of each load over a period; None if unknown.

        >>> loaded = Design(External(6), load=Load(inertia_kgm2=0.4, torque_Nm=15))
        >>> round(loaded.loads["pin_force_N"].max, 3)
        649.007
        """
        return load_named("loads.load_tables:summaries")(self.cycle)

    @answer
    def loads_table(self) -> Table:
        """The loads as ``geneva loads`` prints them: ``loads``, reversals, sizing and life.

        >>> Design(External(6), load=Load(0.4, 15)).loads_table.to_dict()["reversals_deg"]
        (10.34475855916..., 43.0339138141...)
        """
        return self._loads(for_people=False)

    def _loads(self, for_people: bool) -> Table:
        from geneva_cli.loads.load_tables import loads_table, missing
        from geneva_cli.loads.sizing import WHEEL_INERTIA, sizing_needs
        from geneva_cli.verdict.strength import OF_LIFE

        _ = self.loads  # all quantities at once, some of which the life needs
        # without a load every quantity needs one, and that is reported already
        needed, of, own = list[str](), self.strength, self.wheel_plate
        # the wheel's own inertia is shown behind that at its shaft
        both = dict.fromkeys(("inertia_kgm2", WHEEL_INERTIA), own and own.inertia_kgm2)
        sizing = both | of.table("sizing")
        if self.cycle.is_loaded:
            needed = of.missing(OF_LIFE) + sizing_needs(sizing, self.mechanism.output.lacks)
        notes = (*self.warnings, *missing(self.cycle), *needed)
        impact = self.strength.table("shock.reversal")
        answers = {"shock.reversal": impact, "sizing": sizing, "life": self.life}
        last = {"warnings": notes, "chosen": self.chosen_by_load.record}
        return loads_table(self.cycle, answers, last, for_people)

    @answer
    def wheel_plate(self) -> MassProperties | None:
        """The wheel's own mass, centroid and inertia; None without a thickness, or without parts.

        >>> round(Design(External(6), size=Size(face_width_mm=20)).wheel_plate.mass_kg, 3)
        2.087
        """
        return load_named("parts.machine_sizes:wheel_body")(self.mechanism)

    @answer
    def life(self) -> dict[str, float | None]:
        """Stresses of pin and horn, and the roller's life; None if unknown.

        >>> held = Design(External(6), size=Size(200, 8), load=Load(inertia_kgm2=0.4, torque_Nm=15))
        >>> round(held.life["roller_turns_per_motion"], 12)
        2.655148449921
        """
        return self.strength.table("life")

    @answer
    def strength(self) -> Strength:
        """The strength of pin, horn, lock and shafts, and the life, by the names of a report.

        >>> held = Design(External(6), size=Size(face_width_mm=20), load=Load(0.4, torque_Nm=15))
        >>> round(held.strength["strength.pin.stress_MPa"], 1)
        192.7
        """
        return load_named("verdict.strength:strength")(self.mechanism)

    @answer
    def loads_page(self) -> Table:
        """The loads for people: one row for each quantity, and notes on unknown ones; no warnings.

        >>> Design(External(6), load=Load(0.4, 15)).loads_page.to_dict()["loads"][0]["quantity"]
        'omega_rad_s'
        """
        return load_named("verdict.failures:below_summary")(self._loads(True), ("title", "chosen"))

    @question
    def load_cycle(self, samples: int = 361) -> Table:
        """``samples`` rows of the loads over a period with dwells, evenly spaced in input angle.

        >>> Design(External(6), load=Load(torque_Nm=15)).load_cycle(4).to_dict()["pin_force_N"]
        array([173.20508076, 173.20508076,   0.        ,   0.        ])
        """
        return load_named("loads.load_tables:cycle_table")(self.cycle, samples)

    @question
    def vibration(self, period_ratio: float | None = None, damping: float | None = None) -> Table:
        """The load on an elastic shaft: a record of the vibration after an index.

        ``period_ratio`` (motion time over natural period) and ``damping`` (ratio) replace values of
        [shaft]. Raises GenevaError if no stiffness or no inertia is known.

        >>> round(Design(External(3)).vibration(0.5, damping=0.02)["residual_share"], 12)
        0.871288725706
        """
        from geneva_cli.loads.vibration.vibration import oscillator, values

        found = values(self.mechanism, oscillator(self.mechanism, period_ratio, damping))
        found["warnings"] = (*self.ideal_notes, *found["warnings"])
        head = {"spec": self.spec.path, "title": self.spec.title}
        return record_table(head | found, self.spec.title)

    @question
    def spectrum(
        self, samples: int = 401, period_ratio: float | None = None, damping: float | None = None
    ) -> Table:
        """The vibration after an index, over speeds from half to twice the design's.

        >>> Design(External(6)).spectrum(3, period_ratio=10.0)["n_rpm"].round(9)
        array([ 30.,  60., 120.])
        """
        from geneva_cli.loads.vibration.vibration import oscillator, spectrum

        shaft = oscillator(self.mechanism, period_ratio, damping)
        return spectrum(self.mechanism, shaft, samples)

    @question
    def slot(self, tolerance_mm: float = 0.001, samples: int | None = None) -> Table:
        """The slot's pitch curve and flanks in the wheel's frame, mm; see ``part_table``.

        >>> Design(External(6)).slot(samples=5).names[:4]
        ('input_deg', 'wheel_deg', 'x_mm', 'y_mm')
        """
        return self.part_table("slot", tolerance_mm, samples)

    @question
    def part_table(
        self, part: str, tolerance_mm: float = 0.001, samples: int | None = None
    ) -> Table:
        """A part as a table of points, mm: ``slot``, ``gears`` or ``groove``.

        Points are for a chord tolerance; or ``samples`` rows, evenly spaced in the input angle.

        >>> geared = Design(External(6), EllipticalGears(eccentricity=0.3))
        >>> len(geared.part_table("gears", samples=5))
        5
        """
        from geneva_cli.drawings.catalogue import part_table

        return part_table(self.mechanism, part, tolerance_mm, samples)

    @question
    def is_table(self, part: str, drawn: bool) -> bool:
        """Return True if a part is a table of points; ``drawn`` means that a drawing is requested.

        >>> wheel = Design(External(6))
        >>> wheel.is_table("slot", drawn=False), wheel.is_table("wheel", drawn=False)
        (True, False)
        """
        return bool(load_named("drawings.catalogue:table_of")(self.mechanism, part, drawn))

    @answer
    def parts(self) -> Parts:
        """The parts, with their outlines and their full turn.

        >>> Design(External(6)).parts.turn.holds  # its lock, in the dwell
        True
        """
        return load_named("parts.parts:parts_of")(self.mechanism)

    @question
    def drawing(
        self,
        part: str,
        tolerance_mm: float = 0.001,
        curves: str = "arcs",
        kerf_mm: float | None = None,
    ) -> Drawing:
        """A part as lines and arcs, or (``spline``) cubics, for DXF or SVG.

        Parts are those of ``profile --part``. ``kerf_mm`` gives the paths of a cut of that width,
        or a GenevaError if it does not fit.

        >>> Design(External(6)).drawing("wheel").layers
        ('WHEEL', 'BORE')
        """
        from geneva_cli.drawings.catalogue import part_drawing, require_cut

        picture = part_drawing(self.parts, part, tolerance_mm, form_of(curves))
        if kerf_mm is None:
            return picture
        require_cut(part)
        return load_named("geometry.offsets:paths")(picture, kerf_mm)

    @question
    def cutter(self, part: str, cutter_mm: float) -> tuple[str, list[str]]:
        """The reason why a milling cutter cannot cut a part, empty if it can; and warnings.

        >>> Design(External(6)).cutter("wheel", 12.0)[0].partition(": an ")[2]
        'inner radius of 5 mm is narrower; use a smaller one'
        """
        load_named("drawings.catalogue:require_cut")(part, "--cutter")
        return load_named("geometry.offsets:judged")(self.drawing(part), cutter_mm)

    @question
    def sheet(self, tolerance_mm: float = 0.001, curves: str = "arcs") -> Sheet:
        """A drawing sheet of the parts with dimensions, to a standard scale; mm on paper.

        >>> small = Design(External(4), size=Size(center_distance_mm=30)).sheet(0.01)
        >>> small.scale, small.width, small.height
        (2.0, 420.0, 297.0)
        """
        from geneva_cli.drawings.catalogue import part_sheet

        return part_sheet(self.parts, tolerance_mm, form_of(curves))

    @question
    def save(
        self, path: str, part: str = "", tolerance_mm: float | None = None, force: bool = False
    ) -> None:
        """Write a part to a file, as ``geneva profile`` does; the extension gives the format.

        Without ``part``, the file's name decides (``wheel.dxf``, ``sheet.pdf``, ``slot.csv``), else
        the assembly is written. Raises GenevaError if the machine jams, unless ``force``.

        >>> import tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     Design(External(6)).save(f"{folder}/wheel.dxf")
        """
        from geneva_cli.drawings.catalogue import PARTS, is_sheet
        from geneva_cli.output import DRAWN, draw, draw_sheet, named, show, usual

        curves, tolerance_mm = usual(path, "", tolerance_mm)
        stem = os.path.splitext(os.path.basename(path))[0]
        part = part or (stem if stem in PARTS else "assembly")
        sheet, files = is_sheet(part), self.spec.files
        if not sheet and self.is_table(part, named(path, "") in DRAWN):
            show(self.part_table(part, tolerance_mm), path, inputs=files)
            return
        refused = self.judge(part)[0] if self.spec.is_turned and not force else ""
        if refused:
            raise GenevaError(f"{cut(path, 300)}: not written: {refused}")
        if sheet:
            draw_sheet(self.sheet(tolerance_mm, curves), path, inputs=files)
        else:
            draw(self.drawing(part, tolerance_mm, curves), path, inputs=files)

    @answer
    def checks(self) -> list[Check]:
        """Every check: its value, its limit and, if it fails, the nearest change that passes.

        >>> first = Design(External(6)).checks[0]
        >>> first.name, first.value, first.must_be, first.limit, first.passes
        ('dwell_deg', 240.0, 'at least', 0.0, True)
        """
        prove = load_named("verdict.checks.motion_checks:proof")
        return [*self._judged, *([] if self.is_drawn else prove((), self.parts))]

    def _of_drawing(self, answer: str, *values: object) -> Any:
        """An answer about the drawings that replace the outlines."""
        if self.is_backwards:
            raise GenevaError("--reverse: `geneva check` turns drawings both ways; leave it out")
        return load_extra("outline", answer)(self.mechanism, *values)

    @question
    def drawing_over(self, drawing: Drawing) -> Drawing:
        """Return a drawing of a part with that of ``[outline]``, if any, over it on layer OUTLINE.

        >>> plain = Design(External(6))
        >>> plain.drawing_over(plain.drawing("wheel")).layers
        ('WHEEL', 'BORE')
        """
        if not self.is_drawn:
            return drawing
        return self._of_drawing("over", drawing)

    @question
    def proved_to(self, to_mm: float) -> list[Check]:
        """Every check, with the gap proved to a tolerance in mm, at most the roller's radius.

        >>> Design(External(6)).proved_to(0.0002)[-1].why
        'collision-free, proved to 0.2 µm (608 intervals)'
        """
        allowed = Range(0.0, self.mechanism.roller_radius_mm, "(]")
        require_mm("--certify", to_mm, allowed, "the roller's radius")
        prove = load_named("verdict.checks.motion_checks:proof")
        return [*self._judged, *([] if self.is_drawn else prove((), self.parts, to_mm))]

    @answer
    def _judged(self) -> list[Check]:
        """Every check but the proof."""
        from geneva_cli.verdict.checks import all_pass, every_check

        if self.is_drawn:
            return self._of_drawing("checks")
        rows = [*every_check(self.parts)]
        if all_pass(rows):
            return rows
        return load_named("verdict.advice:advised")(self.mechanism, rows)

    @property
    def passes(self) -> bool:
        """True if no check fails; a check without a proof does not fail.

        >>> Design(External(6), limits=Limits(velocity_max=0.8)).passes
        False
        """
        return load_named("verdict.checks:all_pass")(self.checks)

    @question
    def judge(self, part: str = "wheel") -> tuple[str, list[str]]:
        """The reason why a part cannot be written, empty if it can; and other problems.

        >>> Design(External(6)).judge()
        ('', [])
        """
        parts = load_named("drawings.catalogue:parts_having")(self.parts, part)
        if parts.mechanism.spec.is_flat:
            _ = parts.outlines  # their error comes before all checks
        of = self if parts is self.parts else Design.of(parts.mechanism.spec)
        return load_named("verdict.failures:failures")(of._judged, parts)

    @question
    def tolerance(
        self, samples: int = 65536, seed: int = 0, radius_mm: float | None = None
    ) -> Table:
        """The effects of the deviations in ``[tolerance]``, the record of ``geneva tolerance``.

        >>> indexed = Design(External(6), tolerance=Tolerance(slot_angle_deg=0.02))
        >>> indexed.tolerance().to_dict()["dwell_position.worst_arcsec"]
        72.0
        """
        from geneva_cli.verdict.tolerance import tolerance_table

        self.refuse_drawn("tolerances are those")
        return tolerance_table(self.mechanism, self.parts, samples, seed, radius_mm)

    @answer
    def motion_warnings(self) -> list[Notice]:
        """Warnings about the motion and the slots, which need neither loads nor parts.

        >>> [text.name for text in Design(External(30)).motion_warnings]
        ['many-slots']
        """
        own = load_named("verdict.motion_warnings:motion_warnings")(self.mechanism)
        return self.spec.accept.applied(own)

    @answer
    def warnings(self) -> list[Notice]:
        """All warnings about motion, loads and parts, as in check, report and loads.

        >>> [text.name for text in Design(External(30)).warnings]
        ['many-slots']
        """
        own = self.spec.accept.applied(load_named("verdict.warnings:warnings")(self.parts))
        return [*self.ideal_notes, *self.check_warnings, *own] if self.is_drawn else own

    @answer
    def check_warnings(self) -> list[Notice]:
        """The warnings of ``geneva check``: those about drawings alone, if there are any.

        >>> Design(External(6)).check_warnings
        []
        """
        if self.is_drawn:
            return self.spec.accept.applied(self._of_drawing("warnings"))
        return self.warnings

    @property
    def ideal_notes(self) -> list[Notice]:
        """A warning that loads and parts of a machine with drawings are those of its formulas.

        >>> [one.name for one in Design(External(6), outline=Outline("wheel.dxf")).ideal_notes]
        ['ideal-machine']
        """
        text = (
            "loads, curves, parts and certificates are those of the ideal machine of this spec, "
            "not of the drawings in [outline]; check, peaks, motion and animate turn the drawings"
        )
        return self.spec.accept.applied([Notice("ideal-machine", text)] if self.is_drawn else [])

    @question
    def refuse_drawn(self, what: str) -> None:
        """Raise GenevaError for a machine with drawings; ``what`` begins the message.

        >>> Design(External(6)).refuse_drawn("the files for a shop are those")
        """
        if self.is_drawn:
            text = f"{what} of our own parts, which drawings replace: leave out [outline]"
            raise GenevaError(text, ("outline",))

    @answer
    def unused_acceptances(self) -> list[str]:
        """Names of warnings in ``[accept]`` that do not occur.

        >>> Design(External(6), accept=Accept(many_slots="agreed")).unused_acceptances
        ['many-slots']
        """
        if not self.spec.accept.reasons:
            return []
        # of drawings without turning parts of ours, which check does not need
        drawn = [*self.ideal_notes, *self.check_warnings] if self.is_drawn else self.warnings
        return self.spec.accept.unused(drawn)

    @answer
    def report(self) -> Report:
        """The whole page: a record of named values, whether all checks pass, and the warnings.

        >>> Design(External(6)).report.table["timing.k_r"]
        0.5
        """
        from geneva_cli.verdict.report import report

        return report(self.parts, self.checks, self.warnings, self.chosen_by_load)
