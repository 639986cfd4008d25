"""Mutated specs, and whether JSON Schema and the reader say the same of them.

    python tests/stress/schema_agrees.py [TOOL ...]

The schema may refuse nothing that the reader takes. What the reader refuses and the schema takes
must be a matter of several keys, never of one value alone. Each TOOL, a command that is given the
schema's file and a folder of specs, is compared with the schema: `make editors`.
"""

import json
import os
import random
import re
import subprocess
import sys
import tempfile
import tomllib
from functools import cache
from pathlib import Path

import jsonschema
from fuzz_spec import ODD, spec_text
from fuzzing import FILES

from geneva_cli.errors import GenevaError
from geneva_cli.kinematics import registry
from geneva_cli.spec.schema import Points, checked, fields
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.json_schema import FILE, schema
from geneva_cli.specfile.template import KINDS, template
from geneva_cli.specfile.tree import spec_of

SPECS = 2000
# editors' checkers, each said to take a spec by a status of 0
TOOLS = {
    "taplo": lambda schema, spec: ["taplo", "check", "--schema", f"file://{schema}", spec],
    "tombi": lambda schema, spec: ["tombi", "lint", "--offline", spec],
}


@cache
def validator():
    jsonschema.Draft7Validator.check_schema(schema())
    return jsonschema.Draft7Validator(schema())


def spec(rng):
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
    return "\n".join(
        [
            *lines[:i],
            *rng.choice(
                (
                    [f"{key[:-1]} = {value}"],
                    [f"{key} = {rng.choice(ODD)}"],
                    [],
                    [
                        rng.choice(["[whel]", "[motion]", "[drive]", "[material]", "x = 1"]),
                        lines[i],
                    ],
                )
            ),
            *lines[i + 1 :],
        ]
    )


def of_one_value(tree, error):
    """Whether what the reader says is of one value: its key alone does not take it."""
    table, *_, key = error.key if error.key and len(error.key) > 1 else ("", "")
    given = tree.get(table)
    for part in error.key[1:-1] if error.key else ():
        given = given[part]
    if not isinstance(given, dict) or key not in given:
        return False
    value = given[key]
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # 6.0 is whole to JSON Schema
    kinds = (
        registry.gearing(given.get("gearing", "external")) if table == "wheel" else None,
        registry.drive(given.get("kind", "crank")) if table == "drive" else None,
        registry.law(given["law"]) if "law" in given else None,
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


def read(tree):
    """What the reader refuses, or None."""
    try:
        spec_of(tree, "spec.toml")
    except GenevaError as error:
        return error
    return None


def disagreement(text):
    """What schema and reader say differently of a spec, or nothing."""
    tree = tomllib.loads(text)
    refused = read(tree)
    faults = [error.message[:200] for error in validator().iter_errors(tree)]
    if faults and not refused:
        return f"the schema alone refuses: {faults}"
    if refused and not faults and of_one_value(tree, refused):
        return f"the reader alone refuses: {refused}"
    return ""


def compare(tools, folder, texts):
    """How often each tool says another thing than the schema; every such spec is printed."""
    Path(folder, FILE).write_text(json.dumps(schema()))
    wrong = dict.fromkeys(tools, 0)
    for i, text in enumerate(texts):
        path = Path(folder, f"{i}.toml")
        path.write_text(f"#:schema ./{FILE}\n{text}")
        fine = validator().is_valid(tomllib.loads(text))
        for tool in tools:
            command = TOOLS[tool](Path(folder, FILE), path)
            run = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            if (run.returncode == 0) != fine:
                wrong[tool] += 1
                print(f"--- {tool}, schema says {fine}\n{text}\n{run.stdout}{run.stderr}")
    return wrong


def main(tools):
    rng = random.Random(14)
    texts = [spec(rng) for _ in range(SPECS)]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, content in FILES.items():
            Path(folder, name).write_text(content)
        said = [(text, disagreement(text)) for text in texts]
        wrong = compare(tools, folder, texts)
    for text, what in said:
        if what:
            print(f"--- {what}\n{text}")
    fine = sum(validator().is_valid(tomllib.loads(text)) for text in texts)
    print(f"{SPECS} specs, {fine} of them sound to the schema")
    print(f"reader against schema: {sum(bool(what) for _, what in said)} disagree")
    for tool, count in wrong.items():
        print(f"{tool} against schema: {count} disagree")
    sys.exit(any(what for _, what in said) or any(wrong.values()))


if __name__ == "__main__":
    main(sys.argv[1:])
