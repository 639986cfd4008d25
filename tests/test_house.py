"""The house: rooms on floors. Imports go down, never across a floor and in no circle; only some
rooms touch files or know Typer; and nobody asks which machine it is.
"""

import ast
import functools
import importlib
import os
import re
import types
from graphlib import CycleError, TopologicalSorter
from typing import NamedTuple

import pytest

import geneva_cli
from geneva_cli.kept import load_named
from geneva_cli.kinds import FOLDERS
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.wheels.gearing import Gearing

ROOT = os.path.dirname(geneva_cli.__file__)

# From the ground up. A room imports rooms of the floors below its own.
FLOORS = [
    {"errors", "names", "progress"},
    {"kept"},
    {"table"},
    {"numerics", "streams", "figure", "answer", "manual"},
    {"spec"},
    {"geometry"},
    {"motion"},
    {"drives"},
    {"specfile"},
    {"output"},
    {"loads"},
    {"parts"},
    {"drawings"},
    {"verdict"},
    {"design"},
    {"study"},
    {"kinds", "extras"},
    {"cli"},
    {"__main__"},
]
# Modules that annotate what users get of kinds and extras.
PUBLIC = {"", "design"}
# Levels of imports in a room: someone new can follow them.
DEEPEST = 8
# Members of one kind, a file each: none imports another. What two share is no member.
MEMBERS = {
    "drives": {m.partition(":")[0] for m in registry.DRIVES.values()},
    "motion.wheels": {m.partition(":")[0] for m in registry.GEARINGS.values()},
    "motion.laws": {m.partition(":")[0] for m in registry.LAWS.values()},
}
# Folders of like files, none of which imports another.
ALIKE = ("cli.commands", "verdict.checks")
STREAMS = {"streams", "__main__", "specfile", "output", "manual", "cli"}
# What commands know besides designs and studies: laws alone, extras, templates, units and names of
# parts; there is no machine yet.
ALONE = {
    "study.law_values",
    "kept",
    "specfile.template",
    "specfile.keys",
    "specfile.meanings",
    "drawings.catalogue",
}
# A kind's names; "table" is a law, and also what people are shown.
NAMES = {*registry.LAWS, *(kind.name for kind in registry.KINDS)} - {"table"}
# The names of kinds in folders: no text of the core is one of them.
FAR = {kind.name for folder in FOLDERS for kind in load_named(f"kinds.{folder}:KINDS")}


def modules():
    for folder, _, files in os.walk(ROOT):
        for file in sorted(files):
            if file.endswith(".py"):
                path = os.path.relpath(os.path.join(folder, file), ROOT)
                name = path.removesuffix(".py").replace(os.sep, ".")
                yield "" if name == "__init__" else name.removesuffix(".__init__")


MODULES = sorted(modules())
KNOWN = frozenset(MODULES)


def source(module):
    path = os.path.join(ROOT, *module.split(".")) if module else ROOT
    path = os.path.join(path, "__init__.py") if os.path.isdir(path) else path + ".py"
    with open(path, encoding="utf-8") as file:
        return file.read()


def room(module):
    """The top folder; of a kind or an extra, its own."""
    parts = module.split(".")
    return ".".join(parts[:2]) if parts[0] in ("kinds", "extras") else parts[0]


def floor(module):
    return next((i for i, rooms in enumerate(FLOORS) if module.split(".")[0] in rooms), None)


def named(node):
    """The name that stands there alone; nothing where it is more."""
    return node.id if isinstance(node, ast.Name) else ""


def running(tree):
    """The nodes that run: all but what stands under ``if TYPE_CHECKING``."""
    rest = [tree]
    while rest:
        node = rest.pop()
        yield node
        if isinstance(node, ast.If) and named(node.test) == "TYPE_CHECKING":
            rest += node.orelse
        else:
            rest += ast.iter_child_nodes(node)


def own(name):
    """The module of ours that ``geneva_cli.name`` means, whatever is taken of it."""
    parts = name.split(".")
    while parts and ".".join(parts) not in KNOWN:
        parts.pop()
    return ".".join(parts)


def imported(nodes):
    """All modules that some nodes import, at the top or in a function; ours without the package."""
    for node in nodes:
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, "relative imports hide where they go"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            ours = name == "geneva_cli" or name.startswith("geneva_cli.")
            yield own(name.removeprefix("geneva_cli").lstrip(".")) if ours else f"{name} (theirs)"


def ours(text, types=False):
    names = read(text).known if types else read(text).imports
    return {name for name in names if not name.endswith("(theirs)")} - {""}


def climbs(module, text):
    """What a module imports that is not below it, and not in its own room.

    The lists of kinds and extras hold names only: everybody may import them.
    """
    others = ours(text) - {"kinds", "extras"}
    above = {m for m in others if room(m) != room(module) and floor(m) >= floor(module)}
    return sorted(above)


