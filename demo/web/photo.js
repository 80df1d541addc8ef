// Photo mode of the page: hides panel and overlays, and saves a picture as PNG.

import { by } from "./canvas.js";

/**
 * Connects the bar of the photo mode. `changed()` is called when the bar ends the mode. Returns a
 * function that shows the mode that the demo is in.
 */
export function connectPhoto(demo, changed) {
  const [bar, save, leave, status] = ["photo", "photo-save", "photo-leave", "photo-status"].map(by);
  const show = () => {
    const on = demo.isPhoto();
    if (document.body.classList.toggle("photo", on) === !bar.hidden) return;
    bar.hidden = !on;
    status.textContent = "";
    if (on) {
      save.textContent = `Save ${demo.photoSize().join(" × ")}`;
      save.focus();
    } else {
      by("stage").focus({ focusVisible: false });
    }
  };
  const end = () => {
    if (!demo.isPhoto()) return;
    demo.setPhoto(false);
    show();
    changed();
  };
  save.addEventListener("click", async () => {
    save.disabled = true;
    status.textContent = "Saving";
    // The text is on the screen before the picture is drawn, which takes a while.
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    try {
      status.textContent = (await savePicture(demo)) ? "Saved" : "Not saved: there is no picture now";
    } catch (error) {
      status.textContent = `Not saved: ${error.message}`;
    }
    save.disabled = false;
  });
  leave.addEventListener("click", end);
  addEventListener("keydown", (event) => event.key === "Escape" && end());
  return show;
}

/** Draws a picture and hands it to the browser as a download; returns whether there is one. */
async function savePicture(demo) {
  const [width, height] = demo.photoSize();
  const bytes = demo.takePhoto();
  if (!bytes) return false;
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const pixels = new ImageData(new Uint8ClampedArray(bytes.buffer), width, height);
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  const file = await new Promise((done) => canvas.toBlob(done, "image/png"));
  if (!file) throw new Error("the browser cannot make a picture of this size");
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = `muslin-${JSON.parse(demo.settings()).scene}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  return true;
}
