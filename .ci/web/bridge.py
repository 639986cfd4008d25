"""The answers of the page: from the text of a spec to verdict, machine and files.

It calls what the commands of ``geneva`` call, and returns JSON that worker.js hands to the page.
"""

import io
import json
import os
import zipfile

from geneva_cli.design import Design, load
from geneva_cli.errors import GenevaError
from geneva_cli.output import animate, show_document
from geneva_cli.specfile import template as designs
from geneva_cli.specfile.template import KINDS, example, template
from geneva_cli.study.animation.turning_scene import scene
from geneva_cli.study.document import document
from geneva_cli.study.export import export_files, trade_of
from geneva_cli.study.verdicts import of_checks, verdict

SPEC = "spec.toml"

_last: dict[str, Design] = {}  # the design of the last text


def templates() -> str:
    """The specs to start from, by group: names, and what each is."""
    kinds = [(name, example(name).about) for name in KINDS]
    return json.dumps({"Kinds": kinds, "Designs": [*designs.titles().items()]})


def start(group: str, name: str) -> str:
    """The text of a kind's template or of a design, whose other files are written."""
    if group == "Kinds":  # a design may have the same name
        return template(name, False, False)
    text, files = designs.design(name)
    for file, content in files.items():
        with open(file, "w", encoding="utf-8") as opened:
            opened.write(content)
    return text


def verdict_of(text: str) -> str:
    """The verdict on a spec as JSON: state, headline and lines, or the error."""
    with open(SPEC, "w", encoding="utf-8") as file:
        file.write(text)
    _last.clear()
    try:
        _last[SPEC] = load(SPEC)
        judged = verdict(SPEC)
    except GenevaError as error:
        return _error(str(error))
    except ModuleNotFoundError as error:
        return _error(f"this design needs {error.name}, which a browser has not: use a terminal")
    if judged.error:
        return _error(judged.error)
    summary = of_checks([judged], False, False).summaries[0]
    return json.dumps(summary._asdict() | {"lines": [line._asdict() for line in summary.lines]})


def _error(text: str) -> str:
    return json.dumps({"state": "error", "head": text, "lines": []})


def page() -> str:
    """The page on which the machine turns. Raises GenevaError if there is none."""
    animate(scene(_last[SPEC]), "machine.html")
    with open("machine.html", encoding="utf-8") as file:
        return file.read()


def file_of(name: str) -> bytes:
    """The bytes of a file of the machine. Raises GenevaError if it cannot be made."""
    design = _last[SPEC]
    if name == "all.zip":
        return _all_files(design)
    if name == "report.html":
        show_document(document(design), name)
    else:
        design.save(name, part=name.partition(".")[0])
    with open(name, "rb") as file:
        return file.read()


def _all_files(design: Design) -> bytes:
    """The files of ``geneva export`` in an archive, without meshes: manifold3d is not here."""
    refused = "" if design.spec.no_parts else design.judge()[0]
    if refused:
        raise GenevaError(f"not written: {refused}")
    files, _ = export_files(design, trade_of(None))
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            if file.name.endswith((".stl", ".3mf")):
                continue
            file.write(file.name)
            with open(file.name, "rb") as opened:
                # A fixed time, so that the same design gives the same bytes.
                archive.writestr(zipfile.ZipInfo(file.name), opened.read(), zipfile.ZIP_DEFLATED)
            os.remove(file.name)
    return data.getvalue()
