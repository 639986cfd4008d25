// Python in a worker of its own, so that the page answers while it computes.
importScripts("pyodide.js");

let bridge;

async function begin() {
  const python = await loadPyodide({ indexURL: "./" });
  for (const archive of ["numpy.zip", "packages.zip"]) {
    const response = await fetch(archive);
    if (!response.ok) throw new Error(`${archive}: ${response.status}`);
    python.unpackArchive(await response.arrayBuffer(), "zip", {
      extractDir: "/lib/python3.11/site-packages",
    });
  }
  bridge = python.pyimport("bridge");
}

// The text of an error without Python's traceback: errors of a spec are one line.
function lastLine(error) {
  return String(error.message ?? error).trim().split("\n").pop().replace(/^[\w.]*Error: /, "");
}

const ANSWERS = {
  templates: () => JSON.parse(bridge.templates()),
  start: (name) => bridge.start(...name.split("/")),
  verdict: (text) => JSON.parse(bridge.verdict_of(text)),
  page: () => bridge.page(),
  file: (name) => {
    const bytes = bridge.file_of(name);
    const copy = bytes.toJs();
    bytes.destroy();
    return copy;
  },
};

const ready = begin();

onmessage = async ({ data: { number, question, value } }) => {
  try {
    await ready;
    postMessage({ number, answer: ANSWERS[question](value) });
  } catch (error) {
    postMessage({ number, error: lastLine(error) });
  }
};
