"""Sources of a report's formulas, in short; `geneva explain` gives them value by value."""

from __future__ import annotations

from geneva_cli.machine.spec import Spec
from geneva_cli.manual.explained import entries


def sources(spec: Spec) -> tuple[str, ...]:
    """The sources of the machine's kinds and its law, and those that all share."""
    before = [spec.drive_before.NAME] if spec.drive_before else []
    laws = [spec.motion.law.NAME] if spec.motion else []
    names = [spec.wheel.NAME, spec.drive.NAME, *before, *laws]
    known = {n: e.source for e in entries() if e.group in ("kind", "law") for n in e.names}
    own = [f"{name[0].upper()}{name[1:]}: {known[name]}." for name in names if known.get(name)]
    return (
        *own,
        "Cited: Malteski mehanizmi, a lecture; handbook no. 7, Maltese mechanisms; F. Krasniqi, "
        "Improvements of kinetic properties and lifespan of Maltic cross through curved canal, "
        "University of Prishtina; Polyudov and Kandyak, Kinematics of the Maltese cross mechanism "
        "with a side-crank drive, Ukrainian Academy of Printing. Where our numbers differ, and "
        "why: geneva help numbers.",
        "Derivatives: Taylor coefficients that are carried along; peaks: roots of the next "
        "derivative.",
        "Contact stress: Hertz, line contact. Life of the roller: ISO 281. Shafts: the ASME code "
        "for transmission shafting (B17c). Pins and arm: beams, by von Mises. Keys: DIN 6892. "
        "Default steel: C45+N, EN 10083-2; of printed plates PLA, doi 10.1089/3dp.2020.0109.",
        "Formula and source of each value and check: geneva explain NAME.",
    )
