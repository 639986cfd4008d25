"""A requirement read from the options of the command line, with contradictions refused."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import KINDS
from geneva_cli.motion.registry import STANDARD_LAWS as LAWS
from geneva_cli.spec.rules import POSITIVE, Range, range_text
from geneva_cli.spec.schema import fields
from geneva_cli.study.survey import parse_z
from geneva_cli.study.sweep.constraints import (
    constraint,
    objective,
    refuse_contradictions,
    refuse_words,
)
from geneva_cli.study.target import GEARINGS, ROLLERS_MAX, SPACE, AllowedSpan, Target

# The requirements for a number or a range: allowed values, and name and unit in words.
SPANS = {
    "tau": (Range(0.0, 1.0, "()"), "tau", ""),
    "motion_deg": (Range(0.0, 360.0, "()"), "a motion of", " deg"),
    "dwell_deg": (POSITIVE, "a dwell of", " deg"),
    "motion_s": (POSITIVE, "a motion of", " s"),
    "dwell_s": (POSITIVE, "a dwell of", " s"),
    "cycle": (Range(1e-6, 1e6), "a cycle of", " s"),
    "index_mm": (POSITIVE, "a step of", " mm"),
}


def read_target(
    *,
    z: str = "",
    internal: bool = False,
    external: bool = False,
    spherical: bool = False,
    linear: bool = False,
    carousel: str = "",
    rollers: int | None = None,
    law: str = "modified-sine",
    frame: Spec | None = None,
    sort: str = "",
    subject_to: Sequence[str] = (),
    space: str = "",
    **wanted: str,
) -> Target:
    """Return the requirement that the options state as text; an empty text is an option not given.

    ``wanted`` are those of ``SPANS``: numbers, fractions (``1/3``) or ranges (``0.8..``).
    """
    spans = {
        name: span(f"--{name.replace('_', '-')}", wanted[name], rule)
        for name, (rule, *_) in SPANS.items()
        if wanted.get(name)
    }
    if not (spans or subject_to or frame):
        raise GenevaError(
            "no requirement; give one or more of --tau, --motion-deg, --dwell-deg, --motion-s, "
            "--dwell-s, --cycle, --index-mm and --subject-to"
        )
    phrases = [spans[name].words(*SPANS[name][1:]) for name in spans]
    phrases = [w if w[:2] == "a " else " = ".join(w.split(" ", 1)) for w in phrases]
    bounds = tuple(constraint(text) for text in subject_to)
    refuse_contradictions(bounds)
    refuse_words(dict.fromkeys([b.name for b in bounds], "--subject-to"), "only numbers are bound")
    phrases += [str(bound) for bound in bounds]
    chosen = dict(zip(GEARINGS, (external, internal, spherical), strict=True))
    requested = tuple(g for g, is_chosen in chosen.items() if is_chosen)
    wheels = _wheels(carousel, frame)
    racks = linear or "index_mm" in spans or (frame is not None and not frame.output.turns)
    gearings = _gearings(requested, racks, wheels, frame)
    words = ", ".join(phrases) or "the spec alone"
    target = Target(
        words if words.startswith(("tau", "k ")) else words[:1].upper() + words[1:],
        _slots(z or ("6" if racks and frame is None else ""), frame),
        gearings,
        _rollers(rollers, racks, frame),
        _laws(law),
        spans,
        frame,
        objective(sort, "--sort") if sort else None,
        bounds,
        number("--space", space, Range(0.1, 100.0)) if space else SPACE,
        wheels=wheels,
    )
    loads = [name for name in target.names if name.startswith("loads.")]
    if loads and not (target.frame and target.frame.is_loaded):
        raise GenevaError(
            f"{loads[0]}: nothing resists the wheel, so no machine has a value of it; give a load "
            "with --from SPEC and its [load]"
        )
    target.refuse_contradictions()
    return target


def read_frame(path: str, settings: Sequence[str] = ()) -> Spec:
    """Return the spec with whose sizes, loads and limits other machines are sought."""
    from geneva_cli.specfile.reader import read  # TOML, which a search without a spec does not need

    text = read(path, settings)
    spec = text.spec()
    with text.located():
        if spec.drive_before:
            raise GenevaError(
                "--from: synth finds the numbers of each drive by the input's angle, which "
                "[drive.before] would change: remove it; `geneva sweep --best` varies both drives",
                ("drive", "before"),
            )
    return spec


def _wheels(carousel: str, frame: Spec | None) -> tuple[int, ...]:
    own = frame.drive.wheels_on_carrier if frame else 0
    if not carousel:
        return (own,) if own else ()
    if frame and not own:
        raise GenevaError(
            f'--carousel: the spec has kind = "{frame.drive.NAME}": set kind = "carousel" in it'
        )
    low, high = span("--carousel", carousel, Range(1, 24))
    if not (low.is_integer() and high.is_integer()):
        raise GenevaError(f"--carousel {cut(carousel)}: write a number of wheels, or LOW..HIGH")
    return tuple(range(int(low), int(high) + 1))


def _gearings(
    chosen: tuple[str, ...], racks: bool, wheels: tuple[int, ...], frame: Spec | None
) -> tuple[str, ...]:
    """The gearings to try: racks alone, or wheels."""
    if racks and (chosen or wheels):
        other = f"--{chosen[0]}" if chosen else "--carousel"
        raise GenevaError(f"{other}: racks are searched alone: leave it out, or the rack")
    if racks and frame is not None and frame.output.turns:
        raise GenevaError(
            "--from: the spec has a wheel: leave out --linear and --index-mm, or take the spec of "
            "a rack"
        )
    if racks:
        return ("linear",)
    able: tuple[str, ...] = GEARINGS
    if wheels:
        able = tuple(g for kind in KINDS if "carrier" in kind.families for g in kind.gearings)
        if not able:
            raise GenevaError("--carousel: no drive with wheels on a carrier is installed")
    elif frame is not None and frame.wheel.stopped:
        able = tuple(
            g for g in GEARINGS if any(f.key == "stop" for f in fields(registry.gearing(g)))
        )
    wrong = next((name for name in chosen if name not in able), None)
    if wrong:
        what = "a carrier has" if wheels else "a stop needs"
        raise GenevaError(f"--{wrong}: {what} {' or '.join(able)} wheels")
    return chosen or able


def _rollers(rollers: int | None, racks: bool, frame: Spec | None) -> int | None:
    """The number of rollers: None for any, 1 for a frame that has a stop."""
    has_stop = frame is not None and frame.wheel.stopped
    if rollers is not None and not 1 <= rollers <= ROLLERS_MAX:
        raise GenevaError(f"--rollers {cut(rollers)}: it must be at least 1, at most {ROLLERS_MAX}")
    if rollers not in (None, 1) and (racks or has_stop):
        why = "a rack moves for half a turn, and" if racks else "the spec has a stop, which"
        raise GenevaError(f"--rollers {cut(rollers)}: {why} needs one roller")
    return 1 if has_stop else rollers


def _slots(text: str, frame: Spec | None) -> tuple[int, ...]:
    if not text and frame is not None:
        return (frame.wheel.z,)
    z = parse_z(text or "3..24")
    most = 200  # each wheel takes some hundredths of a second
    if len(z) > most:
        raise GenevaError(f"--z {cut(text)}: that is more than {most} wheels; give fewer")
    return tuple(dict.fromkeys(z))


def _laws(name: str) -> tuple[str, ...]:
    if name == "all" or name in LAWS:
        return tuple(LAWS) if name == "all" else (name,)
    hint = nearest(name, (*LAWS, "all"))
    raise GenevaError(f'--law "{cut(name)}": unknown{hint}; it must be all or {few(name, LAWS)}')


def span(option: str, text: str, rule: Range) -> AllowedSpan:
    """Return the range in an option's text."""
    ends = range_text(text, f"{option} {cut(text)}")
    if not ends:
        x = number(option, text, rule)
        return AllowedSpan(x, x)
    low, high, step = ends
    if step or not (low or high):
        raise GenevaError(f"{option} {cut(text)}: a range is LOW..HIGH, LOW.. or ..HIGH")
    interval = AllowedSpan(
        number(option, low, rule) if low else -math.inf,
        number(option, high, rule) if high else math.inf,
    )
    if interval.empty:
        raise GenevaError(f"{option} {cut(text)}: the first number must not be above the second")
    return interval


def number(option: str, text: str, rule: Range) -> float:
    """Return a number or a fraction of two."""
    above, slash, below = text.partition("/")
    try:
        x = float(above) / float(below) if slash else float(text)
    except (ValueError, ZeroDivisionError):
        raise GenevaError(
            f'{option} "{cut(text)}": not a number; write 0.25, 1/4, or a range 0.2..0.3'
        ) from None
    if x not in rule:
        raise GenevaError(f"{option} {cut(text)}: it must be {rule}")
    return x
