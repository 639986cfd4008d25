"""The peak acceleration of one design."""

from __future__ import annotations

import math
from functools import partial

from bench.formulas import Proportions, acceleration
from bench.method import Method, Subject, Task, missing
from bench.numeric import NUMERIC, by_chebpy, closed
from bench.truth import acceleration_peak, relative
from geneva_cli.drives.crank import Crank
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peak as program
from geneva_cli.motion.wheels import classic

CHEBPY = "chebfun"  # the package name of chebpy in pip, as another package has that name


def subject(quick: bool) -> Subject:
    """Every method on a few designs."""
    designs = ((3, "external", 0.0), (6, "external", 0.6), (4, "internal", 0.95))
    tasks = [_task(*design, quick) for design in designs[: 2 if quick else None]]
    return Subject(
        "Peak acceleration of one design",
        "relative error of the peak",
        tasks,
        absent=missing(CHEBPY),
    )


def _task(z: int, gearing: str, A: float, quick: bool) -> Task:
    wheel = registry.gearing(gearing)(z)
    d = Proportions.of(wheel.SIGN, z, A)
    methods = [
        Method(numeric.name, size, partial(numeric.run, d, size))
        for numeric in NUMERIC
        for size in (numeric.sizes[:2] if quick else numeric.sizes)
    ]
    if not missing(CHEBPY):
        methods.append(Method("chebpy, roots of the slope", None, partial(by_chebpy, d)))
    mechanism = build(Spec(wheel, SideCrank(A=A) if A else Crank()))
    engagement = mechanism.engagements[0]
    outside = wheel.SIGN > 0.0
    if not A and outside:
        l, gap = mechanism.ratio, classic.gap(wheel.SIGN, 1, z)
        methods += [
            Method("closed form of the textbook", None, lambda: closed(d)[0]),
            Method("ours", None, lambda: classic.acceleration_peak(l, gap)[0], True),
        ]
    methods.append(
        Method(
            "ours, as geneva peaks does",
            None,
            lambda: program(engagement.motion, "acceleration").max,
            True,
        )
    )
    name = f"{gearing}, z = {z}" + (f", A = {A:g}" if A else "")
    x = 0.3 * d.half
    return Task(
        name,
        "one evaluation of the formula in plain Python",
        lambda: acceleration(math, d, x),
        lambda peak: relative(peak, acceleration_peak(z, gearing, A)),
        methods,
    )
