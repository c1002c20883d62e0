// Python, in a thread of its own: an endless loop stops this worker, not the page.

import { loadPyodide } from "../vendor/pyodide/pyodide.mjs";

const WHEELS = /\.(whl|zip)$/;
let python = null;
let classroom = null;
let session = null;

const tell = (message, transfer = []) => postMessage(message, transfer);

async function load({ base, archives, interruptBuffer }) {
  const output = (stream) => ({ batched: (text) => tell({ type: "log", stream, text }) });
  python = await loadPyodide({ indexURL: new URL("vendor/pyodide/", base).href });
  python.setStdout(output("out"));
  python.setStderr(output("error"));
  for (const path of archives) {
    const content = await (await fetch(new URL(path, base))).arrayBuffer();
    python.unpackArchive(content, WHEELS.exec(path)[1], { extractDir: "/lesson" });
  }
  python.runPython("import sys; sys.path.insert(0, '/lesson')");
  classroom = python.pyimport("turtle_lesson.classroom");
  if (interruptBuffer) python.setInterruptBuffer(interruptBuffer);
}

/** What the page may ask for; each returns the answer. */
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
    tell({ type: "answer", ...answer }, answer.frame ? [answer.frame] : []);
  } catch (error) {
    tell({ type: "failed", text: String(error.message ?? error) });
  }
};
