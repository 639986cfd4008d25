"""A command as Typer runs it: own conversion of values, help with examples, shared options.

Annotations are objects here and in the commands, for Typer.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from inspect import cleandoc
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperCommand
from typer.main import get_command

from geneva_cli.errors import GenevaError, Notice, clean

if TYPE_CHECKING:
    from geneva_cli.design import Design

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
    if param.name == "help":
        if typed and not ctx.resilient_parsing:
            _help(ctx)
        return typed
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


def _help(ctx: Any) -> None:
    """Show the help of a command, through the pager if it is long."""
    if sys.stdout.isatty():
        from geneva_cli.output.terminal import pager

        pager.write([ctx.get_help() + "\n"])
    else:
        print(ctx.get_help())
    ctx.exit()


class Command(PlainValues, TyperCommand):
    """A command whose help ends with examples, and which refuses ineffective options."""

    examples: Sequence[str] = ()

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
            if option.param_type_name != "option" or option.is_flag:
                continue
            value = ctx.params.get(option.name)
            if "" in value if option.multiple and value else value == "":
                raise GenevaError(f'{option.opts[0]} "": empty; give it a value, or leave it out')
            if order.count(option) > 1 and not option.multiple:
                raise GenevaError(f"{option.opts[0]}: given twice; only one of both would count")
        return rest

    def invoke(self, ctx: Any) -> Any:
        """Run the command; its tables have the columns of --columns."""
        from geneva_cli.output import choice

        columns = ctx.params.pop("columns", None)
        choice.columns = words_in(columns) if columns else []
        choice.wide = ctx.params.pop("wide", False)
        return super().invoke(ctx)

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """The words after the command's name in its help."""
        return ["[OPTIONS]", *filter(None, map(_placeholder, self.params))]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments, then options under their headings, with shared options last."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for param in self.get_params(ctx):
            name, heading = _placeholder(param), vars(param).get("rich_help_panel") or "Options"
            if record := param.get_help_record(ctx):
                own = groups.setdefault("Arguments" if name else heading, [])
                own.append((name, record[1]) if name else record)
        shared = groups.pop("Options")
        for heading, records in (groups | {"Options": shared}).items():
            with formatter.section(heading):
                formatter.write_dl(records)

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write the examples as typed, continued on the next line where they do not fit."""
        with formatter.section("Examples"):
            for line in self.examples:
                parts = wrap(line, formatter.width - 4, break_on_hyphens=False)
                formatter.write("  " + " \\\n      ".join(parts) + "\n")


def _placeholder(argument: Any) -> str:
    """The word that stands for an argument in help; "" for an option."""
    is_option = argument.param_type_name == "option"
    return "" if is_option else str(argument.metavar or argument.name)


def as_command(name: str, run: Any) -> Any:
    """A function as a command; its docstring is the help, and ends with examples."""
    text, _, examples = cleandoc(run.__doc__).partition("\n\nExamples:\n")
    one = typer.Typer(add_completion=False, rich_markup_mode=None)
    one.command(name, cls=Command, context_settings=HELP, help=text)(run)
    command: Any = get_command(one)
    command.kinds, command.examples = run.__annotations__, cleandoc(examples).splitlines()
    return command


def words_in(text: str) -> list[str]:
    """The words of a list between commas."""
    return [word.strip() for word in text.split(",") if word.strip()]


def one_of(names: Iterable[str]) -> str:
    """The allowed words of an option, for its help."""
    *others, last = names
    return f"{', '.join(others)} or {last}."


def option(
    default: Any,
    metavar: str,
    help: str,
    heading: str = "",
    name: str = "",
    show: str | bool = True,
) -> Any:
    """An option with a value, below a heading of the help.

    ``name`` has its names if the parameter's is another; the default is shown, or ``show``.
    """
    panel = heading or None
    return typer.Option(
        default, *name.split(), metavar=metavar, help=help, rich_help_panel=panel, show_default=show
    )


# the option of a file or folder to write
output_option = partial(option, name="-o --output", show=False)


def flag(name: str, help: str, heading: str = "") -> Any:
    """An option without a value, of these names, below a heading of the help."""
    return typer.Option(False, *name.split(), help=help, rich_help_panel=heading or None)


def table_options(
    columns: str | None = option(None, "NAME,...", "Only these columns, as in csv."),
    wide: bool = flag("--wide", "All columns on a terminal, however wide."),
) -> None:
    """Options of every command that prints a table."""


SPEC: Any = typer.Argument(
    ..., metavar="SPEC", help="The spec, a TOML file; - reads standard input."
)
SPECS: Any = typer.Argument(..., metavar="SPEC...", help="Specs, TOML files.")
SETTINGS = option((), "KEY=VALUE", "Set a key over the file's, as drive.n_rpm=90.", name="--set")
REVERSE = flag("--reverse", "Turn the input the other way.")
ALSO_REVERSE = flag("--reverse", "Also each design turning the other way.")
OUTPUT = output_option("-", "FILE", "Write to this file; - prints.")
FORMAT = option("", "FORMAT", "table, csv, json or md.", name="--format")


def tell(text: str) -> None:
    """Print a message on standard error."""
    print(clean(text), file=sys.stderr)


def say(path: str, warnings: Iterable[str]) -> None:
    """Print warnings about a spec on standard error, one a line, with names for `explain`."""
    for text in warnings:
        named, kind = text, "warning"
        if isinstance(text, Notice):
            named = f"{text.plain} [{text.name}]"
            kind = f"warning, accepted ({text.accepted})" if text.accepted else kind
        tell(f"{path}: {kind}: {named}")


def require_written(design: "Design", verdict: tuple[str, list[str]], force: bool) -> None:
    """Exit with status 1 for parts that overlap or cannot be built, unless forced; else warn."""
    path = design.spec.path
    refused, warned = verdict
    if refused and not force:
        text = f"not written: {refused}; --force writes it anyway"
        tell(f"{path}: {text}")
        raise typer.Exit(1)
    for text in [refused, *warned] if refused else warned:
        tell(f"{path}: warning: {text}")
