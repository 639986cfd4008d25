"""A wish: what is asked of a machine that is not designed yet.

Every wish about time or angle says something of the motion angle M of one engagement and of the
cycle time T, for m rollers:

    tau = m M/360    k = tau/(1 - tau)    dwell_deg = 360/m - M    motion_s = tau T
    dwell_s = (1 - tau) T

so that all of them together leave a span of M, and for each M in it a span of T.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.machine.registry import STANDARD_LAWS as LAWS
from geneva_cli.machine.spec import Spec
from geneva_cli.spec.rules import POSITIVE, Z_MAX, Range
from geneva_cli.study.survey import parse_z
from geneva_cli.study.sweep.constraints import Constraint, constraint, refuse_contradictions
from geneva_cli.study.synthesis.spans import Span, number, span

GEARINGS = ("external", "internal", "spherical")
WHEELS_MAX = 200  # numbers of slots in one call: each costs some hundredths of a second
CYCLE = Range(1e-6, 1e6)
STEP = Range(360.0 / Z_MAX, 120.0)
USUAL_RPM = 60.0
MARGIN = 1e-12  # share by which a machine stays below a limit, so that rounding does not break it
ANY = Span(0.0, math.inf)

# The wishes for a number or a range of it, each with what it may be, its name and unit in words.
SPANS = {
    "tau": (Range(0.0, 1.0, "()"), "tau", ""),
    "k": (Range(0.0, 1e6, "()"), "k", ""),
    "motion_deg": (Range(0.0, 360.0, "()"), "a motion of", " deg"),
    "dwell_deg": (Range(0.0, 360.0, "()"), "a dwell of", " deg"),
    "motion_s": (POSITIVE, "a motion of", " s"),
    "dwell_s": (POSITIVE, "a dwell of", " s"),
    "cycle": (CYCLE, "a cycle of", " s"),
}


class Wish(NamedTuple):
    """All that is asked for: spans by their names in ``SPANS``, and what else a row must keep.

    ``frame`` is a spec whose sizes, loads and limits every machine has.
    """

    words: str
    z: tuple[int, ...]
    gearings: tuple[str, ...] = GEARINGS
    rollers: int | None = None
    laws: tuple[str, ...] = ("modified-sine",)
    spans: dict[str, Span] = {}  # noqa: RUF012 - a NamedTuple's default, never changed
    acceleration_max: float | None = None
    frame: Spec | None = None
    sort: str = ""  # a quantity of a design; with a minus sign the greatest first
    bounds: tuple[Constraint, ...] = ()

    @property
    def timed(self) -> bool:
        """Whether seconds are asked for, or given with the frame."""
        return self.frame is not None or not {"cycle", "motion_s", "dwell_s"}.isdisjoint(self.spans)

    @property
    def only_acceleration(self) -> bool:
        """Whether a peak acceleration is all that is asked of the motion."""
        return self.acceleration_max is not None and self.asks_nothing(1)

    def cycle_s(self, m: int) -> Span:
        """The cycle times that are wished for; with a frame and no other wish its own."""
        if "cycle" in self.spans:
            return self.spans["cycle"]
        if self.frame is not None:
            own = 60.0 / (m * self.frame.drive.n_rpm)
            return Span(own, own)
        return ANY

    def demands(self, m: int) -> Iterator[tuple[str, Span]]:
        """What each wish asks of the motion angle of m rollers, with the words for it."""
        spans, turn, cycle = self.spans, 360.0 / m, self.cycle_s(m)
        said = {name: f"--{name.replace('_', '-')} {_typed(s)}" for name, s in spans.items()}
        beside = said.get("cycle", "the spec's n_rpm" if self.frame else "")
        if "motion_deg" in spans:
            yield said["motion_deg"], spans["motion_deg"]
        if "tau" in spans:
            low, high = spans["tau"]
            yield said["tau"], Span(360.0 * low / m, 360.0 * high / m)
        if "k" in spans:
            yield said["k"], Span(*(360.0 * _tau(k) / m for k in spans["k"]))
        if "dwell_deg" in spans:
            yield said["dwell_deg"], spans["dwell_deg"].mirrored(turn)
        if "motion_s" in spans and beside:
            yield f"{said['motion_s']} with {beside}", spans["motion_s"].over(cycle).times(turn)
        if "dwell_s" in spans and beside:
            share = spans["dwell_s"].over(cycle).times(turn)
            yield f"{said['dwell_s']} with {beside}", share.mirrored(turn)
        if "motion_s" in spans and "dwell_s" in spans:
            k = spans["motion_s"].over(spans["dwell_s"])
            words = f"{said['motion_s']} with {said['dwell_s']}"
            yield words, Span(*(turn * _tau(x) for x in k))

    def asks_nothing(self, m: int) -> bool:
        """Whether any motion angle will do."""
        return not any(s.low > 0.0 or s.high < 360.0 / m for _, s in self.demands(m))

    def motion_for(self, m: int) -> Span | None:
        """The motion angles that the wish leaves m rollers; None where it asks for none.

        It may be empty, or reach to 0 or to a whole turn over m, where nothing is left to move
        or to rest.
        """
        found = Span(0.0, 360.0 / m)
        if self.asks_nothing(m):
            return None
        for _, asked in self.demands(m):
            found = found.within(asked)
        return found

    def n_rpm(self, m: int, motion_deg: float) -> float:
        """The input speed, m cycles making a turn: the usual one, or the nearest that will do."""
        share = m * motion_deg / 360.0
        usual = self.frame.drive.n_rpm if self.frame else USUAL_RPM
        if not self.timed:
            return usual
        cycle = self.cycle_s(m)
        if not cycle.exact:
            if "motion_s" in self.spans:
                cycle = cycle.within(self.spans["motion_s"].times(1.0 / share))
            if "dwell_s" in self.spans:
                cycle = cycle.within(self.spans["dwell_s"].times(1.0 / (1.0 - share)))
        whole = min(max(60.0 / (m * usual), cycle.low), cycle.high)
        return usual if whole == 60.0 / (m * usual) else 60.0 / (m * whole)

    def refuse_contradictions(self, m: int) -> None:
        """Raise GenevaError for wishes that no machine of m rollers grants, alone or together."""
        asked = list(self.demands(m))
        for i, (one, first) in enumerate(asked):
            if first.high <= 0.0 or first.low * m >= 360.0:
                several = f" of {m} rollers" if m > 1 else ""
                raise GenevaError(
                    f"{one}: that leaves {_angles(first, m)}; a motion{several} must be above 0 "
                    f"and below {360.0 / m:.7g} deg (tau below 1)"
                )
            for other, second in asked[:i]:
                if first.within(second).empty:
                    raise GenevaError(
                        f"{other} and {one}: no machine does both; the first leaves "
                        f"{_angles(second, m)}, the second {_angles(first, m)}"
                    )


def _tau(k: float) -> float:
    return k / (1.0 + k) if k < math.inf else 1.0


def _typed(s: Span) -> str:
    ends = ("" if abs(x) == math.inf else f"{x:.7g}" for x in s)
    return f"{s.low:.7g}" if s.exact else "..".join(ends)


def _angles(s: Span, m: int) -> str:
    """What a wish leaves of the motion, for a message."""
    whole = 360.0 / m
    if s.high <= 0.0 or s.low >= whole:
        return "no time to move" if s.high <= 0.0 else "no dwell"
    return Span(s.low if s.low > 0.0 else -math.inf, s.high if s.high < whole else math.inf).words(
        "a motion of", " deg"
    )


def read_wish(
    *,
    tau: str = "",
    k: str = "",
    motion_deg: str = "",
    dwell_deg: str = "",
    motion_s: str = "",
    dwell_s: str = "",
    cycle: str = "",
    step: str = "",
    acceleration_max: str = "",
    z: str = "",
    internal: bool = False,
    external: bool = False,
    spherical: bool = False,
    rollers: int | None = None,
    law: str = "modified-sine",
    frame: Spec | None = None,
    sort: str = "",
    subject_to: Sequence[str] = (),
) -> Wish:
    """The wish that the command's options state, as text; an empty text is an option not given.

    Numbers may be fractions (``1/3``), and those of ``SPANS`` ranges (``0.8..``). Raises
    GenevaError, naming the option, for options that contradict each other and for values out of
    reach.
    """
    texts = {
        "tau": tau,
        "k": k,
        "motion_deg": motion_deg,
        "dwell_deg": dwell_deg,
        "motion_s": motion_s,
        "dwell_s": dwell_s,
        "cycle": cycle,
    }
    spans = {
        name: span(f"--{name.replace('_', '-')}", text, SPANS[name][0])
        for name, text in texts.items()
        if text
    }
    if not (spans or step or acceleration_max or subject_to or frame):
        raise GenevaError(
            "no wish; ask for --tau, --k, --motion-deg, --dwell-deg, --motion-s, --dwell-s, "
            "--cycle, --step, --acceleration-max or --subject-to, alone or together"
        )
    if rollers is not None and not 1 <= rollers <= Z_MAX:
        raise GenevaError(f"--rollers {cut(rollers)}: it must be at least 1, at most {Z_MAX}")
    said = [spans[name].words(*SPANS[name][1:]) for name in spans]
    said = [w if w[:2] == "a " else " = ".join(w.split(" ", 1)) for w in said]
    slots = _slots(z, frame)
    if step:
        degrees = number("--step", step, STEP)
        if not spans and frame is None:
            raise GenevaError(
                f"--step {cut(step)}: needs --cycle, the seconds from one step to the next, or "
                "another wish"
            )
        slots = _stepped(step, degrees, slots, bool(z))
        said = [f"a step of {degrees:.7g} deg", *said]
    most = number("--acceleration-max", acceleration_max, POSITIVE) if acceleration_max else None
    if most is not None:
        said.append(f"peak acceleration at most {most:.7g}")
    bounds = tuple(constraint(text) for text in subject_to)
    refuse_contradictions(bounds)
    said += [str(bound) for bound in bounds]
    words = ", ".join(said)
    chosen = dict(zip(GEARINGS, (external, internal, spherical), strict=True))
    wish = Wish(
        words if words.startswith(("tau", "k ")) else words[:1].upper() + words[1:],
        slots,
        tuple(g for g, asked in chosen.items() if asked) or GEARINGS,
        rollers,
        _laws(law),
        spans,
        most,
        frame,
        sort,
        bounds,
    )
    wish.refuse_contradictions(rollers or 1)
    return wish


def _slots(text: str, frame: Spec | None) -> tuple[int, ...]:
    if not text and frame is not None:
        return (frame.wheel.z,)
    z = parse_z(text or "3..24")
    if len(z) > WHEELS_MAX:
        raise GenevaError(f"--z {cut(text)}: that is more than {WHEELS_MAX} wheels; ask for fewer")
    return tuple(dict.fromkeys(z))


def _laws(name: str) -> tuple[str, ...]:
    if name == "all":
        return tuple(LAWS)
    if name not in LAWS:
        hint = nearest(name, (*LAWS, "all"))
        raise GenevaError(
            f'--law "{cut(name)}": unknown{hint}; it must be all or {", ".join(LAWS)}'
        )
    return (name,)


def _stepped(step: str, degrees: float, slots: tuple[int, ...], z_given: bool) -> tuple[int, ...]:
    """The number of slots of a step: z = 360/step."""
    z = round(360.0 / degrees)
    if abs(z * degrees - 360.0) > 360.0 * 1e-6:
        low, high = int(360.0 / degrees), int(360.0 / degrees) + 1
        raise GenevaError(
            f"--step {cut(step)}: 360 degrees are no whole number of such steps; near are "
            f"{360.0 / high:.7g} (z = {high}) and {360.0 / low:.7g} (z = {low})"
        )
    if z_given and z not in slots:
        raise GenevaError(f"--z: a step of {degrees:.7g} deg takes z = {z}; leave --z out")
    return (z,)
