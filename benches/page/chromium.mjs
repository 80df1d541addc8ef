// Plays a page of benchmarks in Chromium and gives what it leaves in `window.result`.

import { chromium } from "../../tests/node_modules/playwright-core/index.mjs";

/** `say` hears of what the page tells its console, and of what goes wrong. */
export async function played(url, say) {
  const browser = await chromium.launch({ executablePath: process.env.MUSLIN_CHROMIUM, headless: true });
  try {
    const page = await browser.newPage();
    page.on("console", (message) => say(message.text()));
    page.on("pageerror", (error) => say(`${error.stack}`));
    await page.goto(url);
    await page.waitForFunction(() => window.result, null, { timeout: 0 });
    const result = await page.evaluate(() => window.result);
    if (result.error) throw new Error(result.error);
    return { ...result, where: `Chromium ${browser.version()}` };
  } finally {
    await browser.close();
  }
}
