"""Imports go down only: a module may import from the rows below its own."""

import ast
import os
import textwrap
from fnmatch import fnmatchcase

import pytest

import geneva_cli

ROOT = os.path.dirname(geneva_cli.__file__)

# From the ground up. A * stands for the members of a registry, which are added without asking
# here; a name that is written out elsewhere keeps its own row.
ROWS = [
    ["geneva_cli"],
    ["budget"],
    ["digits", "drawing", "errors", "jet", "keeps", "roots", "rules", "table", "units"],
    ["fit_path", "linear", "measure", "points", "scan"],
    ["classic", "fit_arcs", "fit_balance", "kernel", "keys", "laws", "pieces", "spline"],
    ["fit_chords", "fit_cubics", "gearing", "law_table", "many", "station", "synthesis_closed"],
    ["drives", "fit", "law_of", "offset_slot", "path_wheel", "synthesis_limit"],
    ["coulisse", "linkage"],
    ["drives.*"],
    ["kinds"],
    ["layout", "size_rules"],
    ["mechanism", "pitch"],
    ["contact", "spec", "timing"],
    ["forces"],
    ["load_peaks"],
    ["loads", "motion", "peaks", "profile", "undercut", "gears", "groove"],
    ["plane", "polyarc", "positive"],
    ["contacts", "sizes"],
    ["clash", "crank", "slot_ways", "straight_walls", "wheel"],
    ["wall_joint"],
    ["curved_walls"],
    ["outline"],
    ["play"],
    ["full_turn", "part_drawing"],
    ["part", "proof"],
    ["clearances"],
    ["turn_cautions"],
    ["cautions", "load_cautions", "law_values", "survey", "template"],
    ["synthesis_parts", "synthesis_wish"],
    ["synthesis"],
    ["checks", "remedies"],
    ["advice", "synthesis_built"],
    ["batch", "report", "synthesis_spec"],
    ["output.ezdxf_alone", "output.files", "output.finite", "output.inks", "output.text"],
    ["output.*"],
    ["output"],
    ["accuracy", "accuracy.formulas", "accuracy.method", "accuracy.timing_pairs"],
    ["accuracy.flank", "accuracy.plot", "accuracy.truth"],
    ["accuracy.bench_peaks"],
    ["accuracy.*"],
    ["accuracy.bench"],
    ["commands", "commands.options"],
    ["commands.*"],
    ["streams"],
    ["app"],
    ["__main__"],
]
STREAMS = ["app", "streams", "commands.*", "output", "output.*", "spec", "points"]
TYPER = ["app", "commands.*"]


def modules():
    for folder, _, files in os.walk(ROOT):
        for file in sorted(files):
            if file.endswith(".py"):
                path = os.path.relpath(os.path.join(folder, file), ROOT)
                name = path.removesuffix(".py").replace(os.sep, ".")
                yield (name.removesuffix(".__init__") if name != "__init__" else "geneva_cli")


MODULES = sorted(modules())


def source(module):
    path = os.path.join(ROOT, *([] if module == "geneva_cli" else module.split(".")))
    path = os.path.join(path, "__init__.py") if os.path.isdir(path) else path + ".py"
    with open(path, encoding="utf-8") as file:
        return file.read()


def row_of(module):
    """The row that writes the name out, or else the one with a fitting *; None if there is none."""
    for fits in (lambda pattern: pattern == module, lambda p: fnmatchcase(module, p)):
        for number, row in enumerate(ROWS):
            if any(fits(pattern) for pattern in row):
                return number
    return None


def running(tree):
    """The nodes that run: all but what stands under ``if TYPE_CHECKING``."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            for other in node.orelse:
                yield from running(other)
            continue
        yield node
        yield from running(node)


def own(name):
    """The module of ours that an import of ``geneva_cli.name`` means, whatever it takes of it."""
    parts = name.split(".")
    while parts and ".".join(parts) not in MODULES:
        parts.pop()
    return ".".join(parts) or "geneva_cli"


def imports(text):
    """All modules that a source imports, at its top or in a function; ours without the package."""
    for node in running(ast.parse(text)):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, "relative imports hide where they go"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            prefix = ast.unparse(node.args[0]).strip("f'\"").split("{")[0]
            under = prefix.removeprefix("geneva_cli.")
            names = [f"geneva_cli.{m}" for m in MODULES if m.startswith(under)] or [prefix]
        else:
            continue
        for name in names:
            if name == "geneva_cli" or name.startswith("geneva_cli."):
                yield own(name.removeprefix("geneva_cli."))
            else:
                yield f"{name} (theirs)"


def climbs(module, text):
    here = row_of(module)
    found = {name for name in imports(text) if not name.endswith("(theirs)")}
    return sorted(name for name in found if row_of(name) is None or row_of(name) >= here)


def streams(text):
    """Calls and names in a source that touch a file or a stream."""
    for node in running(ast.parse(text)):
        said = ast.unparse(node)
        if isinstance(node, ast.Call) and ast.unparse(node.func) in (
            "open",
            "io.open",
            "os.open",
            "print",
            "input",
            "exec",
        ):
            yield said
        if isinstance(node, ast.Attribute) and said in ("sys.stdin", "sys.stdout", "sys.stderr"):
            yield said


def among(module, patterns):
    return any(fnmatchcase(module, pattern) for pattern in patterns)


@pytest.mark.parametrize("module", MODULES)
def test_has_a_row(module):
    assert row_of(module) is not None, "add the module to ROWS, above all that it imports"


def test_rows_hold_only_what_exists():
    for pattern in (p for row in ROWS for p in row):
        assert any(fnmatchcase(module, pattern) for module in MODULES), pattern


@pytest.mark.parametrize("module", [m for m in MODULES if row_of(m) is not None])
def test_imports_go_down(module):
    assert climbs(module, source(module)) == []


@pytest.mark.parametrize("module", [m for m in MODULES if not among(m, STREAMS)])
def test_touches_no_stream(module):
    assert list(streams(source(module))) == []


@pytest.mark.parametrize("module", [m for m in MODULES if not among(m, TYPER)])
def test_does_not_know_typer(module):
    assert not [name for name in imports(source(module)) if name.startswith(("typer", "click"))]


@pytest.mark.parametrize(
    "line",
    [
        "from geneva_cli.peaks import peak",
        "from geneva_cli import app",
        "import geneva_cli.output.text",
        "def late():\n    from geneva_cli.mechanism import build",
        "importlib.import_module(f'geneva_cli.commands.{name}')",
    ],
)
def test_an_import_upwards_would_be_noticed(line):
    assert climbs("mechanism", line)
    assert not climbs("mechanism", "if TYPE_CHECKING:\n" + textwrap.indent(line, "    "))


def test_a_stream_would_be_noticed():
    assert list(streams("def f():\n    print(1)")) == ["print(1)"]
    assert list(streams("x = sys.stdout.isatty()")) == ["sys.stdout"]
