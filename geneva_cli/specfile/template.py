"""Specs to start from: commented ones with the keys that the reader knows, and whole designs."""

import os
from typing import Any

import tomli

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.kinds import FOLDERS
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import BEFORE, DRIVES, WHEELS
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.schema import REQUIRED, Field, fields
from geneva_cli.spec.tables import LISTS
from geneva_cli.specfile.keys import FILE
from geneva_cli.specfile.writer import keys_of, noted, quoted


def _examples() -> dict[str, dict[str, Any]]:
    """Specs with the keys that they set, by kind; of some the ``design`` that is one."""
    package, out = os.path.dirname(os.path.dirname(os.path.abspath(__file__))), dict[str, Any]()
    for folder in ("specfile", *(os.path.join("kinds", name) for name in FOLDERS)):
        path = os.path.join(package, folder, "examples.toml")
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                out |= tomli.loads(file.read())
    return out


EXAMPLES = _examples()
# wheels first; the plain crank is in all of them
KINDS = tuple(dict.fromkeys((*registry.GEARINGS, *EXAMPLES)))
# keys that most people set
USUAL: dict[str, dict[str, float]] = {
    "drive": {"n_rpm": 60, "rollers": 1},
    "size": {"center_distance_mm": 160, "roller_radius_mm": 9, "face_width_mm": 16},
    "limits": {"acceleration_max": 1.5, "pin_force_max_N": 600},
}


def template(kind: str, schema: bool = True, whole: bool = True) -> str:
    """Text of a valid spec: ``whole`` with every possible key, its default and its meaning;
    otherwise with the keys that most people set.

    With ``schema`` its first line names the JSON Schema in the same folder, for editors. Raises
    GenevaError for an unknown kind.
    """
    if kind not in KINDS:
        if kind in titles():
            use = f"use `geneva new --from-design {kind}`"
            raise GenevaError(f'"{kind}" is a design, not a KIND; {use}')
        known = f"{few(kind, KINDS)}; `geneva new --list` has all"
        raise GenevaError(f'unknown KIND "{cut(kind)}"{nearest(kind, KINDS)}; it is one of {known}')
    about, own = example(kind)
    drive = registry.drive(own.get("drive", {}).get("kind", DRIVES.word.default))
    behind = "have the default shown, or none" if whole else "show usual values"
    lines = [
        *([f"#:schema ./{FILE}"] if schema else []),
        f"# A Geneva mechanism: {about}.",
        f"# Keys after a # {behind}; remove the # to set them.",
        *([] if whole else [f"# All keys: geneva new {kind} --all"]),
        f"title = {quoted(about[0].upper() + about[1:])}",
    ]
    gearing = registry.gearing(own["wheel"].get("gearing", WHEELS.word.default))
    # any law may be set: a template shows the keys of all
    law_keys = [key for name in registry.LAWS for key in fields(registry.law(name))]
    before = registry.drive(own[BEFORE]["kind"]) if BEFORE in own else None
    for name, table in keys_of(gearing, drive, law_keys, before).items():
        # An empty table of a list would be one more body, without any of its keys.
        head = f"# [[{name}]]" if name in LISTS else f"[{name}]"
        block = _settings(name, table, own.get(name, {}), gearing, whole)
        lines += ["", head, *block] if block else []
    return "\n".join(lines) + "\n"


def _settings(
    name: str, table: list[Field], values: dict[str, Any], gearing: type[Gearing], whole: bool
) -> list[str]:
    """The lines of the keys that an example sets; behind a # all others, or the usual ones."""
    usual = {**USUAL, "load": gearing.USUAL_LOAD}.get(name, {})
    known, block = values if whole else usual | values, []
    for field in table:
        key, rule = field.key, f"; {field.rule}" if field.rule is not None else ""
        if whole or key in known:
            default = "..." if field.default in (None, REQUIRED) else quoted(field.default)
            setting = f"{key} = {quoted(known[key]) if key in known else default}"
            note = field.meaning + rule if whole else _note(field.meaning, gearing.NAME)
            block.append((setting if key in values else f"# {setting}", note))
    return noted(block)


def _note(meaning: str, gearing: str) -> str:
    """The part of a meaning about a gearing, such as "linear: crank radius", or the first."""
    parts, named = meaning.split("; "), f"{gearing}: "
    own = next((part for part in parts if part.startswith(named)), parts[0])
    return own.removeprefix(named)


def example(kind: str) -> tuple[str, dict[str, Any]]:
    """Title of a kind's example, and the tables of keys that it sets."""
    own = EXAMPLES[kind]
    tree = tomli.loads(_text(f"{own['design']}.toml")) if "design" in own else {**own}
    before = tree.get("drive", {}).pop("before", None)
    return tree.pop("title"), tree | ({BEFORE: before} if before else {})


def titles() -> dict[str, str]:
    """Names of the designs, with their titles."""
    files = [file for file in sorted(os.listdir(_folder())) if file.endswith(".toml")]
    return {file.removesuffix(".toml"): str(tomli.loads(_text(file))["title"]) for file in files}


def design(name: str) -> tuple[str, dict[str, str]]:
    """Text of a design's spec, and the texts of the files that it names, by name.

    Raises GenevaError, with the nearest name, for an unknown design.
    """
    known = titles()
    if name not in known:
        fault = f"no such design{nearest(name, known)}; `geneva new --list` lists them"
        raise GenevaError(f"--from-design {cut(name)}: {fault}")
    text = _text(f"{name}.toml")
    points = [file for file in os.listdir(_folder()) if file.endswith(".csv")]
    return text, {file: _text(file) for file in points if f'"{file}"' in text}


def _folder() -> str:
    """The folder of the designs: in the package if installed, else adjacent to it."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    inside = os.path.join(package, "designs")
    return inside if os.path.isdir(inside) else os.path.join(os.path.dirname(package), "designs")


def _text(file: str) -> str:
    with open(os.path.join(_folder(), file), encoding="utf-8") as opened:
        return opened.read()
