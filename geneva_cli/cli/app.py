"""The command line: commands that load when chosen, and the one place where errors become text.

The group knows each command by name and one line of help, so that --help, completion and
suggestions import no command. Annotations are objects here and in the commands, for Typer.
"""

import importlib
import os
import sys
import textwrap
from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, NoReturn, get_args

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from geneva_cli import __version__
from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.progress import ProgressBar, close, show_with
from geneva_cli.streams import leave, open_streams

# The registry by task: the module in geneva_cli.cli.commands, and its line in --help.
GROUPS = {
    "Calculate": {
        "table": "Timing and peaks of wheels, a row for each number of slots.",
        "peaks": "Greatest velocity, acceleration, jerk and power.",
        "motion": "Position, velocity, acceleration, jerk over a cycle.",
        "loads": "Torque, forces, power over the cycle; motor, flywheel, life.",
        "vibration": "What an index leaves swinging; speeds to avoid.",
        "tolerance": "Place and play from each dimension's plus or minus.",
        "laws": "The motion laws and their characteristic values.",
    },
    "Judge": {
        "check": "Does the design work? Exit status 1 where a check fails.",
        "report": "Everything about a design on a page.",
    },
    "Choose": {
        "synth": "From requirements (angle, time, ...) to machines for them.",
        "compare": "Designs side by side, a column each.",
        "sweep": "Thousands of designs, a row each; the best of them.",
    },
    "Draw": {
        "size": "Every size that a rule or the load chose, into the spec.",
        "profile": "Slots, parts and machines as csv, dxf, svg, step, stl, 3mf.",
        "plot": "Curves over the cycle, or of a sweep's csv.",
        "export": "Everything a shop needs, in a folder.",
        "animate": "A page on which the machine turns; --open shows it.",
    },
    "Learn": {
        "help": "The manual: a page for each topic.",
        "new": "A commented spec to start from.",
        "explain": "What a check, a quantity, a kind or a warning means.",
        "keys": "Every key of a spec: unit, range, default, meaning.",
        "schema": "JSON Schema of a spec, for editors.",
    },
}
COMMANDS = {name: line for group in GROUPS.values() for name, line in group.items()}


FAULT = 70  # exit status; EX_SOFTWARE of sysexits.h, and no status of a design or a user's error
REPORT = (
    "please report it in the issues of geneva-cli, with the spec; GENEVA_DEBUG=1 shows where it is"
)
HELP = {"help_option_names": ["-h", "--help"]}
USAGE: Any = typer.BadParameter.__base__  # Typer's error for arguments that no command takes


class PlainValues:
    """A command or group that converts what is typed by itself.

    From release 0.29 on Typer loads pydantic for that, which doubles the time of a short run
    (`make bench-start`). So every release is as quick, and has the same messages.
    """

    kinds: Mapping[str, Any] = {}  # name of a parameter -> its type

    def get_params(self, ctx: Any) -> list[Any]:
        """Options and arguments, each with its own conversion."""
        params: list[Any] = super().get_params(ctx)  # type: ignore[misc]
        for param in params:
            if "process_value" not in vars(param):
                kind = self.kinds.get(param.name)
                param.process_value = partial(_value, param, kind, param.process_value)
        return params


def _value(param: Any, kind: Any, refuse: Any, ctx: Any, typed: Any) -> Any:
    """Value of a parameter; what is required and missing is left to Typer, to ``refuse``.

    While a shell completes words, nothing is refused.
    """
    if param.required and not typed and not ctx.resilient_parsing:
        return refuse(ctx, typed)
    value = () if typed is None and (param.multiple or param.nargs == -1) else typed
    for number, meaning in {float: "a number", int: "a whole number"}.items():
        if isinstance(typed, str) and kind in (number, number | None):
            try:
                value = number(typed)
            except ValueError:
                message = f"{typed!r} is not {meaning}"
                raise typer.BadParameter(message, ctx=ctx, param=param) from None
    return param.callback(ctx, param, value) if param.callback else value


class Command(PlainValues, TyperCommand):
    """A command whose help ends with examples, and which refuses ineffective options."""

    examples: tuple[str, ...] = ()

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse arguments, and refuse an option that would have no effect.

        Such an option is empty, as with an unset variable of a script, or stands there twice.
        """
        typed = list(args)
        rest = super().parse_args(ctx, args)
        if ctx.resilient_parsing:  # by a shell that completes words
            return rest
        order: list[Any] = [*self.make_parser(ctx).parse_args(typed)[2]]
        for option in dict.fromkeys(order):
            if not _is_option(option) or option.is_flag:
                continue
            value = ctx.params.get(option.name)
            if "" in value if option.multiple and value else value == "":
                raise GenevaError(f'{option.opts[0]} "": empty; give it a value, or leave it out')
            if order.count(option) > 1 and not option.multiple:
                raise GenevaError(f"{option.opts[0]}: given twice; only one of both would count")
        return rest

    def invoke(self, ctx: Any) -> Any:
        """Run the command; its tables have the columns of --columns, and the units of --units."""
        columns, wide = ctx.params.pop("columns", None), ctx.params.pop("wide", False)
        units = ctx.params.pop("shown_units", "mm")
        if not (columns or wide or units != "mm"):
            return super().invoke(ctx)
        from geneva_cli.output import Choice, choosing

        names = [name.strip() for name in (columns or "").split(",")]
        with choosing(Choice(tuple(filter(None, names)), wide, units)):
            return super().invoke(ctx)

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """The words after the command's name in its help."""
        return ["[OPTIONS]", *(_placeholder(p) for p in self.params if not _is_option(p))]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments, then options under their headings, with shared options last."""
        groups: dict[str, list[tuple[str, str]]] = {"Arguments": []}
        shared: list[tuple[str, str]] = []
        for param in self.get_params(ctx):
            record, heading = param.get_help_record(ctx), vars(param).get("rich_help_panel")
            if record and not _is_option(param):
                groups["Arguments"].append((_placeholder(param), record[1]))
            elif record:
                (groups.setdefault(heading, []) if heading else shared).append(record)
        for heading, records in (groups | {"Options": shared}).items():
            if records:
                with formatter.section(heading):
                    formatter.write_dl(records)

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write the examples as typed, each continued on the next line if needed."""
        if self.examples:
            with formatter.section("Examples"):
                for line in self.examples:
                    formatter.write(f"  {_continued(line, formatter.width)}\n")


