// Headless Chromium, and pages that record every problem.

import { chromium } from "playwright-core";

/** Address of the page under test. */
export const url = variable("MUSLIN_URL");

/** Returns an environment variable. Throws if it is not set. */
export function variable(name) {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set: run this through cargo xtask test`);
  return value;
}

export function launch() {
  return chromium.launch({
    executablePath: variable("MUSLIN_CHROMIUM"),
    headless: true,
    args: [
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

// Chromium logs this for any page that reads pixels; it is a remark about the speed of one driver.
const HARMLESS = /GPU stall due to ReadPixels/;

/**
 * Opens a page in a browser context of its own. `complaints` collects every problem: errors and
 * warnings of the console, exceptions, requests that fail or go elsewhere than `home`, violations
 * of the content security policy.
 */
export async function open(browser, options = {}, home = url) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !HARMLESS.test(message.text())) {
      complaints.push(`${message.type()}: ${message.text()}`);
    }
  });
  page.on("pageerror", (error) => complaints.push(`exception: ${error.stack ?? error}`));
  page.on("requestfailed", (request) => {
    complaints.push(`failed: ${request.url()} ${request.failure()?.errorText}`);
  });
  page.on("response", (response) => {
    if (response.status() >= 400) complaints.push(`${response.status()}: ${response.url()}`);
  });
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(home)) {
      complaints.push(`request to another host: ${request.url()}`);
    }
  });
  await page.addInitScript(() => {
    addEventListener("securitypolicyviolation", (event) => {
      console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`);
    });
  });
  return { context, page, complaints };
}

/**
 * Returns a function that dispatches a touch event with one finger per position. The events come
 * from outside the page, as real ones do.
 */
export async function fingers(page) {
  const session = await page.context().newCDPSession(page);
  return (type, ...positions) => {
    const touchPoints = positions.map(([x, y], id) => ({ x, y, id }));
    return session.send("Input.dispatchTouchEvent", { type, touchPoints });
  };
}

/**
 * Gives the page `threadTime()`, which returns a promise of the processor time that the thread of its
 * scripts has taken [ms]. Other processes on the machine hardly change it.
 */
export async function offerThreadTime(page) {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await page.exposeFunction("threadTime", async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "ThreadTime").value;
  });
}
