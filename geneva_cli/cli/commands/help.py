"""``geneva help``."""

from geneva_cli.errors import GenevaError, cut, nearest


def run(words: tuple[str, ...] = ()) -> None:
    """Show a page of the manual, the options of a command, or all places of a word.

    Arguments:
      [WORD...]  A page, a command, or words to search for; without one: all pages.

    Examples:
      geneva help
      geneva help cycle
      geneva help friction
    """
    from geneva_cli.cli.app import COMMANDS
    from geneva_cli.cli.pages import Hit, command_help, page, program, search
    from geneva_cli.manual import TOPICS, read
    from geneva_cli.output import show, show_markdown, show_text
    from geneva_cli.table import Reading, rows_table

    topic = " ".join(words)
    if f"{topic}s" in TOPICS and topic not in COMMANDS:
        topic = f"{topic}s"
    if not topic:
        show_markdown(read("contents.txt"))
    elif topic in TOPICS:
        show_markdown(page(topic))
    elif topic in COMMANDS:
        show_text(command_help(program(), topic) + "\n")
    elif hits := search(topic):
        title = f"{topic}: `geneva help TOPIC` shows a page."
        show(rows_table(Hit._fields, hits, title, reading=Reading(("topic", "line"))))
    else:
        raise GenevaError(
            f'"{cut(topic)}" is no page of the manual, and on no page{nearest(topic, TOPICS)}'
        )