def beside_designs(text):
    """What a command imports that it should ask a Design or a study for."""
    rooms = {"motion", "drives", "loads", "parts", "drawings", "spec", "verdict", "geometry"}
    return {m for m in ours(text) if room(m) in rooms | {"numerics", "specfile"}} - ALONE


# The wheels that a record names.
ASKS = {"motion.compatible": ["spec.wheel.NAME not in kind.gearings"]}
# Keys and tables of a kind that stand in the core.
NAMED = {
    "study.verdicts": {"stop"},  # a label
}

CALLS = ("open", "io.open", "os.open", "print", "input", "exec")


def called(node):
    """The function that a call names, alone or of a module: the text of any takes long."""
    if isinstance(node.func, ast.Attribute):
        return f"{named(node.func.value)}.{node.func.attr}"
    return named(node.func)


def streams(nodes):
    """Calls and names that touch a file or a stream."""
    for node in nodes:
        if isinstance(node, ast.Call) and called(node) in CALLS:
            yield ast.unparse(node)
        if (
            isinstance(node, ast.Attribute)
            and node.attr in ("stdin", "stdout", "stderr")
            and named(node.value) == "sys"
        ):
            yield ast.unparse(node)


def of_name(node):
    """Return True for the name of a machine's kind, ``NAME`` of a wheel, a drive or a law."""
    return isinstance(node, ast.Attribute) and node.attr == "NAME"


def asks(nodes):
    """Where it is asked which machine it is: by a kind's name or class, or a literal attribute."""
    for node in nodes:
        if isinstance(node, ast.Compare):
            sides = (node.left, *node.comparators)
            record = any(isinstance(side, ast.Attribute) and side.attr == "name" for side in sides)
            words = {
                n.value for side in sides for n in ast.walk(side) if isinstance(n, ast.Constant)
            }
            classes = {named(n) for side in sides for n in (side, *getattr(side, "elts", ()))}
            if words & NAMES or classes & CLASSES or (any(map(of_name, sides)) and not record):
                yield ast.unparse(node)
        if isinstance(node, (ast.MatchValue, ast.MatchClass)):
            key = node.value if isinstance(node, ast.MatchValue) else node.cls
            if getattr(key, "value", None) in NAMES or named(key) in CLASSES or of_name(key):
                yield ast.unparse(node)
        if isinstance(node, ast.Subscript) and of_name(node.slice):
            yield ast.unparse(node)
        if (
            isinstance(node, ast.Call)
            and called(node).endswith(".get")
            and any(map(of_name, node.args[:1]))
        ):
            yield ast.unparse(node)
        if not (isinstance(node, ast.Call) and len(node.args) > 1):
            continue
        name, second = named(node.func), node.args[1]
        if name in ("getattr", "hasattr") and isinstance(second, ast.Constant):
            yield ast.unparse(node)
        if name in ("isinstance", "issubclass"):
            kinds = {ast.unparse(n).rpartition(".")[2] for n in ast.walk(second)}
            if kinds & CLASSES:
                yield ast.unparse(node)


def far(nodes):
    """The texts that are the name of a kind that only some users need."""
    for node in nodes:
        if isinstance(node, ast.Constant) and node.value in FAR:
            yield node.value


CLASSES = {
    path.partition(":")[2]
    for kinds in (registry.DRIVES, registry.GEARINGS, registry.LAWS)
    for path in kinds.values()
} | {
    "Transmission",
    "Linkage",
    "StraightSlotMotion",
    "LawMotion",
    "SolvedSlot",
}


class Read(NamedTuple):
    """What the rules ask of a source."""

    full: bool  # more than a docstring
    imports: list  # that run
    known: list  # those for types too
    streams: list
    asks: list
    far: set


@functools.cache
def read(text):
    """A source, parsed and walked through once for all rules."""
    tree = ast.parse(text)
    every, run = list(ast.walk(tree)), list(running(tree))
    return Read(
        len(tree.body) > 1,
        list(imported(run)),
        list(imported(every)),
        list(streams(run)),
        list(asks(every)),
        set(far(every)),
    )


def broken(rule, modules):
    """What breaks a rule, by module: a rule returns what breaks it in one module."""
    return {module: wrong for module in modules if (wrong := rule(module))}


def test_every_room_has_a_floor():
    assert [module for module in MODULES if module and floor(module) is None] == []


def test_imports_go_down():
    assert not broken(lambda m: climbs(m, source(m)), filter(None, MODULES))


def names_kinds(module):
    """What a module imports or names of a kind or an extra, for a type checker too."""
    text = source(module)
    known = ours(text, types=True)
    asked = known - ours(text) if module in PUBLIC else set()
    strings = {n.value for n in ast.walk(ast.parse(text)) if isinstance(n, ast.Constant)}
    paths = {s for s in strings if isinstance(s, str) and re.match(r"(kinds|extras)\.\w+", s)}
    return sorted({m for m in known - asked if m.startswith(("kinds.", "extras."))} | paths)


