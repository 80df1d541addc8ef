// Gives every page of the site its content security policy, in a `meta` element: a page may be
// served by any host, without a header.

import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { filesIn } from "./files.mjs";

/** The policy without the sources of scripts. Elements may have styles of their own, such as those of highlighted code. */
const POLICY = {
  "default-src": "'none'",
  "style-src": "'self' 'unsafe-inline'",
  "style-src-elem": "'self'",
  "style-src-attr": "'unsafe-inline'",
  "img-src": "'self' data:",
  "font-src": "'self'",
  "connect-src": "'self'",
  "worker-src": "'self'",
  "frame-src": "'self'",
  "base-uri": "'self'",
  "form-action": "'self'",
};

/** Adds the policy to each page below `dir` that does not bring its own. */
export async function addPolicies(dir) {
  for (const path of (await filesIn(dir)).filter((file) => file.endsWith(".html"))) {
    const page = await readFile(path, "utf8");
    if (page.includes('http-equiv="Content-Security-Policy"')) continue;
    const start = page.match(/<head>(\s*<meta charset="[^"]*"\s*\/?>)?/);
    if (!start) throw new Error(`${path} has no head`);
    const meta = `<meta http-equiv="Content-Security-Policy" content="${policyFor(page)}">`;
    await writeFile(path, page.replace(start[0], () => start[0] + meta));
  }
}

/** The policy of a page: its own scripts, and those inline ones that it has now. */
export function policyFor(page, changes = {}) {
  const hashes = inlineScripts(page).map((text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`);
  const scripts = ["'self'", changes.scripts, ...new Set(hashes)].filter(Boolean).join(" ");
  const parts = { ...POLICY, "script-src": scripts, ...changes.parts };
  return Object.entries(parts).map(([name, sources]) => `${name} ${sources}`).join("; ");
}

/** The texts of the scripts in a page that a browser would run without loading a file. */
function inlineScripts(page) {
  const scripts = [...page.matchAll(/<script\b([^>]*)>([^]*?)<\/script>/g)];
  return scripts.filter(([, attributes, text]) =>
    text && !/\bsrc=/.test(attributes) && !/type="(application\/json|text\/json)"/.test(attributes)).map(([, , text]) => text);
}
