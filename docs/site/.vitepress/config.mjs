// The configuration of VitePress. `build/build.mjs` writes `generated.json` before it starts.

import { readFileSync } from "node:fs";
import { defineConfig } from "vitepress";

const { sidebars, base } = JSON.parse(readFileSync(new URL("../generated.json", import.meta.url), "utf8"));

const apiSidebar = [
  { text: "API", items: [{ text: "All languages", link: "/api/" }, { text: "Rust", link: "/api/rust/muslin/index.html", target: "_self" }] },
  { text: "C", items: sidebars.c },
  {
    text: "Python",
    items: [
      { text: "Overview", link: "/api/python/" },
      { text: "Cloth", link: "/api/python/cloth" },
      { text: "Classes", link: "/api/python/classes" },
      { text: "Functions and names", link: "/api/python/names" },
    ],
  },
  { text: "JavaScript", items: [{ text: "Modules", link: "/api/javascript/" }, ...sidebars.js] },
];

/** The names of tabs with code. In the fence itself rustdoc would not take the block for Rust. */
const TABS = { js: "JavaScript", rust: "Rust", c: "C", py: "Python" };

/** Adds the name of its language to each block of code that is a tab. */
function nameTabs({ tokens }) {
  let isTab = false;
  for (const token of tokens) {
    if (token.type.startsWith("container_code-group")) isTab = token.type.endsWith("open");
    else if (isTab && token.type === "fence") token.info += ` [${TABS[token.info]}]`;
  }
}

const icon =
  "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 32 32'%3E%3Crect width='32' height='32' rx='8' fill='%230b1020'/%3E%3Cpath d='M6 7h20v15c-3 4-5 0-7 2s-4 3-6 0-4 1-7-2z' fill='%239fb6ff'/%3E%3Cpath d='M13 7c2 6-2 10 0 17M20 7c-2 6 2 9-1 17' fill='none' stroke='%23c0c8ff' stroke-width='2'/%3E%3C/svg%3E";

export default defineConfig({
  title: "Muslin",
  titleTemplate: ":title · Muslin",
  description: "Cloth simulation for games, engines and web pages, in Rust, C, JavaScript and Python.",
  lang: "en",
  cleanUrls: false,
  metaChunk: true,
  // The switch between light and dark would add a style element, which the policy of pages refuses.
  appearance: { disableTransition: false },
  srcExclude: ["README.md", "build/**", "play/**"],
  head: [["link", { rel: "icon", href: icon }], ["meta", { name: "color-scheme", content: "light dark" }]],
  markdown: {
    theme: { light: "github-light-high-contrast", dark: "github-dark" },
    languageAlias: { sh: "bash" },
    config: (md) => md.core.ruler.push("tab names", nameTabs),
  },
  vite: {
    // The policy of pages allows no font in the style sheet itself.
    build: { chunkSizeWarningLimit: 4096, assetsInlineLimit: 0 },
    logLevel: "warn",
  },
  themeConfig: {
    siteTitle: "Muslin",
    nav: [
      { text: "Manual", link: "/manual/", activeMatch: "^/(manual|changelog|source)" },
      { text: "API", link: "/api/", activeMatch: "^/api/" },
      { text: "Playground", link: "/playground" },
      { text: "Benchmarks", link: "/benchmarks" },
    ],
    sidebar: { "/api/": apiSidebar, "/manual/": sidebars.manual, "/changelog": sidebars.manual, "/source/": sidebars.manual },
    outline: { level: [2, 3] },
    search: { provider: "local" },
    docFooter: { prev: "Previous", next: "Next" },
  },
  base,
  // Pages that VitePress does not make, such as those of rustdoc, are checked by the site's test.
  ignoreDeadLinks: [/\/api\/rust\//, /\/demo\//],
});
