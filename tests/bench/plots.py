"""Error against time, a panel for each task: the nearer to the lower left corner, the better."""

import itertools
import math
import os

COLUMNS = 4  # of panels
LEAST = 1e-17  # error that is drawn for 0


def write(subject, rows, path):
    """Write a subject's panels as an .svg; False if its methods have no error to show."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    by_task = {}
    for row in rows:
        if row.error is not None:
            by_task.setdefault(row.task, []).append(row)
    shown = {task: own for task, own in by_task.items() if any(row.error for row in own)}
    if not shown:
        return False
    lines = math.ceil(len(shown) / COLUMNS)
    figure, axes = pyplot.subplots(
        lines, COLUMNS, figsize=(4.0 * COLUMNS, 3.6 * lines), squeeze=False, layout="constrained"
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


def _draw(panel, task, rows):
    panel.set(xscale="log", yscale="log", title=task)
    sizes = {row.size for row in rows}
    for row, marker in zip(rows, itertools.cycle("osD^vPX*"), strict=False):
        name = row.method if len(sizes) < 2 or row.size is None else f"{row.method} ({row.size:g})"
        place = [row.time_ratio], [max(row.error or 0.0, LEAST)]
        colour = {"color": "tab:blue"} if row.ours else {"markerfacecolor": "none", "color": "0.3"}
        panel.plot(*place, marker, label=name, **colour)
    panel.margins(0.2, 0.2)
    panel.grid(True, which="major", color="0.9")
    panel.tick_params(labelsize=7)
    panel.xaxis.set_major_formatter("{x:g}")
    panel.xaxis.set_minor_formatter("")
    panel.yaxis.set_minor_formatter("")
    panel.title.set_size(8)
    panel.legend(fontsize=6, loc="upper center", bbox_to_anchor=(0.5, -0.08), frameon=False)