def test_nothing_outside_names_a_kind():
    """The core asks by records: of a folder that is not there, nobody has heard."""
    core = [m for m in MODULES if m.partition(".")[0] not in ("kinds", "extras")]
    assert not broken(names_kinds, core)


def test_no_circle():
    """Imports for types count: files that know each other are read together."""
    graph = {module: ours(source(module), types=True) - {module} for module in MODULES}
    try:
        list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        pytest.fail(f"imports go round: {' -> '.join(error.args[1])}")


def levels(module, graph, known):
    """The length of the longest chain of imports from a module, within its room."""
    if module not in known:
        inside = [m for m in graph[module] if room(m) == room(module)]
        known[module] = 1 + max((levels(m, graph, known) for m in inside), default=0)
    return known[module]


def test_rooms_are_not_deep():
    """Modules that hold nothing but a docstring, of packages, do not count."""
    full = [m for m in MODULES if read(source(m)).full]
    graph = {m: (ours(source(m), types=True) & set(full)) - {m} for m in full}
    known = {}
    deep = {m: n for m in full if (n := levels(m, graph, known)) > DEEPEST}
    assert not deep


@pytest.mark.parametrize("kind", MEMBERS)
def test_members_of_a_kind_do_not_know_each_other(kind):
    members = MEMBERS[kind]
    for member in members:
        assert not (ours(source(member)) & members) - {member}, member


@pytest.mark.parametrize("folder", ALIKE)
def test_members_of_a_folder_do_not_know_each_other(folder):
    members = {m for m in MODULES if m.startswith(folder + ".")}
    assert len(members) >= 3
    for member in members:
        assert not (ours(source(member)) & members) - {member}, member


def test_commands_ask_a_design():
    """A command knows a machine only as the object that a Python user has."""
    asked = [source(module) for module in MODULES if room(module) == "cli"]
    assert {m for text in asked for m in beside_designs(text)} == set()
    # and what is open is used
    assert {m for text in asked for m in ours(text)} >= ALONE


def test_few_rooms_touch_streams():
    others = [m for m in MODULES if room(m) not in STREAMS]
    assert broken(lambda m: read(source(m)).streams, others) == {}


# What a class of drives or wheels says in words: names, and what a message is made of.
WORDS = {
    "NAME",  # in the file
    "TITLE",  # of a design without one
    "WORDS",  # the drive or the wheel in a sentence
    "IN_FRONT",  # the drive in front of another, in a sentence
    "FIRST",  # the reason why no drive may stand before it
    "USUAL_LOAD",  # keys of a new spec
    "DISTANCE",  # what the centre distance is called
    "LOCK",  # what locks the wheel
}
FLAGS_MOST = 5  # SIGN and three more today


def test_drives_and_wheels_have_few_flags():
    """A flag is a question about a machine's nature: readers should ask for a thing."""
    names = {name for kind in (Drive, Gearing) for name in kind.__annotations__ if name.isupper()}
    assert names >= WORDS
    assert len(names - WORDS) <= FLAGS_MOST, sorted(names - WORDS)


def test_nobody_asks_which_machine_it_is():
    others = [m for m in MODULES if m != "motion.registry"]
    assert broken(lambda m: read(source(m)).asks, others) == ASKS


def test_the_core_names_no_kind():
    core = [m for m in MODULES if room(m).partition(".")[0] not in ("kinds",)]
    assert broken(lambda m: read(source(m)).far, core) == NAMED


def described(cls, name):
    """True if a member of a class, or what it overrides, has a docstring."""
    return any(getattr(vars(base).get(name), "__doc__", None) for base in cls.__mro__)


def test_what_has_no_docstring_overrides_what_has_one():
    """Rooms whose public methods need no docstring of their own: the base's says what they do."""
    rooms = [m for m in MODULES if room(m) in ("motion", "drives", "numerics")]
    for name in sorted({*rooms} - {"numerics.arrays", "numerics.intervals"}):  # functions of math
        module = importlib.import_module(f"geneva_cli.{name}")
        for cls in vars(module).values():
            if isinstance(cls, type) and cls.__module__ == module.__name__:
                public = [n for n, own in vars(cls).items() if n[0] != "_" and is_method(own)]
                assert not [n for n in public if not described(cls, n)], (name, cls.__name__)


def is_method(member):
    """True for a method or a property of any sort."""
    of = getattr(member, "fget", None) or getattr(member, "func", None) or member
    return isinstance(getattr(of, "__func__", of), types.FunctionType)


def named_alike(module):
    """The name of a file; none where it may occur twice: kinds name files after rooms, and
    commands after what they show.
    """
    exempt = module.startswith(("kinds.", "extras.", "cli.commands."))
    return "" if exempt else module.rpartition(".")[2]


def test_no_two_files_have_one_name():
    """A reader who looks for a file finds one."""
    names = [name for m in MODULES if read(source(m)).full and (name := named_alike(m))]
    assert {name for name in names if names.count(name) > 1} == set()
