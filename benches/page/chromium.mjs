// Runs a page of benchmarks in Chromium and returns its `window.result`.

import { chromium } from "../../tests/node_modules/playwright-core/index.mjs";

/** Opens the page and waits for its result. `log` gets its console messages and errors. */
export async function runPage(url, log) {
  const browser = await chromium.launch({ executablePath: process.env.MUSLIN_CHROMIUM, headless: true });
  try {
    const page = await browser.newPage();
    page.on("console", (message) => log(message.text()));
    page.on("pageerror", (error) => log(`${error.stack}`));
    await page.goto(url);
    await page.waitForFunction(() => window.result, null, { timeout: 0 });
    const result = await page.evaluate(() => window.result);
    if (result.error) throw new Error(result.error);
    return { ...result, where: `Chromium ${browser.version()}` };
  } finally {
    await browser.close();
  }
}
