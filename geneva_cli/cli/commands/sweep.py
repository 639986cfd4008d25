"""``geneva sweep``."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.cli.command import tell
from geneva_cli.errors import GenevaError
from geneva_cli.progress import tracked

if TYPE_CHECKING:
    from geneva_cli.study.fields import Rows
    from geneva_cli.study.sweep.request import Outcome
    from geneva_cli.study.sweep.run import Sweep


def run(
    spec: str,
    vary: tuple[str, ...] = (),
    pick: str = "",
    random: int | None = None,
    seed: int | None = None,
    check: bool = False,
    subject_to: tuple[str, ...] = (),
    pareto: str = "",
    best: str = "",
    resume: bool = False,
    jobs: int | None = None,
    settings: tuple[str, ...] = (),
    output: str = "-",
    format: str = "",
) -> None:
    """Compute one row for each design: the varied keys, then the quantities.

    VALUES are 4,6,8, 3..12, 0..0.9:0.1 or words. With --random and --best, LOW..HIGH is the
    whole range between.
    Long runs and the best of many: `geneva help search`.

    Designs:
      --vary KEY=VALUES  As drive.A=0..0.9:0.1 or motion.law=a,b; repeat.
      --pick FIELD,...   Quantities, as acceleration.max,dwell_s.
      --random N         N random designs from the ranges, not the grid.
      --seed S           Seed of the random designs; 0 by default.
      --check            Add whether all checks pass.

    Choice:
      --subject-to BOUND      Only rows that keep it: "dwell_s >= 0.8"; repeat.
      --pareto min:FIELD,...  Only rows that no other row beats in all of these.
      --best min:FIELD        The best design, refined, as a spec; or max:.

    Long runs:
      --resume  Continue a stopped run.
      --jobs N  Number of processes; all cores by default.

    Options:
      -o, --output FILE  A .csv or .parquet; - prints.

    Examples:
      geneva sweep spec.toml --vary wheel.z=4..12 --pick dwell_s,acceleration.max
      geneva sweep spec.toml --vary size.roller_radius_mm=8..16:1 -o all.csv
      geneva sweep spec.toml --vary wheel.z=4..12 --pareto min:jerk.max,max:dwell_s
    """
    from geneva_cli.output import chosen, require_spec, show, show_text
    from geneva_cli.study.fields import cells_of, joined
    from geneva_cli.study.sweep.request import Outcome, request
    from geneva_cli.table import Table

    if best:
        require_spec(output, format)
    else:
        chosen("-", format)
    plan = request(spec, vary, settings, pick, random, seed, check, subject_to, pareto, best, jobs)
    if resume and (best or plan.chooses or format not in ("", "csv")):
        raise GenevaError("--resume continues all rows of a sweep, as csv or parquet")
    outcome = Outcome(plan)
    if plan.goal:
        from geneva_cli.study.sweep.best import best_spec

        lines = best_spec(outcome, plan.goal, _tracked(plan, 0))
        show_text("\n".join(lines) + "\n", output, plan.inputs)
    elif format in ("", "csv"):
        _write_rows(plan, outcome, output, resume, bool(format))
    else:
        names = plan.names
        blocks = [*outcome.rows(_tracked(plan, 0))]
        columns = map(cells_of, joined(blocks).columns.values()) if blocks else ([] for _ in names)
        table = Table(names, [*columns])
        show(table, output, format, plan.inputs)
    for note in outcome.notes():
        tell(f"{spec}: {note}")


def _write_rows(plan: "Sweep", outcome: "Outcome", output: str, resume: bool, whole: bool) -> None:
    """Write all rows or the chosen ones as they come; show a person some of them and the best.

    ``whole`` shows a person all rows too.
    """
    from geneva_cli.output import is_seen, show
    from geneva_cli.output.growing import growing
    from geneva_cli.study.sweep.request import Digest
    from geneva_cli.study.sweep.run import TEXTS

    shows_all, digest = is_seen(output), None
    if shows_all and not whole:
        digest = Digest(plan)
        for block in outcome.rows(_tracked(plan, 0)):
            digest.add(block)
    else:
        with growing(plan.names, plan.key, output, resume, plan.inputs, TEXTS) as rows:
            if rows.message:
                tell(rows.message)
            if is_seen("-") and not (shows_all or rows.done):
                digest = Digest(plan, output)
            blocks = plan.blocks(rows.done) if shows_all else _tracked(plan, rows.done)
            for block in outcome.rows(blocks):
                columns = block.columns.values()
                rows.append([c.tolist() if c.dtype == object else c for c in columns])
                if digest:
                    digest.add(block)
    for table in digest.tables() if digest else ():
        show(table)


def _tracked(plan: "Sweep", done: int) -> "Iterator[Rows]":
    """The rows, with a progress bar."""
    return tracked(plan.blocks(done), "designs", len(plan.plan) - done, len)
