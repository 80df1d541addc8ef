// Programs to start from.

const LIVE = `  const { wind, gust, gravity, substeps, iterations } = settings;
  const { tearing, selfCollision } = settings;
  cloth.wind = { velocity: [0.3 * wind, 0, wind], gust, turbulence: 0.3 };
  cloth.settings = { gravity: [0, -gravity, 0], substeps, iterations };
  cloth.settings = { tearing, selfCollision };
  cloth.advance(seconds);`;

const HANG = `import { Cloth } from "muslin";
import { onFrame, settings, show } from "playground";

const { columns, size, fabric, pins } = settings;

const cloth = Cloth.grid({
  columns,
  rows: columns,
  spacing: size / (columns - 1),
  origin: [-size / 2, size / 2, 0],
  pinMode: pins,
  material: fabric,
});
show(cloth); // drag it to pull it

onFrame((seconds) => {
${LIVE}
});
`;

const BALL = `import { Cloth } from "muslin";
import { Mesh, MeshStandardMaterial, SphereGeometry } from "three";
import { add, onFrame, settings, show } from "playground";

const { columns, size, fabric } = settings;
const radius = 0.45;

const cloth = Cloth.grid({
  columns,
  rows: columns,
  spacing: size / (columns - 1),
  origin: [-size / 2, 0.8, -size / 2],
  down: [0, 0, 1], // it lies flat
  pinMode: "none",
  material: fabric,
});
show(cloth);

const ball = cloth.addCollider({ shape: "sphere", radius, friction: 0.5 });
cloth.addCollider({ shape: "plane", position: [0, -1.4, 0] });
const mesh = add(new Mesh(
  new SphereGeometry(radius - 0.01, 48, 32),
  new MeshStandardMaterial({ color: 0xd9a441, roughness: 0.4 }),
));

let time = 0;
onFrame((seconds) => {
  time += seconds;
  const x = 0.4 * Math.sin(0.8 * time);
  ball.moveTo([x, 0, 0]);
  mesh.position.x = x;
${LIVE}
});
`;

const TEAR = `import { Cloth } from "muslin";
import { onFrame, settings, show } from "playground";

const { columns, size, fabric } = settings;

const cloth = Cloth.grid({
  columns,
  rows: columns,
  spacing: size / (columns - 1),
  origin: [-size / 2, size / 2, 0],
  pinMode: "top-edge",
  material: { preset: fabric, tearStretch: 1.4, tearVariation: 0.4 },
});
show(cloth);

// A hand pulls the lower corner until the cloth gives way.
const corner = columns * columns - 1;
const grab = cloth.grabParticle(corner);
const [x, y, z] = cloth.position(corner);
let time = 0;
let isHeld = true;

onFrame((seconds) => {
  time += seconds;
  if (time < 3) {
    grab.moveTo([x + 0.5 * time, y - 0.4 * time, z + 0.6 * time]);
  } else if (isHeld) {
    grab.release();
    isHeld = false;
  }
  cloth.settings = { tearing: true, selfCollision: settings.selfCollision };
  cloth.advance(seconds);
});
`;

const CUT = `import { Cloth } from "muslin";
import { onFrame, settings, show } from "playground";

const { columns, size, fabric, pins } = settings;

const cloth = Cloth.grid({
  columns,
  rows: columns,
  spacing: size / (columns - 1),
  origin: [-size / 2, size / 2, 0],
  pinMode: pins,
  material: fabric,
});
show(cloth);

let time = 0;
let cuts = 0;
onFrame((seconds) => {
  time += seconds;
  if (cuts < 3 && time > 1 + cuts) {
    // A blade from one point to the other sweeps through the cloth.
    const y = -0.3 * cuts;
    const edges = cloth.cut([-size, y, -2], [size * (0.4 - 0.2 * cuts), y + 0.2, -2], [0, 0, 4]);
    console.log("cut", ++cuts, "divided", edges, "edges;", cloth.stats.pieces, "pieces");
  }
${LIVE}
});
`;

/** The programs, by the name that the menu shows. */
export const SAMPLES = {
  "A sheet in the wind": HANG,
  "A sheet on a ball": BALL,
  "Pulled until it tears": TEAR,
  "Cut three times": CUT,
};
