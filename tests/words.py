"""Specs for tests in the words of a file: kinds by their names, with their keys."""

import dataclasses
import os
from typing import NamedTuple

from geneva_cli import design
from geneva_cli.errors import GenevaError
from geneva_cli.motion import machine_spec as machine_spec
from geneva_cli.motion import registry
from geneva_cli.spec.schema import Points, fields
from geneva_cli.specfile.tree import read_pairs


def Wheel(z, gearing="external", **own):
    """A wheel by its gearing's name."""
    return registry.gearing(gearing)(z, **own)


class _Common(NamedTuple):
    kind: str
    common: dict


def Drive(kind="crank", n_rpm=60.0, rollers=1, roller_angles_deg=None):
    """A drive by its kind's name; ``Spec`` adds the keys of a kind that needs some."""
    common = {"n_rpm": n_rpm, "rollers": rollers, "roller_angles_deg": roller_angles_deg}
    try:
        return registry.drive(kind)(**common)
    except (TypeError, GenevaError):
        return _Common(kind, common)


def Keys(kind, *values, **named):
    """The keys that a kind of drive adds, in their order or by name."""
    common = {f.attribute for f in fields(registry.drive("crank"))}
    cls = registry.drive(kind)
    own = [f.attribute for f in fields(cls) if f.attribute not in common]
    own.sort(key=lambda name: name not in cls.__annotations__)  # a base's come last
    return dict(zip(own[: len(values)], values, strict=True)) | named


def law(name, *values, **own):
    """A law by its name, with its parameters in their order or by name."""
    cls = registry.law(name)
    keys = [f.attribute for f in fields(cls)][: len(values)]
    return cls(**dict(zip(keys, values, strict=True)), **own)


def points(path, cls, attribute):
    """The points in a CSV file, as the reader returns them."""
    field = next(f for f in fields(cls) if f.attribute == attribute)
    pairs = read_pairs(str(path), field.rule, (cls.TABLE, field.key))
    return Points(tuple(pairs), os.path.basename(str(path)))


def Motion(law=None, lambda_=None, *, alpha0_deg=0.0, ratio=None):
    """A motion by its law's name; None without a law, for straight slots."""
    if law is None:
        return None
    shape = {"lambda_": lambda_} if lambda_ else {}
    return machine_spec.Motion(registry.law(law)(**shape), alpha0_deg, ratio)


def Spec(wheel, drive=None, keys=None, motion=None, **rest):
    """A spec whose drive gets the keys of its kind."""
    drive = drive or Drive()
    if isinstance(drive, _Common):
        drive = registry.drive(drive.kind)(**drive.common, **(keys or {}))
    elif keys:
        drive = dataclasses.replace(drive, **keys)
    return machine_spec.Spec(wheel, drive, motion, **rest)


def load(path):
    """The machine that a spec file describes; its errors name the file and the line."""
    return design.load(str(path)).mechanism


def named(name, shape=0.0):
    """A motion law by its name; ``shape`` is the sine group's lambda."""
    return law(name, *[shape] if shape else [])


LAWS = registry.STANDARD_LAWS  # those without required parameters
