// The editors: one for each file of the lesson, with errors marked at their line.

import { autocompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import {
  bracketMatching, foldGutter, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting,
} from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import {
  drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

// How long Tab leaves the editor after Escape; CodeMirror's own two seconds are short for some.
const LEAVE_MS = 10_000;

const colours = HighlightStyle.define([
  { tag: [tags.keyword, tags.operatorKeyword, tags.self], color: "var(--code-keyword)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--code-string)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--code-number)" },
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
  { tag: tags.definition(tags.variableName), color: "var(--code-name)" },
  { tag: [tags.function(tags.variableName), tags.className], color: "var(--code-function)" },
  { tag: tags.function(tags.definition(tags.variableName)), color: "var(--code-function)" },
]);

export class Editors {
  #tabs;
  #place;
  #views = new Map();
  #onChange;
  #onRun;

  /** `onChange(file, text)` after each edit, `onRun()` at Ctrl-Enter. */
  constructor(tabs, place, { onChange, onRun }) {
    this.#tabs = tabs;
    this.#place = place;
    this.#onChange = onChange;
    this.#onRun = onRun;
    // Arrow keys in the editor are for the editor, not for the turtle.
    place.addEventListener("keydown", (event) => event.stopPropagation());
  }

  /** Show other files: { name: text }. */
  open(files) {
    for (const { view } of this.#views.values()) view.destroy();
    this.#views.clear();
    this.#tabs.replaceChildren();
    this.#place.replaceChildren();
    for (const [name, text] of Object.entries(files)) this.#add(name, text);
    this.show(Object.keys(files)[0]);
  }

  /** The texts by file name. */
  get files() {
    const texts = [...this.#views].map(([name, { view }]) => [name, view.state.doc.toString()]);
    return Object.fromEntries(texts);
  }

  /** Bring a file to the front. */
  show(name) {
    for (const [other, { tab, panel }] of this.#views) {
      tab.setAttribute("aria-selected", String(other === name));
      tab.tabIndex = other === name ? 0 : -1;
      panel.hidden = other !== name;
    }
  }

  /** Mark an error at its line, with the hint below it, and bring the file to the front. */
  mark({ file, line, text, hint }) {
    const entry = this.#views.get(file);
    if (!entry || !line) return;
    const { view } = entry;
    const at = view.state.doc.line(Math.min(line, view.state.doc.lines));
    const from = at.from + at.text.search(/\S|$/);
    const message = hint ? `${text}\n${hint}` : text;
    const mark = { from, to: at.to, severity: "error", message };
    view.dispatch(setDiagnostics(view.state, [mark]));
    view.dispatch({ effects: EditorView.scrollIntoView(from, { y: "center" }) });
    entry.tab.dataset.mistake = "yes";
    this.show(file);
  }

  /** Remove all marks. */
  unmark() {
    for (const { view, tab } of this.#views.values()) {
      view.dispatch(setDiagnostics(view.state, []));
      delete tab.dataset.mistake;
    }
  }

  #add(name, text) {
    const panel = document.createElement("div");
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-label", name);
    const tab = document.createElement("button");
    tab.type = "button";
    tab.setAttribute("role", "tab");
    tab.textContent = name;
    tab.onclick = () => this.show(name);
    tab.onkeydown = (event) => this.#moveFocus(event, name);
    this.#tabs.append(tab);
    this.#place.append(panel);
    const state = EditorState.create({ doc: text, extensions: this.#extensions(name) });
    this.#views.set(name, { view: new EditorView({ state, parent: panel }), tab, panel });
  }

  #moveFocus(event, name) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.stopPropagation();
    const names = [...this.#views.keys()];
    const next = names[(names.indexOf(name) + step + names.length) % names.length];
    this.show(next);
    this.#views.get(next).tab.focus();
  }

  #extensions(name) {
    const run = { key: "Mod-Enter", run: () => (this.#onRun(), true) };
    const leave = { key: "Escape", run: (view) => (view.setTabFocusMode(LEAVE_MS), false) };
    return [
      lineNumbers(), foldGutter(), lintGutter(), history(), drawSelection(), bracketMatching(),
      indentOnInput(), highlightActiveLine(), autocompletion(), python(),
      indentUnit.of("    "), syntaxHighlighting(colours),
      EditorView.contentAttributes.of({
        "aria-label": `Source of ${name}`, "aria-describedby": "leave-editor", tabindex: "0",
      }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) this.#onChange(name, update.state.doc.toString());
      }),
      keymap.of([run, leave, indentWithTab, ...defaultKeymap, ...historyKeymap]),
    ];
  }
}
