// Draws the charts of the site with Observable Plot, from the tables of `docs/manual/performance.md`:
// the figures stand there and nowhere else.

import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import * as Plot from "@observablehq/plot";
import { parseHTML } from "linkedom";

const { document } = parseHTML("<html><body></body></html>");

/** Widths of a chart in pages of both kinds [px]. */
const [WIDE, NARROW] = [720, 340];
const BAR = 22;

/** Writes `charts.json` into `work`: each chart as two SVGs with a caption. */
export async function writeCharts(root, work) {
  const tables = tablesOf(await readFile(join(root, "docs/manual/performance.md"), "utf8"));
  const find = (...head) => {
    const found = tables.find((table) => head.every((name) => table.head.includes(name)));
    if (!found) throw new Error(`docs/manual/performance.md has no table with the columns ${head.join(", ")}`);
    return found.rows;
  };
  const engines = find("engine", "in Chromium", "in node", "largest strain");
  const isOwn = (name) => name.startsWith("Muslin");
  const frames = (sheet, column) => engines.filter((row) => row.sheet === sheet)
    .map((row) => ({ name: row.engine, value: number(row[column]), isOwn: isOwn(row.engine) }));
  const sheets = [...new Set(engines.map((row) => row.sheet))];
  const charts = {
    landing: bars(frames(sheets[0], "in node"), "ms", "Milliseconds a frame; shorter is better. Six sweeps are what the other engines run."),
    strain: bars(
      engines.filter((row) => row["largest strain"]).map((row) => ({ name: row.engine, value: number(row["largest strain"]), isOwn: isOwn(row.engine) })),
      "%", `Largest strain of an edge after 10 s, ${sheets[0]}, in Chromium. Cloth of rigid links should have none.`,
    ),
  };
  for (const sheet of sheets) {
    charts[`frames-${sheet.split(" ")[0]}`] = bars(frames(sheet, "in Chromium"), "ms", `${sheet} particles: milliseconds a frame in Chromium.`);
  }
  const ticks = find("sheet", "ms per tick", "plain loop", "in node");
  charts.native = bars(ticks.flatMap((row) => [
    { name: `Muslin: ${row.sheet}`, value: number(row["ms per tick"]), isOwn: true },
    { name: `plain loop: ${row.sheet}`, value: number(row["plain loop"]), isOwn: false },
  ]), "ms", "Milliseconds a tick, natively, on one thread; below each the loop that most people write, with as many sweeps.");
  const parts = find("part", "bytes", "brotli");
  charts.sizes = bars(
    parts.map((row) => ({ name: row.part.replaceAll("`", ""), value: number(row.brotli) / 1024, isOwn: true })),
    "KiB", "What a page loads of each part, compressed with brotli [KiB].",
  );
  await writeFile(join(work, "charts.json"), JSON.stringify(charts));
}

/** The tables of a page, each with the names of its columns and its rows as objects. */
function tablesOf(text) {
  return [...text.matchAll(/^\|.*\n\| *-.*\n(?:\|.*\n?)+/gm)].map(([table]) => {
    const [names, , ...lines] = table.trim().split("\n").map((line) => line.split("|").slice(1, -1).map((cell) => cell.trim()));
    // The first column of a name counts, where two have the same.
    const rows = lines.map((cells) => Object.fromEntries(names.map((name, at) => [name, cells[at]]).reverse()));
    return { head: names, rows };
  });
}

function number(text) {
  const value = Number(text.replace(/[,%]/g, "").trim());
  if (text.trim() === "" || !Number.isFinite(value)) throw new Error(`${text} in docs/manual/performance.md is not a number`);
  return value;
}

/** Bars with their names and values, drawn for both widths. */
function bars(data, unit, caption) {
  const label = ({ name, value }) => `${name}: ${shown(value)} ${unit}`;
  const draw = (width, size) => {
    const svg = Plot.plot({
      document, width, height: data.length * 2.3 * BAR + 4, margin: 0, marginRight: 0.2 * width,
      style: { fontSize: `${size}px` },
      ariaLabel: `Bar chart. ${data.map(label).join("; ")}`,
      x: { axis: null, domain: [0, Math.max(...data.map(({ value }) => value))] },
      y: { axis: null, domain: data.map(({ name }) => name), padding: 0.58 },
      marks: [
        Plot.barX(data, { x: "value", y: "name", fill: ({ isOwn }) => (isOwn ? "var(--chart-own)" : "var(--chart-other)"), rx2: 4, insetLeft: 0 }),
        Plot.text(data, { x: 0, y: "name", text: "name", textAnchor: "start", dy: -BAR * 0.96, fill: "var(--vp-c-text-1)" }),
        Plot.text(data, { x: "value", y: "name", text: ({ value }) => `${shown(value)} ${unit}`, textAnchor: "start", dx: 8, fill: "var(--vp-c-text-1)", fontWeight: 600 }),
      ],
      color: { type: "identity" },
    });
    svg.setAttribute("role", "img");
    for (const part of svg.querySelectorAll("[aria-label]")) part.removeAttribute("aria-label");
    // The style sheet of the site has what the chart needs of its own one, which the policy of pages refuses.
    svg.querySelector("style")?.remove();
    return svg.outerHTML;
  };
  return { wide: draw(WIDE, 15), narrow: draw(NARROW, 14), caption };
}

/** A value with three digits. */
function shown(value) {
  if (value === 0) return "0";
  return value >= 100 ? value.toFixed(0) : value >= 10 ? value.toFixed(1) : value.toFixed(2);
}
