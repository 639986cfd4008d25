"""From requirements to machines: whole runs, with the first twenty turned and without."""

from __future__ import annotations

from bench.method import Method, Subject
from bench.timing_pairs import wall_s
from bench.whole_runs import geneva, task


def subject(quick: bool) -> Subject:
    """One task for each set of requirements."""
    targets: tuple[str, ...] = (
        "--motion-deg 180 --z 6",
        "--motion-deg 100..200",
        "--motion-deg 100..200 --internal",
        "--motion-deg 100..170 --rollers 2",
        "--motion-deg 150..200 --spherical",
        "--motion-deg 100..200 --law all",
        "--motion-deg 120.. --sort min:jerk.max",
        "--tau 1/3 --buildable",
        "--dwell-s 0.8.. --cycle 1.5 --motion-deg ..180",
        "--cycle 1.5 --subject-to dwell_s>=0.8",
        "--subject-to timing.tau<=0.3 --subject-to velocity.max<=2",
        "--subject-to acceleration.max<=0.5",
        "--motion-deg 120..150 --z 6 --subject-to parts.horn_mm>=5",
        "--motion-deg 120..150 --z 6,8 --sort max:checks.horn_mm",
    )
    checked = {"search": "0", "search, twenty turned": "20"}  # rows whose parts are turned
    if quick:
        targets, checked = ("--motion-deg 180 --z 6 --external --rollers 1",), {"search": "0"}
    tasks = [
        task(
            f"geneva synth {target}",
            [
                Method(name, None, geneva("synth", *target.split(), "--check", count).run, True)
                for name, count in checked.items()
                if count != "0" or "--buildable" not in target
            ],
        )
        for target in targets
    ]
    # several processes search at once: a user waits for the wall clock
    return Subject(
        "From requirements to machines: whole runs, on all cores", "none", tasks, clock=wall_s
    )
