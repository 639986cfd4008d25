// Compiles the packages for the browser's own Python: node compile.mjs PYODIDE FOLDER OUTPUT.zip
//
// Sources would be compiled at each visit, which doubles the time to the first answer.
import path from "node:path";
import { pathToFileURL } from "node:url";

const [pyodide, folder, output] = process.argv.slice(2).map((place) => path.resolve(place));
const { loadPyodide } = await import(pathToFileURL(path.join(pyodide, "pyodide.mjs")));
const python = await loadPyodide({ indexURL: pyodide });
const disk = python.FS.filesystems.NODEFS;
for (const [at, root] of [["/in", folder], ["/out", path.dirname(output)]]) {
  python.FS.mkdir(at);
  python.FS.mount(disk, { root }, at);
}
python.globals.set("name", path.basename(output));
python.runPython(`
import os, py_compile, zipfile

def entries():
    for folder, folders, files in os.walk("/in"):
        folders.sort()
        for file in sorted(files):
            yield os.path.join(folder, file)

with zipfile.ZipFile(f"/out/{name}", "w", zipfile.ZIP_DEFLATED) as archive:
    for source in entries():
        place = os.path.relpath(source, "/in")
        if source.endswith(".py"):
            py_compile.compile(
                source, "/tmp/compiled", place, doraise=True,
                invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH,
            )
            source, place = "/tmp/compiled", place + "c"
        with open(source, "rb") as file:
            archive.writestr(zipfile.ZipInfo(place), file.read(), zipfile.ZIP_DEFLATED)
`);
