// File URLs, which fetch() does not read. In a file of its own, because it keeps its comments.

/** Returns the bytes of a file. The name is a variable so that bundlers for browsers do not look for it. */
export async function readFileUrl(url) {
  const name = "node:fs/promises";
  const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
  return readFile(new URL(url));
}
