"""The command line: commands that load when chosen, and the one place where errors become text.

The group knows each command by name and one line of help, so that --help, completion and
suggestions import no command. Annotations are objects here and in the commands, for Typer.
"""

import importlib
import os
import sys
import textwrap
from functools import partial
from inspect import cleandoc
from typing import Any, NoReturn

import typer
from typer.core import TyperCommand, TyperGroup

import geneva_cli.progress as progress  # ``from geneva_cli`` would load the lists of kinds
from geneva_cli import __version__
from geneva_cli.cli.command import HELP, USAGE, PlainValues, as_command
from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.streams import leave, open_streams

FAULT = 70  # exit status; EX_SOFTWARE of sysexits.h, and no status of a design or a user's error
REPORT = "please report it in the issues of geneva-cli, with the spec and GENEVA_DEBUG=1"
NO_PAGER = "--no-pager"


def table_options(columns: str | None = None, wide: bool = False) -> None:
    """Options of every command that prints a table.

    Options:
      --columns NAME,...  Only these columns, as in csv.
      --wide              All columns on a terminal, however wide.
    """


class LazyGroup(PlainValues, TyperGroup):
    """A group of stubs; the chosen command's module is imported when it is resolved."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, line in COMMANDS.items():
            self.commands[name] = TyperCommand(name, help=line, callback=lambda: None)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the options before the command; a wrong one becomes a line and an exit code."""
        if NO_PAGER in args:  # before or behind the command
            from geneva_cli.output.terminal import pager

            pager.is_wanted = False
            args = [word for word in args if word != NO_PAGER]
        shows_help = not args
        try:
            return super().parse_args(ctx, args)
        except USAGE as error:
            if shows_help:
                raise
            _fail(_usage("geneva", error))

    def format_help_text(self, ctx: Any, formatter: Any) -> None:
        """Write what it is, examples, the commands by task and the manual; options follow."""
        super().format_help_text(ctx, formatter)
        with formatter.section("Examples"):
            formatter.write("\n".join([*EXAMPLES, ""]))
        widest = max(map(len, COMMANDS))
        for name, group in GROUPS.items():
            with formatter.section(name):
                formatter.write_dl([(name.ljust(widest), line) for name, line in group.items()])
        from geneva_cli.manual import GROUPS as PAGES

        with formatter.section("Manual, geneva help TOPIC or WORD; geneva help: all topics"):
            for name, topics in PAGES.items():
                text = f"  {name.replace(': ', ', ')}: {', '.join(topics)}"
                shorten = partial(textwrap.shorten, placeholder=" ...", break_on_hyphens=False)
                formatter.write(f"  {shorten(text, formatter.width - 2)}\n")

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write nothing behind the options: the commands stand before them."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The real command behind a stub."""
        name, stub, rest = super().resolve_command(ctx, args)
        if stub is None or name is None:
            return name, stub, rest
        module = importlib.import_module(f"geneva_cli.cli.commands.{name}")
        command = as_command(name, module.run)
        # these print no wide table
        if name not in {"animate", "explain", "export", "help", "new", "plot", "schema"}:
            command.params += as_command(name, table_options).params
        return name, command, rest

    def invoke(self, ctx: Any) -> Any:
        """Run the command; an error that a user can correct becomes a line and an exit code."""
        progress.maker = _bar
        try:
            return super().invoke(ctx)
        except GenevaError as error:
            _fail(str(error))
        except USAGE as error:
            path = f"geneva {ctx.invoked_subcommand}" if ctx.invoked_subcommand else "geneva"
            _fail(_usage(path, error))
        except OSError as error:
            _fail(f"{error.filename or 'system'}: {error.strerror}")
        except MemoryError:
            _fail("out of memory; ask for fewer samples or a coarser tolerance")


def _bar(what: str, total: int) -> Any:
    """A progress bar, if standard error is a terminal that can move its cursor."""
    if not sys.stderr.isatty() or os.environ.get("TERM") == "dumb":
        return None
    from geneva_cli.output.terminal.bar import Bar

    return Bar(what, total)


