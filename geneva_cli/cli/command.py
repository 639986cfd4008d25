"""A command as Typer runs it: own conversion of values, help with examples, shared options.

Annotations are objects here and in the commands, for Typer.
"""

import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from inspect import Parameter, Signature, cleandoc, signature
from textwrap import wrap
from typing import TYPE_CHECKING, Any, TypeAlias

import typer
from typer.core import TyperCommand
from typer.main import get_command

from geneva_cli.errors import GenevaError, Notice, clean

if TYPE_CHECKING:
    from geneva_cli.design import Design as Design

    Reversible: TypeAlias = Design
else:  # kinds of a command's first parameter, ``design``: of SPEC and --set; of --reverse too
    Design, Reversible = object(), object()

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
        if "design" in self.kinds:
            from geneva_cli.design import load

            spec, settings = ctx.params.pop("spec"), ctx.params.pop("settings")
            ctx.params["design"] = load(spec, settings, ctx.params.pop("reverse", False))
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


# Arguments and options of several commands, by parameter: names and placeholder, and meaning.
SHARED = {
    "spec": ("SPEC", "The spec, a TOML file; - reads standard input."),
    "specs": ("SPEC...", "Specs, TOML files."),
    "settings": ("--set KEY=VALUE", "Set a key over the file's, as drive.n_rpm=90."),
    "reverse": ("--reverse", "Turn the input the other way."),
    "output": ("-o, --output FILE", "Write to this file; - prints."),
    "format": ("--format FORMAT", "table, csv, json or md."),
}
SECTION = re.compile(r"\n\n(?=.+:\n  \S)")  # between the text of a help and each of its lists
# names, and behind two spaces or a line break their meaning, with lines that are indented more
ENTRY = re.compile(r"^  (\S.*?)(?:  +|\n   +)(.*(?:\n   .*)*)", re.MULTILINE)


def as_command(name: str, run: Any) -> Any:
    """A function as a command; its docstring is the help, with lists as they are printed.

    A command of one ``design`` has SPEC and its options in place of that parameter.
    """
    text, *lists = SECTION.split(cleandoc(run.__doc__))
    params, kind = [*signature(run).parameters.values()], run.__annotations__.get("design")
    if kind:
        spec, reverse, settings = signature(_design).parameters.values()
        options = [reverse, settings] if kind is Reversible else [settings]
        at = [*signature(run).parameters].index("output")
        params = [spec, *params[1:at], *options, *params[at:]]
    alone, examples = typer.Typer(add_completion=False, rich_markup_mode=None), ""
    if lists and lists[-1].startswith("Examples:"):
        examples = cleandoc(lists.pop().partition("\n")[2])

    def like() -> None:
        """Have the signature that Typer reads; ``run`` is called."""

    vars(like)["__signature__"] = Signature(_infos(params, lists))
    alone.command(name, cls=Command, context_settings=HELP, help=text)(like)
    command: Any = get_command(alone)
    command.kinds, command.examples = run.__annotations__, examples.splitlines()
    command.callback = run
    return command


def _infos(params: Sequence[Parameter], lists: Sequence[str]) -> list[Parameter]:
    """Parameters as Typer knows them, from the lists of a command's own arguments and options.

    An entry belongs to the parameter of its name. That of an argument without a name, as [KIND],
    belongs to the one parameter that is neither listed nor shared.
    """
    each, own, infos = dict[str, tuple[str, ...]](), dict[Parameter, tuple[str, ...]](), []
    for one in lists:
        heading, _, lines = one.partition(":\n")
        for names, meaning in ENTRY.findall(lines):
            option = names.partition("--")[2].partition(" ")[0]
            key = option.replace("-", "_") or names.lower().replace("...", "s")
            each[key] = names, re.sub(r"\n +", " ", meaning), heading
    for param in params:
        own[param] = each.pop(param.name.rstrip("_"), SHARED.get(param.name, ()))
    rest = iter(each.values())
    for param, shown in own.items():
        names, meaning, *panel = shown or next(rest)
        value = ... if param.default is Parameter.empty else param.default
        info = typer.Argument(value, metavar=names, help=meaning)
        if names.startswith("-"):
            options, placeholder = re.findall(r"(?<!\S)--?[^ ,]+", names), names.split()[-1]
            info = typer.Option(
                value,
                *options,
                metavar=None if placeholder in options else placeholder,
                help=meaning,
                rich_help_panel=panel[0] if panel else None,
                show_default="-o" not in options,
            )
        kind = list[str] if param.annotation == tuple[str, ...] else param.annotation
        infos.append(param.replace(default=info, annotation=kind))
    return infos


def _design(spec: str, reverse: bool = False, settings: tuple[str, ...] = ()) -> None:
    """Parameters in place of a design."""


def words_in(text: str) -> list[str]:
    """The words of a list between commas."""
    return [word.strip() for word in text.split(",") if word.strip()]


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
    path, (refused, warned) = design.spec.path, verdict
    if refused and not force:
        tell(f"{path}: not written: {refused}; --force writes it anyway")
        raise typer.Exit(1)
    for text in filter(None, [refused, *warned]):
        tell(f"{path}: warning: {text}")
