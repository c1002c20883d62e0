// Python, in its own thread: an endless loop stops this worker, not the page. It is a classic
// script, because Chromium starts no module as a worker where the page was opened as a file.

// Pyodide takes this function for the sign of a worker that cannot import modules; ours can.
globalThis.importScripts = undefined;

const ARCHIVES = /^python\/.*\.(whl|zip)$/;
const MOST_LINES = 300; // as many as the page shows
const LOG_MS = 50;
const FULL_BYTES = 1.5e9; // the memory of WebAssembly never shrinks, and programs need 0.1 GB
let python = null;
let classroom = null;
let session = null;
let lines = []; // printed, and not sent to the page yet
let told = 0; // when the last lines were told

const tell = (message, transfer = []) => postMessage(message, transfer);

/** Send printed lines to the page in groups: a loop prints faster than a page can handle. */
function log(line) {
  lines.push(line);
  if (lines.length >= 2 * MOST_LINES) lines = lines.slice(-MOST_LINES);
  if (performance.now() - told > LOG_MS) tellLines();
}

function tellLines() {
  if (lines.length) tell({ type: "log", lines });
  lines = [];
  told = performance.now();
}

/** Load Pyodide and our Python code; `files`: the address, or the blob, of each by its path. */
async function load({ files, interruptBuffer }) {
  const addressOf = (path) =>
    files[path] instanceof Blob ? URL.createObjectURL(files[path]) : files[path];
  const pyodide = (name) => addressOf(`vendor/pyodide/${name}`);
  tell({ type: "stage", name: "python", text: "starting Python …" });
  const { loadPyodide } = await import(pyodide("pyodide.mjs"));
  python = await loadPyodide({
    createPyodideModule: (await import(pyodide("pyodide.asm.mjs"))).default,
    lockFileURL: pyodide("pyodide-lock.json"),
    stdLibURL: pyodide("python_stdlib.zip"),
    // To this, Pyodide appends the name of the WebAssembly, which only lengthens the fragment.
    indexURL: `${pyodide("pyodide.asm.wasm")}#/`,
  });
  python.setStdout({ batched: log });
  python.setStderr({ batched: log });
  python.setStdin({ stdin: () => null }); // without a keyboard, the input is empty
  tell({ type: "stage", name: "turtlewire", text: "importing turtlewire …" });
  for (const path of Object.keys(files)) {
    const format = ARCHIVES.exec(path)?.[1];
    if (!format) continue;
    const content = await (await fetch(addressOf(path))).arrayBuffer();
    python.unpackArchive(content, format, { extractDir: "/lesson" });
  }
  python.runPython("import sys; sys.path.insert(0, '/lesson')");
  classroom = python.pyimport("turtle_lesson.classroom");
  if (interruptBuffer) python.setInterruptBuffer(interruptBuffer);
}

/** The requests that the page may send; each returns the answer. */
const requests = {
  async load(message) {
    await load(message);
    return { python: python.version };
  },

  start({ lesson, files, faults }) {
    session?.close();
    session?.destroy();
    session = classroom.open_session(lesson, JSON.stringify(files), JSON.stringify(faults));
    return { mistake: JSON.parse(session.mistake ?? "null") };
  },

  step({ ticks, wishes }) {
    const list = session.step(ticks, JSON.stringify(wishes));
    const texts = list.toJs();
    list.destroy();
    const proxy = session.frame();
    const frame = proxy.toJs().slice().buffer;
    proxy.destroy();
    const mistake = JSON.parse(session.mistake ?? "null");
    return { texts, frame, mistake };
  },

  examine() {
    session.examine();
    return {};
  },

  grade({ lesson, files }) {
    session?.close();
    const result = (text) => tell({ type: "result", result: JSON.parse(text) });
    classroom.grade(lesson, JSON.stringify(files), result, () => tell({ type: "alive" }));
    return {};
  },
};

onmessage = async ({ data }) => {
  try {
    const answer = await requests[data.type](data);
    tellLines();
    tell({ type: "answer", ...answer }, answer.frame ? [answer.frame] : []);
  } catch (error) {
    tellLines();
    const text = hasFullMemory() ? "out of memory" : String(error.message ?? error);
    tell({ type: "failed", text });
  }
};

/** With full memory, Python may end anywhere, and its error does not name the reason. */
function hasFullMemory() {
  return (python?._module.HEAPU8.length ?? 0) > FULL_BYTES;
}
