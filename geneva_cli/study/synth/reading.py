"""A requirement read from the options of the command line, with contradictions refused."""

import math
from collections.abc import Sequence
from typing import Any

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.registry import STANDARD_LAWS as LAWS
from geneva_cli.spec.rules import POSITIVE, Range, range_text
from geneva_cli.study.survey import parse_z
from geneva_cli.study.sweep.constraints import constraint, objective, refuse_unsound
from geneva_cli.study.target import GEARINGS, ROLLERS_MAX, SPACE, AllowedSpan, Target

# The requirements for a number or a range: allowed values, and name and unit in words.
SPANS = {
    "tau": (Range(0.0, 1.0, "()"), "tau", ""),
    "motion_deg": (Range(0.0, 360.0, "()"), "a motion of", " deg"),
    "dwell_deg": (POSITIVE, "a dwell of", " deg"),
    "motion_s": (POSITIVE, "a motion of", " s"),
    "dwell_s": (POSITIVE, "a dwell of", " s"),
    "cycle": (Range(1e-6, 1e6), "a cycle of", " s"),
}


def read_target(frame: Spec | None = None, **typed: Any) -> Target:
    """Return the requirement of a frame and of the options of ``geneva synth``, by their names.

    ``typed`` are texts, but for ``subject_to``, ``rollers`` and the gearings, as the command has
    them; others of its options are not read. Those of ``SPANS`` are numbers, fractions (``1/3``) or
    ranges (``0.8..``); an empty one is not given.
    """
    z, law, sort, space = map(typed.get, ("z", "law", "sort", "space"))
    rollers, subject_to = typed.get("rollers"), typed.get("subject_to", ())
    spans = {
        name: span(f"--{name.replace('_', '-')}", typed[name], rule)
        for name, (rule, *_) in SPANS.items()
        if typed.get(name)
    }
    if not (spans or subject_to or frame):
        raise GenevaError(
            "no requirement; give one or more of --tau, --motion-deg, --dwell-deg, --motion-s, "
            "--dwell-s, --cycle and --subject-to"
        )
    phrases = [spans[name].words(*SPANS[name][1:]).replace("tau ", "tau = ", 1) for name in spans]
    bounds = tuple(constraint(text) for text in subject_to)
    options = dict.fromkeys([b.name for b in bounds], "--subject-to")
    refuse_unsound(bounds, options, "only numbers are bound")
    phrases += [str(bound) for bound in bounds]
    gearings = tuple(filter(typed.get, GEARINGS))
    if rollers is not None and not 1 <= rollers <= ROLLERS_MAX:
        raise GenevaError(f"--rollers {cut(rollers)}: it must be at least 1, at most {ROLLERS_MAX}")
    words = ", ".join(phrases) or "the spec alone"
    target = Target(
        words if words.startswith("tau") else words[:1].upper() + words[1:],
        _slots(z or "", frame),
        gearings or GEARINGS,
        rollers,
        _laws(law or "modified-sine"),
        spans,
        frame,
        objective(sort, "--sort") if sort else None,
        bounds,
        number("--space", space, Range(0.1, 100.0)) if space else SPACE,
    )
    loads = [name for name in target.names if name.startswith("loads.")]
    if loads and not (frame and frame.is_loaded):
        raise GenevaError(
            f"{loads[0]}: nothing resists the wheel, so no machine has a value of it; give a load "
            "with --from SPEC and its [load]"
        )
    target.refuse_contradictions()
    return target


def _slots(text: str, frame: Spec | None) -> tuple[int, ...]:
    """The numbers of slots: those of a text, or of the frame, or the usual ones."""
    if not text and frame is not None:
        return (frame.wheel.z,)
    z = parse_z(text or "3..24")
    most = 200  # each wheel takes some hundredths of a second
    if len(z) > most:
        raise GenevaError(f"--z {cut(text)}: that is more than {most} wheels; give fewer")
    return tuple(dict.fromkeys(z))


def _laws(name: str) -> tuple[str, ...]:
    """The law of this name, or all laws."""
    if name == "all" or name in LAWS:
        return tuple(LAWS) if name == "all" else (name,)
    hint = nearest(name, (*LAWS, "all"))
    raise GenevaError(f'--law "{cut(name)}": unknown{hint}; it must be all or {few(name, LAWS)}')


def read_frame(path: str, settings: Sequence[str] = ()) -> Spec:
    """Return the spec with whose sizes, loads and limits other machines are sought."""
    from geneva_cli.specfile.reader import read  # TOML, which a search without a spec does not need

    text = read(path, settings)
    spec = text.spec()
    with text.located():
        is_fixed = spec.drive.wheels_on_carrier or spec.wheel.stopped or not spec.output.turns
        if spec.drive_before or is_fixed:
            raise GenevaError(
                "--from: synth finds wheels that turn without end on axes that stand, with one "
                "drive; `geneva sweep --best` varies racks, carousels, wheels with a stop and "
                "[drive.before] too",
                ("drive", "before") if spec.drive_before else ("wheel", "gearing"),
            )
    return spec


def span(option: str, text: str, rule: Range) -> AllowedSpan:
    """Return the range in an option's text."""
    ends = range_text(text, f"{option} {cut(text)}")
    if not ends:
        x = number(option, text, rule)
        return AllowedSpan(x, x)
    low, high, step = ends
    if step or not (low or high):
        raise GenevaError(f"{option} {cut(text)}: a range is LOW..HIGH, LOW.. or ..HIGH")
    least = number(option, low, rule) if low else -math.inf
    most = number(option, high, rule) if high else math.inf
    if least > most:
        raise GenevaError(f"{option} {cut(text)}: the first number must not be above the second")
    return AllowedSpan(least, most)


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
