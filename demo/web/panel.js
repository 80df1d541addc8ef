// Panel of the page: HTML controls, created from the demo's table of controls.

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function withTooltip(control, made) {
  made.title = `${control.about} (${control.key})`;
  return made;
}

/**
 * Fills `form` with one row per control. `get(name)` and `text(name)` read a value, `isEnabled(name)`
 * returns whether the control has an effect now, `set(name, value)` changes a value. Returns a
 * function that updates all rows.
 */
export function drawPanel(form, table, { get, text, isEnabled, set }) {
  const refreshers = [];
  for (const control of table) {
    const { row, refresh } = builders[control.kind](control, { get, text, set });
    form.append(withTooltip(control, row));
    if (refresh) refreshers.push(refresh);
    // Rows with several inputs, and buttons, can be disabled as a whole.
    if ("disabled" in row) refreshers.push(() => (row.disabled = !isEnabled(control.name)));
  }
  const refresh = () => refreshers.forEach((each) => each());
  refresh();
  return refresh;
}

const builders = {
  slider(control, { get, text, set }) {
    const id = `control-${control.name}`;
    const [min, max, step] = control.range;
    const chip = element("output", { className: "chip", htmlFor: id });
    const input = element("input", { type: "range", id, name: control.name, min, max, step });
    input.setAttribute("aria-keyshortcuts", control.key);
    input.addEventListener("input", () => set(control.name, input.valueAsNumber));
    const label = element("label", { className: "name", htmlFor: id }, control.label);
    const refresh = () => {
      const value = get(control.name);
      input.value = String(value);
      input.style.setProperty("--fill", `${(100 * (value - min)) / (max - min)}%`);
      chip.value = text(control.name);
      input.setAttribute("aria-valuetext", chip.value);
    };
    return { row: element("div", { className: "row" }, label, chip, input), refresh };
  },

  switch(control, { get, set }) {
    const id = `control-${control.name}`;
    const input = element("input", { type: "checkbox", id, name: control.name });
    input.setAttribute("role", "switch");
    input.setAttribute("aria-keyshortcuts", control.key);
    input.addEventListener("change", () => set(control.name, input.checked ? 1 : 0));
    const label = element("label", { className: "name", htmlFor: id }, control.label);
    const refresh = () => {
      input.checked = get(control.name) === 1;
    };
    return { row: element("div", { className: "row half" }, label, input), refresh };
  },

  choice(control, { get, set }) {
    const group = `choice-${control.name}`;
    const inputs = control.options.map((_, i) => {
      const id = `control-${control.name}-${i}`;
      const input = element("input", { type: "radio", id, name: group, value: String(i) });
      input.addEventListener("change", () => set(control.name, i));
      return input;
    });
    const segments = element("div", { className: "segments" });
    control.options.forEach((option, i) => {
      segments.append(element("label", {}, inputs[i], element("span", {}, option)));
    });
    const legend = element("legend", { className: "name" }, control.label);
    const refresh = () => {
      inputs[get(control.name)].checked = true;
    };
    const row = element("fieldset", { className: "row choice", id: `control-${control.name}` });
    row.append(legend, segments);
    return { row, refresh };
  },

  button(control, { set }) {
    const row = element("button", { type: "button", id: `control-${control.name}` }, control.label);
    row.setAttribute("aria-keyshortcuts", control.key);
    row.addEventListener("click", () => set(control.name, 1));
    return { row };
  },
};
