"""Build the page on which geneva runs in a browser: python .ci/web/build.py FOLDER.

The folder is static: any server of files shows it. Python is Pyodide, from npm. PyPI has no NumPy
for browsers yet; npm has one by emscripten-forge that fits the release of Pyodide named here.
"""

import hashlib
import json
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
# Packages of npm, with the checksum (SHA-256) of what was tried.
NPM = (
    ("pyodide@0.25.1", "d301c5b18b888ec7ad2bf616fcdd14eb36f4c9f41c513f89fcfcc3455d447a63"),
    (
        "@emscripten-forge/numpy@2.1.1-py311hc8e14bb-0",
        "822f06282c206a2d82dbcd9575f823d9051a8b8bb7e20f556e490c9b3f3da6a2",
    ),
)
PYODIDE = (
    "pyodide.js",
    "pyodide.asm.js",
    "pyodide.asm.wasm",
    "python_stdlib.zip",
    "pyodide-lock.json",
)
# What the library needs from PyPI; all are Python alone. SciPy, which there is not for browsers, is
# needed by tolerance, sweep and bench only, and there is no manifold3d, of meshes.
PURE = ("tomli", "ezdxf", "pyparsing", "typing_extensions", "fonttools")
PYTHON = "3.11"  # of this Pyodide
LEFT_OUT = re.compile(
    r"(^|/)(tests?|distutils|f2py|testing|include|__pycache__|bench)/|\.pyi$|_tests\."
)


def main(folder: str) -> None:
    """Build the page in a folder, which is made anew."""
    out = Path(folder).resolve()
    work = out.with_name(f"{out.name}-parts")
    for place in (out, work):
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
    pyodide, numpy = (_unpacked(name, digest, work) for name, digest in NPM)
    for name in PYODIDE:
        shutil.copy(pyodide / name, out)
    _add_backtrace(out / "pyodide.asm.js")
    inner = next((numpy / "pkg").glob("*.tar.gz"))
    packages = work / "packages"
    with tarfile.open(inner) as archive:
        archive.extractall(work / "numpy", filter="data")
    (found,) = (work / "numpy").glob("lib/python*/site-packages")
    _wheels(work, packages)
    shutil.copy(HERE / "bridge.py", packages)
    for source, name in ((found, "numpy.zip"), (packages, "packages.zip")):
        _leave_out(source)
        _run("node", HERE / "compile.mjs", pyodide, source, out / name)
    for name in ("index.html", "page.css", "page.js", "worker.js"):
        shutil.copy(HERE / name, out)
    files = sorted(file.name for file in out.iterdir())
    (out / "files.json").write_text(json.dumps(["./", *files]))
    whole = hashlib.sha256(b"".join((out / name).read_bytes() for name in files)).hexdigest()
    offline = (HERE / "offline.js").read_text().replace("VERSION", whole[:12])
    (out / "offline.js").write_text(offline)
    shutil.rmtree(work)
    size = sum(file.stat().st_size for file in out.iterdir()) / 1e6
    print(f"{folder}: {len(files) + 2} files, {size:.1f} MB")


def _unpacked(name: str, digest: str, work: Path) -> Path:
    """The folder of a package of npm, whose checksum must be the known one."""
    packed = subprocess.run(
        ["npm", "pack", "--silent", name], cwd=work, check=True, capture_output=True, text=True
    )
    file = work / packed.stdout.split()[-1]
    actual = hashlib.sha256(file.read_bytes()).hexdigest()
    if actual != digest:
        sys.exit(f"{name}: its checksum is {actual}, not {digest}")
    place = work / file.stem
    with tarfile.open(file) as archive:
        archive.extractall(place, filter="data")
    return place / "package"


def _add_backtrace(script: Path) -> None:
    """Give Pyodide the C function ``backtrace``, which this NumPy calls and Pyodide lacks.

    NumPy asks it for the callers of an operation on large arrays: where it names none, no temporary
    array is reused, and nothing else changes.
    """
    text = script.read_text()
    start = "var wasmImports={"
    if text.count(start) != 1:
        sys.exit(f"{script.name}: not the Pyodide that this page was made for")
    script.write_text(text.replace(start, f"{start}backtrace:()=>0,"))


def _wheels(work: Path, packages: Path) -> None:
    """Unpack our wheel and those of PURE."""
    wheels = work / "wheels"
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    _run(*pip, "wheel", "--no-deps", "-w", wheels, ROOT)
    any_machine = ("--platform", "any", "--implementation", "py", "--abi", "none")
    only = ("--no-deps", "--only-binary", ":all:", "--python-version", PYTHON, *any_machine)
    _run(*pip, "download", *only, "-d", wheels, *PURE)
    for wheel in wheels.glob("*.whl"):
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(packages)


def _leave_out(folder: Path) -> None:
    """Remove files that the page does not need."""
    for file in sorted(folder.rglob("*")):
        if file.is_file() and LEFT_OUT.search(file.relative_to(folder).as_posix()):
            file.unlink()


def _run(*words: object) -> None:
    subprocess.run([str(word) for word in words], check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
