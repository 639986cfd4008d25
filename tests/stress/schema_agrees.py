"""Compare JSON Schema with the reader on mutated specs.

The schema must accept all that the reader accepts. A spec that only the reader refuses must be
wrong in several keys together, never in one value alone.
"""

import json
import os
import random
import re
import sys
import tempfile
import tomllib
from functools import cache
from pathlib import Path

import jsonschema
from fuzz import FILES
from fuzz_texts import ODD, spec_text

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.spec.schema import Points, checked, fields
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.keys import schema
from geneva_cli.specfile.template import KINDS, template
from geneva_cli.specfile.tree import spec_of

SPECS = 2000


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


def read(tree):
    """The reader's error for a spec, or None."""
    try:
        spec_of(tree, "spec.toml")
    except GenevaError as error:
        return error
    return None


def disagreement(text):
    """The disagreement of schema and reader on a spec; empty if they agree."""
    tree = tomllib.loads(text)
    refused = read(tree)
    faults = [error.message[:200] for error in validator().iter_errors(tree)]
    if faults and not refused:
        return f"the schema alone refuses: {faults}"
    if refused and not faults and of_one_value(tree, refused):
        return f"the reader alone refuses: {refused}"
    return ""


def main():
    rng = random.Random(14)
    texts = [spec(rng) for _ in range(SPECS)]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, content in FILES.items():
            Path(folder, name).write_text(content, encoding="utf-8")
        results = [(text, disagreement(text)) for text in texts]
    for text, what in results:
        if what:
            print(f"--- {what}\n{text}")
    print(f"{SPECS} specs: {sum(bool(what) for _, what in results)} disagree")
    sys.exit(any(what for _, what in results))


if __name__ == "__main__":
    main()
