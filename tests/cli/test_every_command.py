"""Every command on every design of the folder, as its file stands and under loads.

Each numeric key that a design has is varied in `sweep`, with `--check`, `--pareto` and `--best`,
or in `compare`: their values are those of each single design. `make test` takes a key and two
commands of each design and load, which their names choose; `make stress` takes all, in half an hour
on two cores.
"""

import csv
import io
import itertools
import json
import math
import tomllib
import zlib
from functools import cache
from typing import NamedTuple

import pytest
import repo
from agreement import agrees, quantities
from sampling import some
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.spec.tables import LISTS
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.verdict.checks import BEFORE_TURN, OF_TURN
from geneva_cli.verdict.quantities.groups import GROUPS

DESIGNS = sorted(path.stem for path in repo.DESIGNS.glob("*.toml"))
# Settings of each load, of which a design takes those that its kind has.
LOADS = {
    "as it stands": "",
    "inertia alone": "load.inertia_kgm2=0.4 load.mass_kg=4 load.torque_Nm=0 load.force_N=0 "
    "load.friction=0 load.guide_friction=0",
    "all loads": "load.inertia_kgm2=0.3 load.mass_kg=3 load.torque_Nm=5 load.force_N=15 "
    "load.friction=0.1 load.guide_friction=0.1 load.dwell_torque_Nm=3 size.face_width_mm=10 "
    "size.slot_clearance_mm=0.01 size.lock_clearance_mm=0.02 support.friction=0.01 "
    "support.radius_mm=50 support.force_N=20 motor.speed_variation=0.1 motor.inertia_kgm2=0.01 "
    "shaft.stiffness_Nm_rad=2000 shaft.damping_ratio=0.02 shaft.wheel_diameter_mm=20 "
    "shaft.crank_diameter_mm=18 shaft.wheel_overhang_mm=30 shaft.wheel_span_mm=40 "
    "shaft.crank_overhang_mm=25 shaft.crank_span_mm=45 shaft.shear_stress_max_MPa=50 "
    "material.wheel.stress_max_MPa=300 "
    "material.roller.stress_max_MPa=300 material.roller.dynamic_capacity_N=9000 "
    "tolerance.center_distance_mm=0.02 tolerance.slot_angle_deg=0.05 product.radius_mm=300 ",
}
pytestmark = pytest.mark.usefixtures("no_advice")  # which takes seconds, and nothing here reads
every = pytest.mark.parametrize(
    ("design", "under"), [(design, under) for design in DESIGNS for under in LOADS]
)

COMMANDS = {
    "peaks": "peaks SPEC --format FORMAT",
    "motion": "motion SPEC --samples 73 --format FORMAT",
    "profile": "profile SPEC --tolerance 0.05 --format FORMAT",
    "assembly": "profile SPEC --part assembly -o OUT/assembly.dxf",
    "check": "check SPEC --format FORMAT",
    "loads": "loads SPEC --format FORMAT",
    "cycle": "loads SPEC --samples 73 -o OUT/cycle.csv",
    "vibration": "vibration SPEC --period-ratio 4.2 --samples 9 --format FORMAT",
    "tolerance": "tolerance SPEC --samples 64 --format FORMAT --set tolerance.slot_angle_deg=0.05",
    "plot": "plot SPEC --format FORMAT",
    "svg": "plot SPEC -o OUT/plot.svg",
    "report": "report SPEC --format FORMAT",
    "pdf": "report SPEC -o OUT/report.pdf",
    "animate": "animate SPEC -o OUT/page.html",
    "export": "export SPEC -o OUT/shop",
    "compare": "compare SPEC --format FORMAT",
}
FORMATS = "table", "csv", "json", "md"
FAILING = "check", "report", "pdf", "profile", "assembly", "export"  # status 1 of a failing design


