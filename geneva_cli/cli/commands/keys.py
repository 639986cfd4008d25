"""``geneva keys``."""


def run(word: str = "", output: str = "-", format: str = "") -> None:
    """List the keys of a spec: unit, allowed values, default, and the machines that have them.

    Arguments:
      [TABLE|KEY]  drive, drive.A or A; without one: all.

    Examples:
      geneva keys drive
      geneva keys size.center_distance_mm
    """
    from geneva_cli.output import show
    from geneva_cli.specfile.keys import Key, about
    from geneva_cli.table import Reading, rows_table

    first = ("key", "meaning", "goes_with", "table", "unit", "default", "range")
    reading = Reading(first, decide=("goes_with",))  # two kinds may have a key of one name
    show(rows_table(Key._fields, about(word), reading=reading), output, format)
