// An orbit camera around the sheet: drag to orbit, wheel or pinch to zoom. It eases towards its
// target.

/** Range of the polar angle [rad]. */
const POLAR = [0.35, 1.9];
/** Range of the zoom factor. */
const ZOOM = [0.45, 2.2];

/** Share of the distance to the target that remains after a second. */
const REMAINDER = 1e-4;

const clamp = (x, [min, max]) => Math.min(Math.max(x, min), max);

export class Orbit {
  azimuth = 0.3;
  polar = 1.5;
  zoom = 1;
  #now = { azimuth: 0.3, polar: 1.5, zoom: 1 };
  #fingers = new Map();

  constructor(camera) {
    this.camera = camera;
  }

  /**
   * Fits a sheet of 2 m into a picture of `width` × `height` pixels, of which the panel covers
   * `left` pixels on the left and `below` at the bottom.
   */
  fit(width, height, [left, below] = [0, 0]) {
    const { camera } = this;
    camera.aspect = width / height;
    const tangent = Math.tan((camera.fov * Math.PI) / 360);
    const tall = 1.42 / (tangent * (1 - below / height));
    const wide = 1.45 / (tangent * camera.aspect * (1 - left / width));
    this.distance = Math.max(tall, wide);
    camera.setViewOffset(width, height, -left / 2, below / 2, width, height);
    camera.updateProjectionMatrix();
  }

  press(id, x, y) {
    this.#fingers.set(id, [x, y]);
  }

  drag(id, x, y) {
    const last = this.#fingers.get(id);
    if (!last) return;
    const distance = () => {
      const [a, b] = [...this.#fingers.values()];
      return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };
    if (this.#fingers.size === 2) {
      const before = distance();
      this.#fingers.set(id, [x, y]);
      this.turn(0, 0, before / Math.max(distance(), 1));
      return;
    }
    this.#fingers.set(id, [x, y]);
    this.turn(x - last[0], y - last[1], 1);
  }

  lift(id) {
    this.#fingers.delete(id);
  }

  turn(x, y, zoom) {
    this.azimuth -= 0.006 * x;
    this.polar = clamp(this.polar - 0.006 * y, POLAR);
    this.zoom = clamp(this.zoom * zoom, ZOOM);
  }

  update(seconds) {
    const share = 1 - REMAINDER ** seconds;
    for (const name of ["azimuth", "polar", "zoom"]) this.#now[name] += share * (this[name] - this.#now[name]);
    const { azimuth, polar, zoom } = this.#now;
    const radius = zoom * this.distance;
    const horizontal = radius * Math.sin(polar);
    this.camera.position.set(horizontal * Math.sin(azimuth), radius * Math.cos(polar) - 0.1, horizontal * Math.cos(azimuth));
    this.camera.lookAt(0, -0.1, 0);
  }
}
