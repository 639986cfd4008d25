"""A spec from the tables of a parsed TOML file, and from the files that it names."""

import os
import re
import sys
from contextlib import nullcontext
from typing import Any

from geneva_cli.errors import GenevaError, below, clean, cut, few, nearest
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import KINDS, LAWS, Spec
from geneva_cli.spec import schema
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.tables import LISTS, PLAIN

NAMES = (*KINDS, *PLAIN)
WHOLE = dict[str, None]()  # without what stands behind a point
for _name in NAMES:
    WHOLE[_name.partition(".")[0]] = None

# Other names of a size: here the pin's radius is that of the roller on it.
ALSO_CALLED = {"pin_radius_mm": "roller_radius_mm", "crank_pin_radius_mm": "roller_radius_mm"}


def spec_of(tree: dict[str, Any], name: str) -> Spec:
    """The spec of a TOML file's tables; paths in it are relative to the file ``name``.

    Raises GenevaError, naming table and key, for anything invalid.
    """
    tree = dict(tree)
    title = tree.pop("title", "")
    if not isinstance(title, str):
        raise GenevaError(f"title must be text, not {schema.shown(title)}", ("title",))
    tables = _tables(tree)
    if "wheel" not in tables:
        raise GenevaError(f"{name}: no [wheel]; write it, and z = 6 on the next line")
    files, parts = [name], dict[str, Any]()
    for table, several in tables.items():
        made, place = list[Any](), tuple[str | int, ...](table.split("."))
        for i, values in enumerate(several):
            head = f"[{table}]"
            if table in LISTS:
                head, place = f"[[{table}]] number {i + 1}", (table, i)
            try:
                made.append(_object(table, values, files))
            except GenevaError as error:
                if not error.key or error.key[: len(place)] == place:  # it names the table
                    raise
                raise GenevaError(f"{head}: {error}", (*place, *error.key[1:])) from None
        parts[table.replace(".", "_")] = made if table in LISTS else made[0]
    for drawing in parts["outline"].files if "outline" in parts else ():
        files.append(below(os.path.dirname(name), drawing))
    parts["title"] = clean(schema.free_text("title", title, ("title",)))
    return Spec(**parts, path=name, files=tuple(files))


