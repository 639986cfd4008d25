"""Names of the strength checks that default sizes must pass; checks by name, at rest, advised."""

from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.advice import advised
from geneva_cli.verdict.checks import applicable, checks, own_checks

PARTS = (
    "pin_stress_MPa",
    "wheel_shaft_stress_MPa",
    "crank_shaft_stress_MPa",
    "arm_stress_MPa",
    "wheel_key_pressure_MPa",
    "crank_key_pressure_MPa",
)
HORNS = ("horn_stress_MPa", "lock_horn_stress_MPa")


def rows(spec):
    return {check.name: check for check in checks(build(spec), turned=False)}


def standing_checks(parts):
    return applicable(own_checks(parts.mechanism.spec)[1], parts)


def judged(mechanism, machine=None, parts=True):
    """Every check, those that fail with their advice."""
    return advised(mechanism, checks(mechanism, machine, parts))
