"""Stops of curved slots, JSON Schema and synth on random cases, for ``fuzz.py``.

Each check takes a case and returns how it ended, in a word; a fault raises.
"""

import json
import math
import os
import re
import tempfile
import tomllib
from functools import cache
from unittest import mock

import numpy as np
import repo
from fuzz_texts import ODD, spec_text
from test_outline import made
from turn_witness import check_first_contacts
from typer.testing import CliRunner
from words import Motion

from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.turned_parts import wheel_stops, windows
from geneva_cli.spec.schema import Points, checked, fields
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.keys import schema as json_schema
from geneva_cli.specfile.template import KINDS, template
from geneva_cli.specfile.tree import spec_of
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search
from geneva_cli.study.synth.synth_table import chosen

# Stops: each wheel has a random law, extra dwell and clearance, and walls fitted with other places
# of the joints, so that arcs at an inflection get any radius. No parts overlap before a stop, and
# some do behind it, by gaps that are distances of points and not contacts.
STOP_LAWS = ("modified-sine", "cycloidal", "modified-trapezoid", "3-4-5", "harmonic")
PLACES, DENSE = 80, 1500  # positions of the wheel in each motion and dwell
TURNS = 40  # angles of the wheel that are tried before a stop
SCAN = 1.002  # times the play: a peak lies between two positions of the search
WALLS = 50.0  # times the tolerance of the walls over the rim: smaller plays are the walls' own


def require_largest_plays(parts):
    """The plays of a full turn are those of a dense scan of the first motion."""
    turn = full_turn(parts)
    window = next(w for w in windows(parts) if not w.rests)
    at_deg = np.linspace(window.start, window.end, DENSE)
    at_deg = at_deg[parts.past_mouth(window.motion, at_deg) > 0.0]
    play = np.degrees(wheel_stops(parts, at_deg)[0])
    noise = math.degrees(WALLS * parts.close / parts.sizes.rim)
    assert play.min(axis=0).max() <= max(SCAN * turn.motion.deg, noise), turn.motion
    either = max(turn.ahead.deg, turn.behind.deg)
    assert play.max() <= max(SCAN * either, noise), (turn.ahead, turn.behind)


def stops(arguments):
    """Return the result of a case: a seed, the step of the joints' weights, the machine's keys."""
    seed, step, case = arguments
    with mock.patch("geneva_cli.geometry.fit.WEIGHT", step):
        try:
            parts = made.__wrapped__(**case)
        except GenevaError:
            return "refused"
        share = np.sort(np.random.default_rng(seed).random(PLACES))
        ends = [(w.start, w.end) for w in windows(parts)]
        at_deg = np.concatenate([a + (b - a) * share for a, b in ends])
        assert len(list(check_first_contacts(parts, at_deg, TURNS))) == 2  # ways
        require_largest_plays(parts)
        return "machine"


def stop_case(rng):
    """A wheel with curved slots: a seed, the step of the joints' weights, the machine's keys."""
    alpha0 = rng.choice((0.0, -16.303125, rng.uniform(-25.0, 25.0)))
    clearance = rng.choice((0.0, 0.02, 0.1))
    size = {
        "roller_radius_mm": rng.choice((3.0, 5.0, 7.0)),
        "slot_clearance_mm": clearance,
        "lock_clearance_mm": clearance,
    }
    keys = {
        "z": rng.choice((3, 4, 5, 6, 8, 10, 12)),
        "gearing": rng.choice(("external", "external", "internal")),
        "motion": Motion(rng.choice(STOP_LAWS), alpha0_deg=alpha0, ratio="matched"),
    }
    return rng.getrandbits(32), 2.0 ** -rng.randint(5, 12), keys | size


# The schema must accept all that the reader accepts. A spec that only the reader refuses must be
# wrong in several keys together, never in one value alone.


@cache
def validator():
    import jsonschema

    jsonschema.Draft7Validator.check_schema(json_schema())
    return jsonschema.Draft7Validator(json_schema())


