"""``geneva explain``."""


def run(words: tuple[str, ...] = (), output: str = "-", format: str = "") -> None:
    """Explain a word of the output: meaning, formula, unit, source, what to do, manual page.

    Arguments:
      [CHECK|QUANTITY|KIND]  horn_mm, acceleration.max, side-crank, a warning, a part, ...;
                             without one: all.

    Examples:
      geneva explain
      geneva explain pin stress
      geneva explain turns-back
      geneva explain loads.pin_force_N.max --format json
    """
    from geneva_cli.cli.pages import search
    from geneva_cli.output import is_for_people, show, show_markdown
    from geneva_cli.specfile import meanings
    from geneva_cli.table import Reading, rows_table

    word, names = " ".join(words), ("group", "name", "about")
    people = is_for_people(output, format)
    if not word and people:
        title = "`geneva explain WORD` says what a word of any output means; these are explained:"
        columns, first = ("words", "number", "about", "such_as"), Reading(("words", "such_as"))
        show(rows_table(columns, meanings.groups(), title, reading=first), output, format)
    elif not word:
        rows = [(m.group, m.name, m.sentence) for m in meanings.everything() if m.group != "key"]
        show(rows_table(names, rows), output, format)
    elif entries := meanings.meanings(word):
        if people:
            show_markdown(meanings.as_markdown(entries), output)
        else:
            show(rows_table(meanings.Meaning._fields, entries), output, format)
    elif found := meanings.related(word) or [("page", f"help {x}", y) for x, _, y in search(word)]:
        title = f"{word}: `geneva explain NAME` says more." if people else ""
        show(rows_table(names, found, title, reading=Reading(names[1:])), output, format)
    else:
        raise meanings.unknown(word)
