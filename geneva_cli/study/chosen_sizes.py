"""A design with every size that a rule or its load chose written into its spec."""

from __future__ import annotations

from collections.abc import Mapping

from geneva_cli.answer import Answer, Summary
from geneva_cli.design import Design
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.chosen import Chosen
from geneva_cli.specfile.writer import Written, inserted, quoted, spec_lines
from geneva_cli.study.summary.load_lines import title_of
from geneva_cli.table import Reading, record_table, rows_table

KEPT = "its comments and its order are not kept"


def of_sizes(design: Design, as_json: bool) -> Answer:
    """The answer of ``geneva size``: a row for each size that a rule or the load chose."""
    spec, sizes = design.spec, design.chosen
    rows = rows_table(("key", "value", "why"), [(key, *one) for key, one in sizes.items()])
    rows = rows.replaced(reading=Reading(("key", "value", "why")))
    data = rows
    if as_json:
        data = record_table({"spec": spec.path, "title": spec.title, "rows": rows})
    count, loaded = len(sizes), len(design.chosen_by_load.sizes)
    text = f"{count} sizes chosen, {loaded} of them by the load" if count else "no size to choose"
    return Answer((Summary(f"{title_of(design)}: {text}"),), rows if count else None, data)


def sized_text(design: Design) -> tuple[str, str]:
    """The text of a design's spec with all its chosen sizes, and a note on what it does not keep.

    Comments and order are those of the file. Where a text has no line for a table or a value, all
    its tables are written anew; then the note says so.
    """
    text = design.text.text if design.text else None
    keys = {one.path: Written(one.value) for one in design.text.set_keys} if design.text else {}
    for key, size in design.chosen.items():
        keys[tuple(key.split("."))] = Written(size.value, size.why)
    for table in dict.fromkeys(path[:-1] for path in keys):
        own = {str(path[-1]): one for path, one in keys.items() if path[:-1] == table}
        is_plain = table and all(isinstance(name, str) for name in table)
        if text is not None:
            text = inserted(text, ".".join(map(str, table)), own) if is_plain else None
    return (written(design.sized.spec, design.chosen), KEPT) if text is None else (text, "")


def written(spec: Spec, sizes: Mapping[str, Chosen]) -> str:
    """The text of a spec, with the reasons of the sizes in it that were chosen."""
    lines = [f"title = {quoted(spec.title)}"] if spec.title else []
    lines += spec_lines(spec, {key: one.why for key, one in sizes.items()})
    return "\n".join(lines).lstrip("\n") + "\n"