def _usage(path: str, error: Any) -> str:
    """The message on wrong arguments of ``path``: the program and its command."""
    message = error.format_message().rstrip(".")
    option = vars(error).get("option_name")  # of an unknown one
    if option in ("--rpm", "--n-rpm", "--speed"):
        has_n = any("--n" in param.opts for param in error.ctx.command.params)
        speed = "--n" if has_n else "--set drive.n_rpm=RPM"
        message = f"no such option: {option} (did you mean {speed}?)"
    if ". Did you mean " in message:
        message = message.replace(". Did you mean ", " (did you mean ") + ")"
    return f"{path}: {message[:1].lower()}{message[1:]}; see {path} -h"


def _fail(message: str) -> NoReturn:
    progress.close()
    print(cut(clean(message), 1000), file=sys.stderr)  # at most 1000 characters
    raise typer.Exit(2) from None


def _version(is_requested: bool) -> None:
    if is_requested:
        print(f"geneva {__version__}")
        raise typer.Exit


# NumPy's arrays here are small: starting threads for them would cost more than it saves.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Without Rich's markup the help is plain text, which needs no import of Rich.
app = typer.Typer(cls=LazyGroup, rich_markup_mode=None, pretty_exceptions_enable=False)


def geneva(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Show the version."
    ),
    no_pager: bool = typer.Option(
        False, NO_PAGER, help="Print long output on a terminal without a stop."
    ),
) -> None:
    """Design calculator for Geneva (Maltese-cross) mechanisms.

    Examples:
      geneva new external -o spec.toml
      geneva check spec.toml
      geneva profile spec.toml --part wheel -o wheel.dxf

    Calculate:
      table      Timing and peaks of wheels, a row for each number of slots.
      peaks      Greatest velocity, acceleration, jerk and power.
      motion     Position, velocity, acceleration, jerk over a cycle.
      loads      Torque, forces, power over the cycle; motor, flywheel, life.
      vibration  What an index leaves swinging; speeds to avoid.
      tolerance  Place and play from each dimension's plus or minus.
      laws       The motion laws and their characteristic values.

    Judge:
      check      Does the design work? Exit status 1 where a check fails.
      report     Everything about a design on a page.

    Choose:
      synth      From requirements (angle, time, ...) to machines for them.
      compare    Designs side by side, a column each.
      sweep      Thousands of designs, a row each; the best of them.

    Draw:
      size       Every size that a rule or the load chose, into the spec.
      profile    Slots, parts and machines as csv, dxf, svg, step, stl, 3mf.
      plot       Curves over the cycle, or of a sweep's csv.
      export     Everything a shop needs, in a folder.
      animate    A page on which the machine turns; --open shows it.

    Learn:
      help       The manual: a page for each topic.
      new        A commented spec to start from.
      explain    What a check, a quantity, a kind or a warning means.
      keys       Every key of a spec: unit, range, default, meaning.
      schema     JSON Schema of a spec, for editors.
    """


# The registry of commands is that text: by task, each module in geneva_cli.cli.commands.
_about, _examples, *_groups = cleandoc(geneva.__doc__ or "").split("\n\n")
_, *EXAMPLES = _examples.splitlines()
GROUPS: dict[str, dict[str, str]] = {}
for _title, *_lines in map(str.splitlines, _groups):
    GROUPS[_title.rstrip(":")] = dict(_line.split(maxsplit=1) for _line in _lines)
COMMANDS = {name: line for group in GROUPS.values() for name, line in group.items()}
app.callback(no_args_is_help=True, context_settings=HELP, help=_about)(geneva)


def main() -> None:
    """Run the command line and end the process."""
    open_streams()
    try:
        app(prog_name="geneva")
        status = 0
    except SystemExit as stop:
        status = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except Exception as error:
        status = _fault(error)
    leave(status)


def _fault(error: Exception) -> int:
    """Report a fault of the program in one line; return its exit status."""
    progress.close()
    if os.environ.get("GENEVA_DEBUG"):
        import traceback

        traceback.print_exc()
    command = cut(" ".join(["geneva", *sys.argv[1:]]), 200)
    what = cut(f"{type(error).__name__}: {error}", 200)
    print(clean(f"{command}: a fault of geneva {__version__}, {what}; {REPORT}"), file=sys.stderr)
    return FAULT
