"""A wish: what is asked of a machine that is not designed yet."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.machine.registry import STANDARD_LAWS as LAWS
from geneva_cli.spec.rules import POSITIVE, Z_MAX, Range
from geneva_cli.study.survey import parse_z

GEARINGS = ("external", "internal", "spherical")
WHEELS_MAX = 200  # numbers of slots in one call: each costs some hundredths of a second
CYCLE = Range(1e-6, 1e6)
STEP = Range(360.0 / Z_MAX, 120.0)
USUAL_RPM = 60.0
MARGIN = 1e-12  # share by which a machine stays below a limit, so that rounding does not break it


class Wish(NamedTuple):
    """Exactly one of ``tau``, ``motion_deg``, ``acceleration_max``; none: the natural motion."""

    words: str
    z: tuple[int, ...]
    gearings: tuple[str, ...] = GEARINGS
    rollers: int | None = None
    laws: tuple[str, ...] = ("modified-sine",)
    tau: float | None = None
    motion_deg: float | None = None
    acceleration_max: float | None = None
    cycle_s: float | None = None

    def motion_for(self, rollers: int) -> float | None:
        """The motion angle that the wish comes to with so many rollers: tau = m motion/360."""
        return self.motion_deg if self.tau is None else 360.0 * self.tau / rollers

    def n_rpm(self, rollers: int) -> float:
        """The input speed: m cycles make a turn."""
        return USUAL_RPM if self.cycle_s is None else 60.0 / (rollers * self.cycle_s)


def read_wish(
    *,
    tau: str = "",
    k: str = "",
    motion_deg: str = "",
    step: str = "",
    cycle: str = "",
    motion_s: str = "",
    acceleration_max: str = "",
    z: str = "",
    internal: bool = False,
    external: bool = False,
    spherical: bool = False,
    rollers: int | None = None,
    law: str = "modified-sine",
) -> Wish:
    """The wish that the command's options state, as text; an empty text is an option not given.

    Numbers may be fractions (``1/3``). Raises GenevaError, naming the option, for options that
    contradict each other and for values out of reach.
    """
    asked = {
        "--tau": tau,
        "--k": k,
        "--motion-deg": motion_deg,
        "--step": step,
        "--acceleration-max": acceleration_max,
    }
    given = [option for option, text in asked.items() if text]
    if len(given) != 1:
        said = f"{given[0]} with {given[1]}: choose one" if given else "no wish"
        raise GenevaError(f"{said}; a wish is exactly one of {', '.join(asked)}")
    if rollers is not None and not 1 <= rollers <= Z_MAX:
        raise GenevaError(f"--rollers {cut(rollers)}: it must be at least 1, at most {Z_MAX}")
    chosen = dict(zip(GEARINGS, (external, internal, spherical), strict=True))
    wish = Wish(
        "",
        _slots(z),
        tuple(g for g, asked in chosen.items() if asked) or GEARINGS,
        rollers,
        _laws(law),
        cycle_s=number("--cycle", cycle, CYCLE) if cycle else None,
    )
    if step:
        return _timed(wish, step, motion_s, bool(z))
    if motion_s:
        raise GenevaError(f"--motion-s {cut(motion_s)}: goes with --step and --cycle")
    if tau:
        x = number("--tau", tau, Range(0.0, 1.0, "()"))
        return wish._replace(words=f"tau = {x:.7g}", tau=x)
    if k:
        x = number("--k", k, Range(0.0, 1e6, "()"))
        return wish._replace(words=f"k = {x:.7g}", tau=x / (1.0 + x))
    if motion_deg:
        x = number("--motion-deg", motion_deg, Range(0.0, 360.0, "()"))
        return wish._replace(words=f"A motion of {x:.7g} deg", motion_deg=x)
    x = number("--acceleration-max", acceleration_max, POSITIVE)
    return wish._replace(words=f"Peak acceleration at most {x:.7g}", acceleration_max=x)


def number(option: str, text: str, rule: Range) -> float:
    """A number, or a fraction of two; GenevaError, naming the option, for anything else."""
    above, slash, below = text.partition("/")
    try:
        x = float(above) / float(below) if slash else float(text)
    except (ValueError, ZeroDivisionError):
        raise GenevaError(f'{option} "{cut(text)}": not a number; write 0.25 or 1/4') from None
    if x not in rule:
        raise GenevaError(f"{option} {cut(text)}: it must be {rule}")
    return x


def _slots(text: str) -> tuple[int, ...]:
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


def _timed(wish: Wish, step: str, motion_s: str, z_given: bool) -> Wish:
    """A step and a cycle time: z = 360/step, and the share of the cycle that is motion."""
    degrees = number("--step", step, STEP)
    whole = wish.cycle_s
    if whole is None:
        raise GenevaError(
            f"--step {cut(step)}: needs --cycle, the seconds from one step to the next"
        )
    z = round(360.0 / degrees)
    if abs(z * degrees - 360.0) > 360.0 * 1e-6:
        low, high = int(360.0 / degrees), int(360.0 / degrees) + 1
        raise GenevaError(
            f"--step {cut(step)}: 360 degrees are no whole number of such steps; near are "
            f"{360.0 / high:.7g} (z = {high}) and {360.0 / low:.7g} (z = {low})"
        )
    if z_given and z not in wish.z:
        raise GenevaError(f"--z: a step of {degrees:.7g} deg takes z = {z}; leave --z out")
    words = f"A step of {degrees:.7g} deg in a cycle of {whole:.7g} s"
    wish = wish._replace(z=(z,), words=words)
    if not motion_s:
        return wish
    seconds = number("--motion-s", motion_s, POSITIVE)
    if seconds >= whole:
        raise GenevaError(
            f"--motion-s {cut(motion_s)}: it must be above 0, below the cycle's {whole:.7g} s"
        )
    words += f", {seconds:.7g} s of it in motion"
    return wish._replace(words=words, tau=seconds / whole)