@pytest.mark.sampled(60)
@every
def test_every_command(design, under, tmp_path):
    """It ends with the right status and prints finite numbers; a table has equal rows."""
    path, *settings = spec_of(design, under)
    one = single(path, *settings)
    for name in drawn(COMMANDS, f"{design} {under}")[: some(None, 2)]:
        form = drawn(FORMATS, f"{design} {under} {name}")[0]
        words = COMMANDS[name].replace("OUT", str(tmp_path)).replace("FORMAT", form).split()
        words = [path if word == "SPEC" else word for word in words]
        if name == "tolerance" and not is_built(path, *settings, words[-1]):  # a rack, two cranks
            continue
        result = run(words, settings)
        fails = name in FAILING and failed(one)
        # parts of a failing design may have no form to be written: status 2, with the part's name
        assert result.exit_code in ((0, 1, 2) if fails else (0,)), (name, result.output)
        assert "nan" not in result.stdout.lower().replace("nance", ""), name
        if "json" in words:
            assert all(map(math.isfinite, numbers(json.loads(result.stdout)))), name
        if "csv" in words and "--part" not in words:
            rows = list(csv.reader(io.StringIO(result.stdout)))
            assert len(rows) > 1 and {len(row) for row in rows} == {len(rows[0])}, name


@pytest.mark.sampled(40)
@every
def test_every_key(design, under):
    """Varied in a sweep or a comparison it gives the values of each design alone."""
    path, *settings = spec_of(design, under)
    keys, wrong = numeric_keys(path, *settings), []
    varied = (varied_key(path, settings, key) for key in drawn(keys, f"{design} {under}"))
    for one in itertools.islice(filter(None, varied), some(None, 1)):
        study = drawn(STUDIES, f"{design} {under} {one.key}")[0]
        wrong += [f"{study} of {one.key} = {one.pair}: {text}" for text in STUDIES[study](one)]
    assert wrong == []


@pytest.mark.parametrize("design", DESIGNS)
def test_a_design_says_what_it_is(design):
    assert (repo.DESIGNS / f"{design}.toml").read_text(encoding="utf-8").startswith("# ")


class Varied(NamedTuple):
    """A key with two values, both of which make a machine."""

    path: str
    settings: list[str]
    key: str
    pair: tuple[float, float]

    @property
    def designs(self):
        return {
            value: single(self.path, *self.settings, f"{self.key}={value}") for value in self.pair
        }

    def run(self, command, *options):
        """What a command prints of them."""
        vary = f"{self.key}={self.pair[0]},{self.pair[1]}"
        result = run([command, self.path, "--vary", vary, *options], self.settings)
        assert result.exit_code == 0, result.output
        return result.stdout

    def swept(self, *options):
        """Yield the rows of a sweep, each with its design alone."""
        printed = self.run("sweep", "--jobs", "1", "--format", "csv", *options)
        for row in csv.DictReader(io.StringIO(printed)):
            cells = {name: cell_of(text) for name, text in row.items()}
            assert cells.pop("error") is None
            yield cells, self.designs[cells.pop(self.key)]

    @property
    def goal(self):
        """A quantity that both designs have."""
        both = [quantities(design.mechanism) for design in self.designs.values()]
        names = "loads.pin_force_N.max", "acceleration.max", "timing.dwell_s"
        return next(name for name in names if None not in [one[name] for one in both])


def in_sweep(varied, *options):
    """Yield the quantities that differ from those of a design alone, in words."""
    for row, design in varied.swept(*options or ("--pick", ",".join(BATCHED))):
        alone = quantities(design.mechanism)
        for name, value in row.items():
            if not agrees(name, value, alone, design.spec):
                yield f"{name} {value}, alone {alone[name]}"


def in_check(varied):
    """Yield the verdicts, and values of checks, that differ from those of a design alone."""
    for row, design in varied.swept("--check", "--pick", ",".join(CHECKS)):
        bad = failed(design)
        alone = dict.fromkeys(CHECKS) | {f"checks.{c.name}": c.value for c in design.checks}
        alone |= {"checks.passes": not bad, "checks.failed": " ".join(bad) or None}
        for name, value in row.items():
            # a stress at a shallow peak agrees in most digits; a gap to the walls' accuracy
            near = value == alone[name] or value == pytest.approx(alone[name], rel=1e-9, abs=1e-9)
            if not near:
                yield f"{name} {value}, alone {alone[name]}"


def in_front(varied):
    """Yield what differs in the best of two opposite goals, which both designs may be."""
    yield from in_sweep(varied, "--pareto", f"min:{varied.goal},max:timing.cycle_s")


