"""``geneva sweep``."""

from geneva_cli.cli.command import tell
from geneva_cli.errors import GenevaError
from geneva_cli.progress import tracked


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
    from geneva_cli.output import chosen, is_seen, require_spec, show, show_text
    from geneva_cli.output.growing import growing
    from geneva_cli.study.fields import cells_of, joined
    from geneva_cli.study.sweep.request import Digest, Outcome, request
    from geneva_cli.study.sweep.run import TEXTS
    from geneva_cli.table import Table

    if best:
        require_spec(output, format)
    else:
        chosen("-", format)
    plan = request(spec, vary, settings, pick, random, seed, check, subject_to, pareto, best, jobs)
    if resume and (best or plan.chooses or format not in ("", "csv")):
        raise GenevaError("--resume continues all rows of a sweep, as csv or parquet")
    outcome, count, digest = Outcome(plan), len(plan.plan), None
    watched = tracked(plan.blocks(0), "designs", count, len)  # with a progress bar
    if plan.goal:
        from geneva_cli.study.sweep.best import best_spec  # no other sweep needs it

        lines = best_spec(outcome, plan.goal, watched)
        show_text("\n".join(lines) + "\n", output, plan.inputs)
    elif format not in ("", "csv"):
        blocks = [*outcome.rows(watched)]
        cells = map(cells_of, joined(blocks).columns.values()) if blocks else ()
        columns = [*cells] or [()] * len(plan.names)
        show(Table(plan.names, columns), output, format, plan.inputs)
    elif is_seen(output) and not format:  # a person sees some rows, and the best
        digest = Digest(plan)
        for block in outcome.rows(watched):
            digest.add(block)
    else:
        with growing(plan.names, plan.key, output, resume, plan.inputs, TEXTS) as rows:
            if rows.message:
                tell(rows.message)
            if is_seen("-") and output != "-" and not rows.done:
                digest = Digest(plan, output)
            rest = plan.blocks(rows.done)
            if not is_seen(output):
                rest = tracked(rest, "designs", count - rows.done, len)
            for block in outcome.rows(rest):
                own = block.columns.values()
                rows.append([c.tolist() if c.dtype == object else c for c in own])
                if digest:
                    digest.add(block)
    for table in digest.tables() if digest else ():
        show(table)
    for note in outcome.notes():
        tell(f"{spec}: {note}")