def _is_option(param: Any) -> bool:
    return bool(param.param_type_name == "option")


def _placeholder(argument: Any) -> str:
    """The word that stands for an argument in help."""
    return str(argument.metavar or argument.name)


def _continued(line: str, width: int) -> str:
    """A command in lines of at most ``width`` letters, broken before options with a backslash."""
    first, *options = line.split(" -")
    lines = [first]
    for option in options:
        if len(lines[-1]) + len(option) + len("   - \\") > width:
            lines[-1] += " \\"
            lines.append(f"      -{option}")
        else:
            lines[-1] += f" -{option}"
    return "\n".join(lines)


class LazyGroup(PlainValues, TyperGroup):
    """A group of stubs; the chosen command's module is imported when it is resolved."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands = {n: TyperCommand(n, help=h, callback=_stub) for n, h in COMMANDS.items()}

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the options before the command; a wrong one becomes a line and an exit code."""
        shows_help = not args
        try:
            return super().parse_args(ctx, args)
        except USAGE as error:
            if shows_help:
                raise
            _fail(_usage("geneva", error))

    def list_commands(self, ctx: Any) -> list[str]:
        """Every command, in the order of the registry."""
        return list(COMMANDS)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the commands by task."""
        widest = max(map(len, COMMANDS))
        for name, group in GROUPS.items():
            with formatter.section(name):
                formatter.write_dl([(name.ljust(widest), line) for name, line in group.items()])
        from geneva_cli.manual import TOPICS

        with formatter.section("Manual, geneva help TOPIC or WORD"):
            lines = textwrap.wrap(", ".join(TOPICS), formatter.width - 2, break_on_hyphens=False)
            formatter.write("".join(f"  {line}\n" for line in lines))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The real command behind a stub."""
        name, stub, rest = super().resolve_command(ctx, args)
        if stub is None or name is None:
            return name, stub, rest
        module = importlib.import_module(f"geneva_cli.cli.commands.{name}")
        command = _command(name, module.run)
        command.examples = module.EXAMPLES
        if name not in {"animate", "help", "new", "plot", "schema"}:  # these print no wide table
            command.params += _command(name, _table_options).params
        # lengths, forces or masses are in the tables of these; profile has units of its own
        if name in {"check", "compare", "loads", "plot", "report", "sweep", "synth", "tolerance"}:
            command.params += _command(name, _unit_option).params
        return name, command, rest

    def invoke(self, ctx: Any) -> Any:
        """Run the command; an error that a user can correct becomes a line and an exit code."""
        show_with(_bar)
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


def _bar(what: str, total: int) -> ProgressBar | None:
    """A progress bar, if standard error is a terminal."""
    if not sys.stderr.isatty():
        return None
    from geneva_cli.output.terminal.bar import TextBar

    return TextBar(what, total)


def _stub() -> None:
    """The callback of a command whose module is not loaded."""


def _table_options(
    columns: Annotated[
        str | None,
        typer.Option("--columns", metavar="NAME,...", help="Only these columns, named as in csv."),
    ] = None,
    wide: Annotated[
        bool, typer.Option("--wide", help="All columns on a terminal, however wide.")
    ] = False,
) -> None:
    """Options of every command that prints a table."""


def _unit_option(
    shown_units: Annotated[
        str, typer.Option("--units", metavar="UNIT", help="Numbers in mm, or in inch and lb.")
    ] = "mm",
) -> None:
    """The option of commands whose numbers have units."""


def _command(name: str, run: Any) -> Any:
    """A function as a command."""
    one = typer.Typer(add_completion=False, rich_markup_mode=None)
    one.command(name, cls=Command, context_settings=HELP)(run)
    command: Any = get_command(one)
    command.kinds = {n: get_args(k)[0] for n, k in run.__annotations__.items() if get_args(k)}
    return command


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
    close()
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


@app.callback(no_args_is_help=True, context_settings=HELP)
def geneva(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Design calculator for Geneva (Maltese-cross) mechanisms."""


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
    close()
    if os.environ.get("GENEVA_DEBUG"):
        import traceback

        traceback.print_exc()
    command = cut(" ".join(["geneva", *sys.argv[1:]]), 200)
    what = cut(f"{type(error).__name__}: {error}", 200)
    print(clean(f"{command}: a fault of geneva {__version__}, {what}; {REPORT}"), file=sys.stderr)
    return FAULT