def _tables(tree: dict[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """The tables of each whole name, such as material.wheel, which stands in another table."""
    tables, left = dict[str, list[dict[str, Any]]](), [*tree.items()]
    for name, value in left:  # to which tables in tables are added
        *_, key = place = tuple(name.split("."))
        if name not in NAMES and name not in WHOLE:
            raise _no_table(name, value)
        several = value if isinstance(value, list) else [value]
        if isinstance(value, list) != (name in LISTS) or {*map(type, several)} - {dict}:
            head = f"[[{name}]]" if name in LISTS else f"[{name}]"
            raise GenevaError(f"{key} must be a table: write {head} above its keys", place)
        own, parts = [*map(dict, several)], list[str]()
        for whole in NAMES:
            if whole.startswith(f"{name}."):
                parts.append(whole.removeprefix(f"{name}."))
                if parts[-1] in own[0]:
                    left.append((whole, own[0].pop(parts[-1])))
        if name in NAMES:
            tables[name] = own
        elif own[0]:
            raise schema.unknown(next(iter(own[0])), name, parts)
    return tables


def _object(table: str, values: dict[str, Any], files: list[str]) -> Any:
    """The object of a table, whose class checks its values; None for an empty [motion].

    ``files`` are the spec's and those read so far.
    """
    kinds, word, why = KINDS.get(table), "", ""
    if kinds is None:
        classes = [PLAIN[table]]
    else:
        word = values.pop(kinds.word.key, kinds.word.default)
        if word is None and kinds is LAWS and not values:
            return None
        if word is None:
            raise schema.missing(kinds.word, table)
        classes, why = [kinds.find(word)], f' for {kinds.word.key} = "{word}"'
        classes += [Motion] if kinds is LAWS else []
    known = dict[str, schema.Field]()
    for cls in classes:
        for field in schema.fields(cls):
            known[field.key] = field
    for key in values:
        if key not in known:
            raise _unknown(key, table, known, word)
    made: Any = None
    for cls in classes:
        arguments: dict[str, Any] = {"law": made} if made else {}
        for field in schema.fields(cls):
            if field.key in values:
                value = values[field.key]
                is_file = isinstance(field.rule, Csv)
                arguments[field.attribute] = _points(field.rule, value, files) if is_file else value
            elif field.default is schema.REQUIRED:
                raise schema.missing(field, table, why)
        made = cls(**arguments)
    return made


def _points(rule: Csv, name: Any, files: list[str]) -> schema.Points:
    """The points in a file of a law."""
    place = ("motion", "file")
    if not isinstance(name, str):
        raise GenevaError(f"file must be text, not {schema.shown(name)}", place)
    files.append(below(os.path.dirname(files[0]), name))
    return schema.Points(tuple(read_pairs(files[-1], rule, place)), name)


def read_pairs(path: str, rule: Csv, key: tuple[str, ...]) -> list[tuple[float, float]]:
    """Pairs in a file, the first number of each ascending; a header and ``#`` lines are skipped.

    Raises GenevaError naming the file's line or, if the file cannot be read, the spec's key.
    """
    points: list[tuple[float, float]] = []
    # some hundred thousand points, in memory
    text = read_text(path, 1 << 24, "use fewer points", key)
    for number, line in enumerate(text.split("\n"), 1):
        row = [re.sub(r'^"(.*)"$', r"\1", cell.strip()) for cell in line.split(",")]
        if row == [""] or row[0].startswith("#") or row == ["u", "s"]:
            continue
        where = f"{path}:{number}"
        try:
            x, y = (float(cell) for cell in row)
        except ValueError:
            shown = cut(",".join(row))
            text = f'{where}: "{shown}" is not two numbers u,s, as in 0.5,0.25'
            raise GenevaError(text) from None
        points.append((x, y))
        fault = rule.fault(points, len(points) - 1)
        if fault:
            raise GenevaError(f"{where}: {fault}")
    return points


def read_bytes(path: str, most: int, advice: str, key: tuple[str, ...] = ()) -> bytes:
    """Bytes of a file up to a size; ``-`` is standard input, but for a file that a ``key`` names.

    Raises GenevaError, with that key of the spec, for a file that is larger or cannot be read.
    """
    is_input = path == "-" and not key
    try:
        with nullcontext(sys.stdin.buffer) if is_input else open(path, "rb") as file:
            data = file.read(most + 1)
        if len(data) <= most:
            return data
        fault = f"larger than {most} bytes: {advice}"
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        what = str(error.strerror if isinstance(error, OSError) else error)
        fault = f"cannot read: {'this is a folder, not a file' if os.path.isdir(path) else what}"
    raise GenevaError(f"{shown_path(path, key)}: {fault}", key)


def read_text(path: str, most: int, advice: str, key: tuple[str, ...] = ()) -> str:
    """Text of a UTF-8 file, read as by ``read_bytes``; its lines end with a line feed."""
    data = read_bytes(path, most, advice, key)
    try:
        # Some editors put a byte order mark before the text.
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        # as PowerShell 5 writes UTF-16 for >
        advice = "save the file as UTF-8, or write it with -o FILE in place of > FILE"
        raise GenevaError(f"{shown_path(path, key)}:{line}: not UTF-8 text; {advice}") from None


def shown_path(path: str, key: tuple[str, ...] = ()) -> str:
    """A file's name for a message."""
    if path == "-" and not key:
        return "<stdin>"
    return cut(path, 300) if path.strip() else repr(path)


def _no_table(name: str, value: Any) -> GenevaError:
    """The error for what is no table of a spec."""
    where = "" if isinstance(value, dict) else _having(name)
    if where:
        return GenevaError(f"{name} belongs to {where}; write it below that line", (name,))
    named = f"table [{cut(name)}]" if isinstance(value, dict) else f"key {cut(name)}"
    hint, known = nearest(name, (*WHOLE, "title")), few(name, [f"[{t}]" for t in WHOLE])
    return GenevaError(f"unknown {named}{hint}; known: title, {known}", (name,))


def _unknown(key: str, table: str, known: dict[str, schema.Field], word: str) -> GenevaError:
    """Error for a key that a table of this kind does not have; it names what has it."""
    kinds, hint, place = KINDS.get(table), "", (*table.split("."), key)
    # keys of the kind come first
    own = [name for name, field in known.items() if field not in schema.fields(Drive)]
    if kinds:
        of = kinds.word.key
        own.insert(0, of)
        hint = f' (did you mean {of} = "{key}"?)' if key in kinds.names else ""
        for name, others in kinds.keys.items():
            if key in [field.key for field in others]:
                text = f'{key} belongs to {of} = "{name}", but this is {of} = "{word}"'
                return GenevaError(text, place)
    half = key.replace("_diameter_", "_radius_")
    twin = f"; {half} in [{table}] is half a diameter" if half != key and half in known else ""
    if where := _having(key):
        return GenevaError(f"unknown key {key} in [{table}]; it belongs to {where}{twin}", place)
    if ALSO_CALLED.get(key) in known:
        hint = f' (did you mean "{ALSO_CALLED[key]}"?)'
    hint = twin or hint
    return schema.unknown(key, table, [*dict.fromkeys((*own, *known))], hint)


def _having(key: str) -> str:
    """The tables that have a key, with its meaning if it is one; empty for more than three.

    In [tolerance] the name of a size is that of its deviation.
    """
    from geneva_cli.specfile.keys import tables_with  # only for messages

    meanings = tables_with(key)
    tables = [f"[[{name}]]" if name in LISTS else f"[{name}]" for name in meanings]
    if len(tables) > 3:
        return ""
    meaning = f" ({meanings.popitem()[1]})" if len(meanings) == 1 else ""
    return " or ".join(tables) + meaning
