// The page: a spec on the left, the verdict below it, the machine on the right.
const get = (id) => document.getElementById(id);
const worker = new Worker("worker.js");
const waiting = new Map();
let count = 0;

worker.onmessage = ({ data: { number, answer, error } }) => {
  const { resolve, reject } = waiting.get(number);
  waiting.delete(number);
  error === undefined ? resolve(answer) : reject(new Error(error));
};

function ask(question, value) {
  count += 1;
  worker.postMessage({ number: count, question, value });
  return new Promise((resolve, reject) => waiting.set(count, { resolve, reject }));
}

function element(name, text, className) {
  const made = document.createElement(name);
  made.textContent = text;
  if (className) made.className = className;
  return made;
}

function showVerdict({ state, head, lines }) {
  const box = get("verdict");
  box.className = state;
  box.replaceChildren(element("p", head.replace("spec.toml: ", ""), "head"));
  for (const line of lines) {
    const row = element("p", "", line.state);
    row.append(element("b", line.label), ` ${line.text} `, element("span", line.note, "note"));
    box.append(row);
  }
}

let busy = false;
let again = false;

// Answers to the text as it is now. What is typed meanwhile is answered once, at the end.
async function update() {
  if (busy) {
    again = true;
    return;
  }
  busy = true;
  document.body.classList.add("busy");
  do {
    again = false;
    const text = get("spec").value;
    remember(text);
    try {
      const verdict = await ask("verdict", text);
      showVerdict(verdict);
      const works = verdict.state !== "error";
      for (const button of document.querySelectorAll("#files button")) button.disabled = !works;
      if (works && !again) await showMachine();
    } catch (error) {
      showVerdict({ state: "error", head: error.message, lines: [] });
    }
  } while (again);
  busy = false;
  document.body.classList.remove("busy");
}

async function showMachine() {
  try {
    get("machine").srcdoc = await ask("page");
  } catch (error) {
    get("machine").srcdoc = "";
    showVerdict({ state: "error", head: error.message, lines: [] });
  }
}

function remember(text) {
  try {
    localStorage.setItem("spec", text);
  } catch {
    // A browser that keeps nothing.
  }
}

function remembered() {
  try {
    return localStorage.getItem("spec");
  } catch {
    return null;
  }
}

async function save(name) {
  document.body.classList.add("busy");
  try {
    const bytes = await ask("file", name);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes]));
    link.download = name;
    link.click();
    URL.revokeObjectURL(link.href);
  } catch (error) {
    showVerdict({ state: "error", head: error.message, lines: [] });
  }
  if (!busy) document.body.classList.remove("busy");
}

async function choose(name) {
  get("spec").value = await ask("start", name);
  update();
}

async function begin() {
  const groups = await ask("templates");
  for (const [title, entries] of Object.entries(groups)) {
    const group = document.createElement("optgroup");
    group.label = title;
    for (const [name, about] of entries) {
      const option = element("option", `${name}: ${about}`);
      option.value = `${title}/${name}`;
      group.append(option);
    }
    get("start").append(group);
  }
  const text = remembered();
  if (text) get("spec").value = text;
  else get("spec").value = await ask("start", "Kinds/turret");
  get("spec").disabled = false;
  await update();
  document.body.dataset.ready = "true";
}

let typing;
get("spec").addEventListener("input", () => {
  clearTimeout(typing);
  typing = setTimeout(update, 300);
});
get("start").addEventListener("change", (event) => choose(event.target.value));
for (const button of document.querySelectorAll("#files button")) {
  button.addEventListener("click", () => save(button.dataset.file));
}
if ("serviceWorker" in navigator) navigator.serviceWorker.register("offline.js");
begin().catch((error) => showVerdict({ state: "error", head: error.message, lines: [] }));
