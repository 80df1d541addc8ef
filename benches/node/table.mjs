// A text table that is also valid Markdown.

export class Table {
  /**
   * Makes a table with text in the first columns and numbers in the others, from the heads of both.
   */
  constructor(texts, numbers) {
    this.textColumns = texts.length;
    this.rows = [[...texts, ...numbers]];
  }

  /** Appends a row, and prints it to stderr as progress: the table itself is printed at the end. */
  push(row) {
    console.error(`  ${row.join("  ")}`);
    this.rows.push(row);
  }

  toString() {
    const widths = this.rows[0].map((_, column) => Math.max(3, ...this.rows.map((row) => row[column].length)));
    const pad = (cell, column) =>
      column < this.textColumns ? cell.padEnd(widths[column]) : cell.padStart(widths[column]);
    const rule = widths.map((width, column) => "-".repeat(width - 1) + (column < this.textColumns ? "-" : ":"));
    const [head, ...rows] = this.rows.map((row) => row.map(pad));
    return [head, rule, ...rows].map((row) => `| ${row.join(" | ")} |\n`).join("");
  }
}

/** Formats a share as a percentage. */
export const formatPercent = (share) => `${(100 * share).toFixed(3)} %`;

/** Formats a ratio. */
export const formatRatio = (ratio) => `${ratio.toFixed(1)} x`;
