"""Some cases of each large family in `make test`, all of them in `make stress`.

GENEVA_STRESS=1 makes a run take all cases. Otherwise there are two ways to take fewer:

- ``@pytest.mark.sampled(k)`` runs one of k cases of a parametrised test, at least one. The choice
  is the same on every machine. Tests of one file that have the same cases take the same ones, so
  that they share designs; each file chooses for itself, so that together they try all designs.
- ``some(whole, few)`` are the cases of a loop, or how many: of hypothesis examples, say.

``@pytest.mark.long`` leaves a test of a second or more to `make stress`, if quicker tests prove the
same for simpler machines.
"""

import os
import zlib
from collections import defaultdict

WHOLE = bool(os.environ.get("GENEVA_STRESS"))


def some(whole, few):
    """The cases, or their number: ``whole`` in `make stress`, ``few`` in `make test`."""
    return whole if WHOLE else few


def left_out(items):
    """The set of collected tests that their mark ``sampled`` leaves out of this run."""
    families = defaultdict(list)
    for item in items:
        mark = item.get_closest_marker("sampled")
        if mark and not WHOLE:
            families[item.parent.nodeid, item.originalname, *mark.args].append(item)
    out = {item for item in items if item.get_closest_marker("long")} if not WHOLE else set()
    for (file, _, k), family in families.items():
        family.sort(key=lambda item: _lot(file, item))
        out.update(family[-(-len(family) // k) :])
    return out


def _lot(file, item):
    """A number drawn for a case of a file, and its name where two have the same."""
    case = item.name.removeprefix(item.originalname)
    return zlib.crc32(f"{file}{case}".encode()), case