def as_best(varied):
    """Yield the best value if it is not the lesser of the two designs', to its 9 digits."""
    lines = varied.run("sweep", "--jobs", "1", "--best", f"min:{varied.goal}").splitlines()
    best = float(lines[0].split(": ")[-1].rstrip("."))
    least = min(quantities(one.mechanism)[varied.goal] for one in varied.designs.values())
    if not tomllib.loads("\n".join(lines))["wheel"] or best != pytest.approx(least, rel=1e-8):
        yield f"{lines[0]}, alone {least}"


def in_comparison(varied):
    """Yield the quantities that differ from those of a design alone: it is computed alone."""
    columns = [f"{varied.key}={value}" for value in varied.pair]
    alone = [quantities(design.mechanism) for design in varied.designs.values()]
    for row in json.loads(varied.run("compare", "--format", "json"))["rows"]:
        for column, one in zip(columns, alone, strict=True):
            if (name := row["quantity"]) in one and row[column] != one[name]:
                yield f"{name} {row[column]}, alone {one[name]}"


CHECKS = tuple(f"checks.{name}" for name in (*BEFORE_TURN, *OF_TURN))
BATCHED = tuple(name for group in GROUPS for name in group.batched)
STUDIES = {
    "sweep": in_sweep,
    "a batch": in_sweep,  # it has most to compare
    "all quantities": in_sweep,
    "sweep --check": in_check,
    "sweep --pareto": in_front,
    "sweep --best": as_best,
    "compare": in_comparison,
}


def run(words, settings):
    """The result of a command; its traceback fails the test."""
    options = [word for setting in settings for word in ("--set", setting)]
    result = CliRunner().invoke(app, [*words, *options])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result


@cache
def spec_of(design, under):
    """A design's file and the settings of a load that its kind has."""
    words = [str(repo.DESIGNS / f"{design}.toml")]
    for setting in LOADS[under].split():
        if is_built(*words, setting):
            words.append(setting)
    return tuple(words)


@cache
def single(path, *settings):
    """The design alone."""
    return load(path, settings)


def is_built(path, *settings):
    try:
        return bool(load(path, settings).mechanism)
    except GenevaError:
        return False


def failed(design):
    return [check.name for check in design.checks if check.passes is False]


@cache
def numeric_keys(path, *settings):
    """The names of the numeric keys that a design's kinds have: whether whole, and its value."""
    spec, out = load(path, settings).spec, {}
    for table, keys in keys_in(spec).items():
        for number, own in enumerate(values_of(spec, table)):
            name = f"{table}.{number}" if table in LISTS else table
            for key in keys:
                if {int, float} & set(key.types):
                    out[f"{name}.{key.key}"] = (int in key.types, own[key.key])
    return out


TRIED = (4, 8, 0.3, 20, 60, 120, 0)  # values of keys that a spec leaves out


def varied_key(path, settings, key):
    """The key with two values that both make a machine, the design's own first; None if none do."""
    whole, own = numeric_keys(path, *settings)[key]
    settings = [setting for setting in settings if not setting.startswith(f"{key}=")]
    for start in (own, *TRIED):
        if isinstance(start, int | float) and not (whole and start != int(start)):
            for step in (0.04, -0.04):
                other = start + math.copysign(1, step) if whole else start + step * (start or 0.25)
                pair = (int(start), int(other)) if whole else (float(start), float(other))
                if all(is_built(path, *settings, f"{key}={value}") for value in pair):
                    return Varied(path, settings, key, pair)
    return None


def drawn(names, of):
    """The names in an order that ``of`` draws; the same on every machine."""
    return sorted(names, key=lambda name: (zlib.crc32(f"{of} {name}".encode()), name))


def cell_of(text):
    """A cell of a csv as its value."""
    try:
        return float(text)
    except ValueError:
        return {"": None, "true": True, "false": False}.get(text, text)


def numbers(value):
    """All numbers in json."""
    if isinstance(value, dict | list):
        parts = value.values() if isinstance(value, dict) else value
        return [x for part in parts for x in numbers(part)]
    return [value] if isinstance(value, float) else []
