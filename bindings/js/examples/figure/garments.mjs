// Pattern pieces: a flared skirt and a loose shirt without sleeves, around the figure at rest.

/** A skin is this many times as fine as its cloth, along each direction. */
export const DETAIL = 3;

const mix = (a, b, share) => a + share * (b - a);
const power = (x, exponent) => Math.sign(x) * Math.abs(x) ** exponent;

/** Height, half width and half depth of the skirt [m]. */
const SKIRT = [[1.065, 0.134, 0.099], [1.025, 0.15, 0.116], [0.92, 0.2, 0.165], [0.56, 0.41, 0.37]];
const [SKIRT_COLUMNS, SKIRT_ROWS] = [36, 11];

function skirtPoint(column, row) {
  const lengths = SKIRT.slice(1).map((to, i) => Math.hypot(to[0] - SKIRT[i][0], to[1] - SKIRT[i][1]));
  let left = (1 - row / SKIRT_ROWS) * lengths.reduce((a, b) => a + b);
  let i = 0;
  while (i < 2 && left > lengths[i]) left -= lengths[i++];
  const [y, wide, deep] = SKIRT[i].map((from, k) => mix(from, SKIRT[i + 1][k], left / lengths[i]));
  const angle = (2 * Math.PI * column) / SKIRT_COLUMNS;
  return [-wide * Math.sin(angle), y, -0.006 - deep * Math.cos(angle)];
}

// The shirt: columns, rows up to the armholes, rows above; half widths of panel and neckline.
const [SHIRT_COLUMNS, LOWER, UPPER, PANEL, NECK] = [28, 6, 6, 5, 2];

function shirtPoint(column, row) {
  const angle = (2 * Math.PI * column) / SHIRT_COLUMNS;
  const [across, ahead] = [-power(Math.sin(angle), 0.85), -power(Math.cos(angle), 0.7)];
  const up = Math.min(row / LOWER, 1);
  const [wide, deep] = [mix(0.245, 0.174, up), mix(0.21, 0.148, up)];
  if (row <= LOWER) return [wide * across, mix(0.955, 1.225, up), deep * ahead];
  const over = (row - LOWER) / UPPER;
  const x = wide * across * (1 + 0.17 * over * over);
  const seam = 1.452 + 0.5 * Math.max(0.11 - Math.abs(x), 0) - 12 * Math.max(Math.abs(x) - 0.155, 0) ** 2;
  const z = over > 0.999 ? 0 : deep * ahead * Math.cos((Math.PI / 2) * over) ** 0.7;
  return [x, mix(1.225, seam, Math.sin((Math.PI / 2) * over)), z - 0.012 * over];
}

/** Whether the shirt has the cell at this column and row, of the coarse grid. */
function isShirt(column, row) {
  if (row < LOWER) return true;
  const half = SHIRT_COLUMNS / 2;
  const within = (cell, reach) => cell >= -reach && cell < reach;
  const sides = [[column - half, 3], [column < half ? column : column - 2 * half, 2]];
  return sides.some(([cell, neck]) => within(cell, PANEL) && !(within(cell, NECK) && row >= LOWER + UPPER - neck));
}

/** Samples a surface. The cloth (detail 1) is closed around; a skin has a seam for its texture. */
function sample(columns, rows, detail, point, has, isHeld, alias) {
  const piece = { positions: [], uvs: [], indices: [], held: [] };
  const vertices = new Map();
  const vertex = (column, row) => {
    const [c, r] = detail === 1 ? alias(column % columns, row) : [column, row];
    const key = `${c},${r}`;
    if (!vertices.has(key)) {
      vertices.set(key, vertices.size);
      piece.positions.push(...point(c / detail, r / detail));
      piece.uvs.push(c / (columns * detail), r / (rows * detail));
      if (isHeld(c / detail, r / detail)) piece.held.push(vertices.get(key));
    }
    return vertices.get(key);
  };
  for (let row = 0; row < rows * detail; row++) {
    for (let column = 0; column < columns * detail; column++) {
      if (!has(Math.floor(column / detail), Math.floor(row / detail))) continue;
      const [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([right, up]) => vertex(column + right, row + up));
      piece.indices.push(...((column + row) % 2 ? [a, b, d, b, c, d] : [a, b, c, a, c, d]));
    }
  }
  return piece;
}

export const makeSkirt = (detail) =>
  sample(SKIRT_COLUMNS, SKIRT_ROWS, detail, skirtPoint, () => true, (_, row) => row > SKIRT_ROWS - 1.01, (c, r) => [c, r]);

export function makeShirt(detail) {
  const rows = LOWER + UPPER;
  const middle = SHIRT_COLUMNS / 2;
  // Front and back share the vertices of the shoulder seam.
  const isFront = (column) => Math.abs(column - middle) < middle / 2;
  const alias = (c, r) => (r === rows && !isFront(c) ? [(3 * middle - c) % SHIRT_COLUMNS, r] : [c, r]);
  const isHeld = (column, row) => row > rows - 0.01 && Math.abs(column - middle) < 4.5;
  return sample(SHIRT_COLUMNS, rows, detail, shirtPoint, isShirt, isHeld, alias);
}
