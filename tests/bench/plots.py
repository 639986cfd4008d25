"""Error against time, a panel for each task: the nearer to the lower left corner, the better."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence

from bench.method import BenchRow, Subject

COLUMNS = 4  # of panels
LEAST = 1e-17  # error that is drawn for 0


def write(subject: Subject, rows: Sequence[BenchRow], path: str) -> bool:
    """Write a subject's panels as an .svg; False if its methods have no error to show."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    by_task: dict[str, list[BenchRow]] = {}
    for row in rows:
        if row.error is not None:
            by_task.setdefault(row.task, []).append(row)
    shown = {task: own for task, own in by_task.items() if any(row.error for row in own)}
    if not shown:
        return False
    lines = math.ceil(len(shown) / COLUMNS)
    figure, axes = pyplot.subplots(
        lines, COLUMNS, figsize=(4.2 * COLUMNS, 3.2 * lines), squeeze=False, layout="constrained"
    )
    figure.suptitle(f"{subject.title}\nacross: time over the baseline's; up: {subject.error}")
    for panel in axes.flat[len(shown) :]:
        panel.set_axis_off()
    for panel, (task, own) in zip(axes.flat, shown.items(), strict=False):
        _draw(panel, task, own)
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
    return True


def _draw(panel, task: str, rows: Sequence[BenchRow]) -> None:  # type: ignore[no-untyped-def]
    panel.set(xscale="log", yscale="log")
    panel.set_title(task, fontsize=8)
    for row in rows:
        place = row.time_ratio, max(row.error or 0.0, LEAST)
        panel.plot(*place, "o" if row.ours else "s", color="tab:blue" if row.ours else "0.5")
        name = row.method if row.size is None else f"{row.method} ({row.size:g})"
        panel.annotate(name, place, (0, 5), textcoords="offset points", fontsize=6, ha="center")
    panel.margins(0.3)
    panel.grid(True, which="major", color="0.9")
    panel.tick_params(labelsize=7)
