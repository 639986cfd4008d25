"""The manual: a page of Markdown a topic, beside this file and installed with it.

A new page is a file, and a line below.
"""

from __future__ import annotations

import os
import re

from geneva_cli.errors import GenevaError, cut, nearest

TOPICS = {
    "spec": "the file that describes a design, and what is said of a wrong one",
    "commands": "what peaks, report, motion and profile print",
    "symbols": "z, L, R, psi and the rest, and what the literature calls them",
    "family": "the machines, with a picture each",
    "laws": "motion laws for curved slots and cams",
    "curved-slots": "what curved slots can and cannot do",
    "cam-curve": "a Geneva is a cam curve: Am, Vm, Qm",
    "cycle": "forces, torques and power over the cycle: from a turret to its motor",
    "strength": "pins, horns, shafts, lock and slot: stresses and life",
    "vibration": "a load on an elastic shaft, and the law made for it",
    "tolerances": "place and play from the plus or minus of each dimension",
    "square-root": "what a wrong R/L costs: the square root of it",
    "checks": "whether the design works, and what would make it work",
    "parts": "what is cut: wheel, crank, arm, lists, solids; the full turn",
    "choosing": "from a wish to a machine; compare, sweep, the best of many",
    "plots": "curves over the cycle, and of a sweep",
    "python": "the same from Python",
    "accuracy": "what is promised, how it is tested, and run time against error",
    "numbers": "why our numbers differ from those that circulate",
    "house": "how the program is built, for who changes it",
}

_COMMENT = re.compile(r"<!--.*?-->\n*", re.DOTALL)
_PICTURE = re.compile(r"<img [^>]*>(<br>|\n)?")


def page(topic: str) -> str:
    """A topic's page as Markdown; without its pictures.

    Raises GenevaError where there is no such topic.

    >>> page("symbols").splitlines()[0]
    '# Symbols'
    """
    if topic not in TOPICS:
        raise GenevaError(
            f'"{cut(topic)}" is no page of the manual{nearest(topic, TOPICS)}; '
            "`geneva help` lists all"
        )
    with open(os.path.join(os.path.dirname(__file__), f"{topic}.md"), encoding="utf-8") as file:
        text = file.read()
    return _PICTURE.sub("", _COMMENT.sub("", text))
