// A table that reads well as it is and as Markdown.

export class Table {
  /** Words in the first columns, numbers in the others. */
  constructor(words, numbers) {
    this.words = words.length;
    this.rows = [[...words, ...numbers]];
  }

  /** Adds a row and says to the terminal that it is there, as the table itself comes late. */
  push(row) {
    console.error(`  ${row.join("  ")}`);
    this.rows.push(row);
  }

  toString() {
    const widths = this.rows[0].map((_, at) => Math.max(3, ...this.rows.map((row) => row[at].length)));
    const pad = (cell, at) => (at < this.words ? cell.padEnd(widths[at]) : cell.padStart(widths[at]));
    const rule = widths.map((width, at) => "-".repeat(width - 1) + (at < this.words ? "-" : ":"));
    const [head, ...rows] = this.rows.map((row) => row.map(pad));
    return [head, rule, ...rows].map((row) => `| ${row.join(" | ")} |\n`).join("");
  }
}

/** A share as a percentage. */
export const percent = (share) => `${(100 * share).toFixed(3)} %`;

/** A ratio. */
export const times = (ratio) => `${ratio.toFixed(1)} x`;
