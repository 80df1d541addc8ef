// A hand-written hanging sheet as many pages have it, written with care: flat typed arrays, Verlet
// integration, one list of distance constraints that is relaxed in order, and normals. It has
// structural, shear and bend links.

const GRAVITY = -9.81;
/** Share of the velocity that is lost per tick. */
const DAMPING = 0.012;
const SWEEPS = 6;

export class HandwrittenSheet {
  constructor(side, size) {
    const count = side * side;
    const spacing = size / (side - 1);
    this.side = side;
    this.limit = 0.5 * spacing;
    this.positions = new Float32Array(3 * count);
    this.previous = new Float32Array(3 * count);
    this.normals = new Float32Array(3 * count);
    this.weights = new Float32Array(count).fill(1);
    for (let row = 0; row < side; row++) {
      for (let column = 0; column < side; column++) {
        const at = 3 * (row * side + column);
        this.positions[at] = column * spacing - size / 2;
        this.positions[at + 1] = size / 2 - row * spacing;
      }
    }
    this.weights.fill(0, 0, side);
    this.previous.set(this.positions);
    this.#addLinks(spacing);
    this.#triangulate();
  }

  #addLinks(spacing) {
    const { side } = this;
    const [ends, rests] = [[], []];
    const addLink = (row, column, down, right) => {
      const [to, across] = [row + down, column + right];
      if (to >= side || across < 0 || across >= side) return;
      ends.push(row * side + column, to * side + across);
      rests.push(spacing * Math.hypot(down, right));
    };
    for (let row = 0; row < side; row++) {
      for (let column = 0; column < side; column++) {
        for (const [down, right] of [[0, 1], [1, 0], [1, 1], [1, -1], [0, 2], [2, 0]]) addLink(row, column, down, right);
      }
    }
    this.ends = Uint32Array.from(ends);
    this.rests = Float32Array.from(rests);
  }

  #triangulate() {
    const { side } = this;
    const indices = [];
    for (let row = 0; row + 1 < side; row++) {
      for (let column = 0; column + 1 < side; column++) {
        const a = row * side + column;
        indices.push(a, a + side, a + 1, a + 1, a + side, a + side + 1);
      }
    }
    this.indices = Uint32Array.from(indices);
  }

  tick(h) {
    this.#integrate(h);
    for (let sweep = 0; sweep < SWEEPS; sweep++) this.#relax();
    computeNormals(this.positions, this.indices, this.normals);
  }

  #integrate(h) {
    const { positions, previous, weights, limit } = this;
    const dampingFactor = 1 - DAMPING;
    const fall = GRAVITY * h * h;
    for (let i = 0, at = 0; i < weights.length; i++, at += 3) {
      if (weights[i] === 0) continue;
      const x = positions[at];
      const y = positions[at + 1];
      const z = positions[at + 2];
      let dx = (x - previous[at]) * dampingFactor;
      let dy = (y - previous[at + 1]) * dampingFactor + fall;
      let dz = (z - previous[at + 2]) * dampingFactor;
      const square = dx * dx + dy * dy + dz * dz;
      if (square > limit * limit) {
        const scale = limit / Math.sqrt(square);
        dx *= scale;
        dy *= scale;
        dz *= scale;
      }
      previous[at] = x;
      previous[at + 1] = y;
      previous[at + 2] = z;
      positions[at] = x + dx;
      positions[at + 1] = y + dy;
      positions[at + 2] = z + dz;
    }
  }

  #relax() {
    const { positions, weights, ends, rests } = this;
    for (let link = 0; link < rests.length; link++) {
      const i = ends[2 * link];
      const j = ends[2 * link + 1];
      const wi = weights[i];
      const wj = weights[j];
      const w = wi + wj;
      if (w === 0) continue;
      const a = 3 * i;
      const b = 3 * j;
      const dx = positions[b] - positions[a];
      const dy = positions[b + 1] - positions[a + 1];
      const dz = positions[b + 2] - positions[a + 2];
      const length = Math.sqrt(dx * dx + dy * dy + dz * dz);
      if (length < 1e-9) continue;
      const share = (length - rests[link]) / (length * w);
      positions[a] += dx * share * wi;
      positions[a + 1] += dy * share * wi;
      positions[a + 2] += dz * share * wi;
      positions[b] -= dx * share * wj;
      positions[b + 1] -= dy * share * wj;
      positions[b + 2] -= dz * share * wj;
    }
  }
}

/** Computes vertex normals as area-weighted means over the triangles around each vertex. */
export function computeNormals(positions, indices, normals) {
  normals.fill(0);
  for (let at = 0; at < indices.length; at += 3) {
    const a = 3 * indices[at];
    const b = 3 * indices[at + 1];
    const c = 3 * indices[at + 2];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    normals[a] += x;
    normals[a + 1] += y;
    normals[a + 2] += z;
    normals[b] += x;
    normals[b + 1] += y;
    normals[b + 2] += z;
    normals[c] += x;
    normals[c + 1] += y;
    normals[c + 2] += z;
  }
  for (let at = 0; at < normals.length; at += 3) {
    const x = normals[at];
    const y = normals[at + 1];
    const z = normals[at + 2];
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    normals[at] = x / length;
    normals[at + 1] = y / length;
    normals[at + 2] = z / length;
  }
}
