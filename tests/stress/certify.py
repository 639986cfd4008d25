"""Certify every peak and load of all designs, then of a thousand random machines of each kind.

`python tests/stress/certify.py --runs 10500`. A peak that its certificate does not confirm is a
bug. One that is `not proved` is counted: its peak may be narrower than balls can enclose.
"""

import sys

import repo
from fuzz_machines import machine_text
from fuzz_spec import read
from fuzzing import campaign, in_time

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.extras.certify.certificate import certificate
from geneva_cli.extras.certify.certified_loads import LOADS, not_proved
from geneva_cli.loads.cycle import greatest
from geneva_cli.motion.peaks import QUANTITIES, worst
from geneva_cli.motion.registry import DRIVES

SECONDS = 60  # of one machine; most take 0.1 s, and 2,000 intervals of a four-bar's four peaks 12 s
NEAR = 1e-6  # of a peak: how far the bounds of decimals and doubles may be apart, by rounding
# Of a load: behind the most uneven gears the last digit of the input angle is 4e-10 of the wheel's
# step.
LOST = 1e-9
TRIES = 100  # for a machine of a kind; two of three texts are refused, of epicyclic gears most


def confirmed(mechanism):
    """Return "proved", or the number of peaks without a proof; raise for a wrong peak."""
    peaks, open_ = worst(mechanism), 0
    for quantity in QUANTITIES:
        # about doubles: extreme proportions magnify the rounding of a decimal
        proof = certificate(mechanism, quantity, decimals=False)
        peak = getattr(peaks, quantity)
        if proof.proved:
            assert proof.confirms(*peak), f"{peak} against {proof.text} {proof.places}"
        open_ += not proof.proved
        decimals = certificate(mechanism, quantity)
        if decimals.proved:
            below = proof.low <= decimals.high * (1.0 + NEAR)
            above = not proof.proved or decimals.low <= proof.high * (1.0 + NEAR)
            assert below and above, f"{decimals.text} against {proof.text}"
    for name in LOADS:
        if not_proved(mechanism, name):
            continue
        try:
            peak = greatest(mechanism, name)
        except GenevaError:
            break  # a motion that is too uneven has no loads
        proof = certificate(mechanism, name)
        if proof.proved:
            near = proof.low * (1.0 - LOST) <= peak.max <= proof.high * (1.0 + LOST)
            assert near, f"{name}: {peak} against {proof.text} {proof.places}"
        open_ += not proof.proved
    return f"{open_} not proved" if open_ else "proved"


def text_of(rng):
    """The text of a machine of a random kind; the last one tried if all are refused."""
    kind = rng.choice(list(DRIVES))
    texts = (machine_text(rng, kind) for _ in range(TRIES))
    for text in texts:
        if not isinstance(read(text.encode()), str):
            break
    return text


def one(text):
    """Return a machine's kind and the result of its certificates."""
    with in_time(SECONDS):
        machine = read(text.encode())
        if isinstance(machine, str):
            return "refused"
        return f"{machine.spec.drive.NAME} {confirmed(machine)}"


if __name__ == "__main__":
    for path in sorted(repo.DESIGNS.glob("*.toml")):
        mechanism = load(str(path)).mechanism
        end = confirmed(mechanism)
        assert end == "proved", f"{path.name}: {end}"
    sys.exit(campaign("certificates", text_of, one, batch=50))
