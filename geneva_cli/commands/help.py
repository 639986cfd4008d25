"""``geneva help``."""

from typing import Annotated, Any

import typer

from geneva_cli.commands import completion

EXAMPLES = (
    "geneva help",
    "geneva help cycle",
    "geneva help peaks",
)


def run(
    context: typer.Context,
    topic: Annotated[
        str,
        typer.Argument(
            metavar="[TOPIC]",
            help="A page or a command; all pages without.",
            autocompletion=completion.words(completion.topics),
        ),
    ] = "",
) -> None:
    """The manual: a page a topic. Of a command it shows the options."""
    from geneva_cli.manual import TOPICS, page
    from geneva_cli.output import show, show_markdown, show_text
    from geneva_cli.table import rows_table

    commands: Any = context.find_root().command
    if not topic:
        show(rows_table(("topic", "about"), list(TOPICS.items())))
    elif topic not in TOPICS and topic in commands.list_commands(context):
        _, command, _ = commands.resolve_command(context, [topic])
        info = typer.Context(command, parent=context.find_root(), info_name=topic)
        show_text(command.get_help(info) + "\n")
    else:
        show_markdown(page(topic))
