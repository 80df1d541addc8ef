// The code editor. It lives in a shadow root, where CodeMirror adds its style sheets as objects:
// the policy of the page allows no style elements.

import { javascript } from "@codemirror/lang-javascript";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { keymap } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { EditorView, basicSetup } from "codemirror";

const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "14px", color: "var(--play-text)", backgroundColor: "var(--play-code)" },
  "&.cm-focused": { outline: "2px solid var(--vp-c-brand-2)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: "var(--vp-font-family-mono)", fontVariantLigatures: "none", lineHeight: "1.6" },
  ".cm-gutters": { color: "var(--play-faint)", backgroundColor: "var(--play-code)", border: "0" },
  ".cm-content": { caretColor: "var(--play-text)", paddingBlock: "14px" },
  ".cm-cursor": { borderLeftColor: "var(--play-text)" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--play-line)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
    backgroundColor: "var(--play-selection)",
  },
  ".cm-tooltip": { color: "var(--play-text)", backgroundColor: "var(--vp-c-bg-elv)", border: "1px solid var(--vp-c-border)" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "#3346c4", color: "#fff" },
  ".cm-panels": { color: "var(--play-text)", backgroundColor: "var(--vp-c-bg-elv)" },
});

const colors = HighlightStyle.define([
  { tag: [tags.keyword, tags.operatorKeyword, tags.modifier], color: "var(--play-keyword)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--play-string)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--play-number)" },
  { tag: [tags.function(tags.variableName), tags.function(tags.propertyName), tags.className], color: "var(--play-function)" },
  { tag: tags.comment, color: "var(--play-faint)", fontStyle: "italic" },
]);

/** Makes an editor in `parent`. `onChange` gets the code after each change, `onRun` is called for Ctrl+Enter. */
export function makeEditor(parent, code, { onChange, onRun }) {
  const root = parent.attachShadow({ mode: "open" });
  const run = () => {
    onRun();
    return true;
  };
  const view = new EditorView({
    parent: root,
    root,
    doc: code,
    extensions: [
      keymap.of([{ key: "Mod-Enter", run }]),
      basicSetup,
      javascript(),
      lintGutter(),
      syntaxHighlighting(colors),
      theme,
      EditorView.contentAttributes.of({ "aria-label": "Code. Press Control and Enter to run it.", spellcheck: "false", tabindex: "0" }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) onChange(update.state.doc.toString());
      }),
    ],
  });
  return {
    setCode: (text) => view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } }),
    /** Marks the place of an error, or no place without one. */
    mark(error) {
      const diagnostics = [];
      if (error?.line >= 1 && error.line <= view.state.doc.lines) {
        const line = view.state.doc.line(error.line);
        const from = Math.min(line.from + Math.max((error.column ?? 1) - 1, 0), line.to);
        diagnostics.push({ from, to: line.to, severity: "error", message: error.message });
      }
      view.dispatch(setDiagnostics(view.state, diagnostics));
    },
    destroy: () => view.destroy(),
  };
}
