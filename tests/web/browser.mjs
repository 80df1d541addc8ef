// Chromium without a screen, and a page whose every complaint is kept.

import { chromium } from "playwright-core";

/** Where the page is that is to be tested. */
export const url = variable("MUSLIN_URL");

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

// Chromium says this of any page that reads pixels back; it is about speed on one driver.
const HARMLESS = /GPU stall due to ReadPixels/;

/**
 * A page in a context of its own. `complaints` fills with all that goes wrong: errors and warnings
 * of the console, exceptions, requests that fail or leave `home`, reports of the policy.
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
      complaints.push(`leaves this machine: ${request.url()}`);
    }
  });
  await page.addInitScript(() => {
    addEventListener("securitypolicyviolation", (event) => {
      console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`);
    });
  });
  return { context, page, complaints };
}

/** Touches a page with as many fingers as there are places; real events, from outside the page. */
export async function fingers(page) {
  const session = await page.context().newCDPSession(page);
  return (type, ...places) => {
    const touchPoints = places.map(([x, y], id) => ({ x, y, id }));
    return session.send("Input.dispatchTouchEvent", { type, touchPoints });
  };
}
