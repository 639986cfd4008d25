"""Checks that fail: four changes of eleven designs, judged with their advice."""

from __future__ import annotations

from bench.method import Method, Subject
from bench.whole_runs import geneva, task

DESIGNS = (
    *("turret", "press-straight", "press-curved", "sine-group", "internal-z6", "side-crank-z6"),
    *("four-bar-z4", "spherical-z6", "three-rollers-z4", "linear", "behind-gears"),
)
CHANGES = (
    "size.roller_radius_mm=2",
    "size.lock_clearance_mm=3",
    "size.wheel_bore_mm=60",
    "limits.acceleration_max=0.3",
)


def subject(quick: bool) -> Subject:
    """A whole run of ``check`` for each design and change."""
    tasks = []
    for design in DESIGNS[:1] if quick else DESIGNS:
        for change in CHANGES[:1] if quick else CHANGES:
            words = "check", f"designs/{design}.toml", "--set", change
            own = Method("ours", None, geneva(*words).run, True)
            tasks.append(task(f"geneva {' '.join(words)}", [own]))
    return Subject("Advice on checks that fail", "none", tasks, seconds=1.0)
