"""The manual: a page of Markdown for each topic, in a folder for each kind of page.

A new page is a file, and a line below. ``cli.pages`` prints those of reference that have no file.
"""

from __future__ import annotations

import os
import re

from geneva_cli.errors import GenevaError, cut, nearest

# Pages of each kind (https://diataxis.fr): learning by doing, one task, facts, reasons.
GROUPS: dict[str, dict[str, str]] = {
    "Tutorial: learn by doing": {
        "first-turret": "ten minutes: a turret checked, drawn, cut and shown to the boss"
    },
    "How-to: one task each": {
        "dwell-time": "choose a machine for a dwell time",
        "compare-designs": "compare designs in one table",
        "reduce-acceleration": "reduce the acceleration",
        "reversal": "get rid of the reversal",
        "law-from-csv": "use a curve from a CSV",
        "size-motor": "size the motor and the flywheel",
        "shafts": "size pins, shafts and bearings",
        "stop-swinging": "stop the load from swinging; what the product feels",
        "find-tolerances": "find the tolerances that matter",
        "plots": "plot curves and show the machine moving",
        "write-report": "write a report",
        "drawing-sheet": "make a drawing with dimensions; a spherical wheel from sheet",
        "processes": "cut it with a laser, mill it, or print it",
        "drawn-elsewhere": "check a wheel from elsewhere: will a drawing turn?",
        "cad": "hand over a STEP to CAD; go on in build123d or FreeCAD",
        "hand-over": "hand over to a shop",
        "inches": "write values in inches and pounds",
        "electronic-cam": "replay the motion by a servo; Geneva, cam indexer or servo?",
        "sweep-front": "sweep a million designs and plot the front",
        "ci": "gate a CI job",
    },
    "Reference: look it up": {
        "commands": "every command: usage, arguments, options, examples",
        "spec": "the file that describes a design, and its errors",
        "keys": "every key of a spec: unit, range, default, meaning",
        "formats": "tables, csv, json, drawings; exit codes and messages",
        "quantities": "every field of json and column of csv",
        "checks": "what a design must pass, and how to repair it",
        "warnings": "what a number alone would hide, and how to repair it",
        "kinds": "the machines, with a picture each",
        "laws": "motion laws for curved slots and cams",
        "parts": "what is drawn and listed: wheel, crank, arm, links, frame",
        "choices": "what the program recommends, and how",
        "search": "what synth and sweep try, and their rules",
        "python": "classes and functions; a page for browsers",
    },
    "Explanation: why it is so": {
        "symbols": "frame, zero and sign; z, L, R, psi and the rest",
        "curved-slots": "why curved slots cannot do everything; Am, Vm, Qm of a cam curve",
        "cycle": "forces, torques and power over the cycle, from the load to the motor",
        "strength": "pins, horns, shafts, lock and slot: stresses and life",
        "vibration": "a load on an elastic shaft",
        "tolerances": "what errors of dimensions do to place, play and entry; R/L",
        "accuracy": "what is promised, tested and proved, of peaks and of the full turn; run time",
        "numbers": "compare with published tables, and why ours differ",
    },
}
TOPICS = {topic: about for pages in GROUPS.values() for topic, about in pages.items()}


def contents() -> str:
    """The list of all pages in Markdown, a heading for each kind.

    >>> contents().startswith("## ")
    True
    """
    lines = []
    for group, pages in GROUPS.items():
        own = [f"- {topic}: {about}" for topic, about in pages.items()]
        lines += [f"## {group}", "", *own, ""]
    return "\n".join(
        [*lines, "`geneva help TOPIC` shows a page; another word is searched for.", ""]
    )


def path(topic: str) -> str:
    """File of a topic's page, where it has one."""
    group = next(group for group, pages in GROUPS.items() if topic in pages)
    folder = group.partition(":")[0].lower().replace("-", "")
    return os.path.join(os.path.dirname(__file__), folder, f"{topic}.md")


def page(topic: str) -> str:
    """A topic's page as Markdown, from its file; without its pictures.

    Raises GenevaError where there is no such topic.

    >>> page("symbols").splitlines()[0]
    '# Symbols and conventions'
    """
    if topic not in TOPICS:
        raise GenevaError(
            f'"{cut(topic)}" is no page of the manual{nearest(topic, TOPICS)}; '
            "`geneva help` lists all"
        )
    with open(path(topic), encoding="utf-8") as file:
        text = file.read()
    return re.sub(r"<img [^>]*>(<br>|\n)?", "", text)