def schema_case(rng):
    """Text of a spec that TOML can hold and JSON too: a template or a random one, then changed."""
    while True:
        text = template(rng.choice(KINDS)) if rng.random() < 0.3 else spec_text(rng, 0.03)
        text = text.replace("[mass]", "[[mass]]") if rng.random() < 0.9 else text
        text = changed(rng, text) if rng.random() < 0.8 else text
        try:
            json.dumps(tomllib.loads(text), allow_nan=False)
        except (ValueError, TypeError):  # no TOML, or nan, inf and dates, which JSON cannot say
            continue
        if re.search(r"\d{19}", text):  # whole numbers beyond what TOML asks of a reader
            continue
        return text


def changed(rng, text):
    """One key misspelt, moved, lost, or with another value."""
    lines = text.split("\n")
    keys = [i for i, line in enumerate(lines) if " = " in line and line[0] != "#"]
    if not keys:
        return text
    i = rng.choice(keys)
    key, _, value = lines[i].partition(" = ")
    head = rng.choice(["[whel]", "[motion]", "[drive]", "[material]", "x = 1"])
    others = [f"{key[:-1]} = {value}"], [f"{key} = {rng.choice(ODD)}"], [], [head, lines[i]]
    return "\n".join([*lines[:i], *rng.choice(others), *lines[i + 1 :]])


def of_one_value(tree, error):
    """True if the reader refuses one value: its key alone does not accept it."""
    table, *_, key = error.key if error.key and len(error.key) > 1 else ("", "")
    values = tree.get(table)
    for part in error.key[1:-1] if error.key else ():
        values = values[part]
    if not isinstance(values, dict) or key not in values:
        return False
    value = values[key]
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # 6.0 is whole to JSON Schema
    kinds = (
        registry.gearing(values.get("gearing", "external")) if table == "wheel" else None,
        registry.drive(values.get("kind", "crank")) if table == "drive" else None,
        registry.law(values["law"]) if "law" in values else None,
        PLAIN.get(".".join(part for part in error.key[:-1] if isinstance(part, str))),
    )
    for kind in filter(None, kinds):
        for field in fields(kind):
            if field.key == key and Points not in field.types:
                try:
                    checked(kind.TABLE, field, value)
                except GenevaError:
                    return True
    return False


def schema(text):
    """Schema and reader agree on a spec."""
    tree, refused = tomllib.loads(text), None
    try:
        spec_of(tree, "spec.toml")
    except GenevaError as error:
        refused = error
    faults = [error.message[:200] for error in validator().iter_errors(tree)]
    assert refused or not faults, f"the schema alone refuses: {faults}"
    alone = refused and not faults and of_one_value(tree, refused)
    assert not alone, f"the reader alone refuses: {refused}"
    return "refused" if refused else "machine"


REQUIREMENTS = (
    *({"tau": tau} for tau in ("1/3", "0.6", "1/5")),
    *({"motion_deg": motion} for motion in ("100", "180", "240")),
    *({"subject_to": [f"acceleration.max <= {most}"]} for most in (0.5, 1.5)),
    {"dwell_s": "0.8..", "cycle": "1.5", "motion_deg": "..180"},
    {"tau": "0.2..0.4", "subject_to": ["jerk.max <= 20"]},
)
SLOTS = (3, 4, 5, 6, 8, 10, 12, 16, 20)
SYNTH_LAWS = ("modified-sine", "cycloidal", "modified-trapezoid", "3-4-5")


def synth_case(rng):
    """A requirement, the number of a row, and whether only rows that can be built are asked for."""
    options = rng.choice(REQUIREMENTS)
    options = {**options, "z": str(rng.choice(SLOTS)), "law": rng.choice(SYNTH_LAWS)}
    return options, rng.randint(1, 40)


def synth(case):
    """A row that says yes passes every check and is cut; one that says no fails one."""
    options, number = case
    try:
        target = read_target(**options)
        rows = search(target)
    except GenevaError:
        return "out of reach"
    number = min(number, len(rows))
    parts = rows[number - 1].cells["parts"]
    if parts is None:
        return "not drawn"
    machine, text = chosen(target, rows, number)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "spec.toml")
        repo.put(file, text)
        failing = [c.name for c in load(file).checks if c.passes is False]
        if machine.trouble:
            assert failing or parts != "maybe"
            return f"no: {machine.trouble}"
        words = ["profile", file, "--part", "wheel", "-o", os.path.join(folder, "wheel.dxf")]
        cut = CliRunner().invoke(app, words)
        assert not failing and not cut.exit_code, (failing, cut.stderr)
    return "yes"
