"""Design calculator for Geneva (Maltese-cross) mechanisms.

    from geneva_cli import load, Design, External, SideCrank

Each name is loaded at its first use. The examples in docstrings assume that these names are
imported.
"""

import importlib

__version__ = "1.0.0rc1"


def _rooms() -> dict[str, str]:
    """The module of each public name."""
    from geneva_cli.motion.registry import DRIVES, GEARINGS, LAWS
    from geneva_cli.spec.tables import PLAIN

    rooms = {"Design": "design", "load": "design", "GenevaError": "errors"}
    rooms |= dict.fromkeys(("Motion", "Spec"), "motion.machine_spec")
    rooms |= {table.__name__: "spec.tables" for table in PLAIN.values()}
    for path in (*GEARINGS.values(), *DRIVES.values(), *LAWS.values()):
        module, _, name = path.partition(":")
        rooms[name] = module
    return rooms


def __dir__() -> list[str]:
    return ["__version__", *sorted(_rooms())]


def __getattr__(name: str) -> object:
    if name == "__all__":
        return __dir__()
    rooms = _rooms()
    if name not in rooms:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = vars(importlib.import_module(f"{__name__}.{rooms[name]}"))[name]
    globals()[name] = value
    return value
