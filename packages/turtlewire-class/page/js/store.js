// What the browser remembers: the student's files, and which lessons are solved.

const KEY = "turtlewire-lesson";

function all() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {}; // no storage, or not ours: start again
  }
}

function keep(values) {
  try {
    localStorage.setItem(KEY, JSON.stringify(values));
  } catch {
    // A private window keeps nothing; the lesson works without.
  }
}

export const store = {
  /** The files of a lesson as the student left them; those of the lesson where there are none. */
  filesOf({ id, starter }) {
    return { ...starter, ...all().files?.[id] };
  },

  keepFile(lesson, name, text) {
    const values = all();
    const files = { ...values.files, [lesson]: { ...values.files?.[lesson], [name]: text } };
    keep({ ...values, files });
  },

  forgetFiles(lesson) {
    const values = all();
    delete values.files?.[lesson];
    keep(values);
  },

  isSolved(lesson) {
    return Boolean(all().solved?.includes(lesson));
  },

  keepSolved(lesson) {
    const values = all();
    keep({ ...values, solved: [...new Set([...(values.solved ?? []), lesson])] });
  },
};
