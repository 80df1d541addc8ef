// The scene around the sheet: lights, floor, rod, and the materials of the sheet. Works in pages
// and in workers.

/** Returns a texture that `paint` draws on a 2D canvas. */
function canvasTexture(THREE, size, paint) {
  const canvas = new OffscreenCanvas(size, size);
  paint(canvas.getContext("2d"), size);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}

/** Returns a texture of a radial gradient from `inner` to `outer`. */
function radialGradient(THREE, inner, outer) {
  return canvasTexture(THREE, 256, (context, size) => {
    const fade = context.createRadialGradient(size / 2, size / 2, 0, size / 2, size / 2, size / 2);
    fade.addColorStop(0, inner);
    fade.addColorStop(1, outer);
    context.fillStyle = fade;
    context.fillRect(0, 0, size, size);
  });
}

/** Returns a tiled texture of a plain weave. */
function weaveTexture(THREE) {
  const texture = canvasTexture(THREE, 64, (context, size) => {
    const half = size / 2;
    for (const [x, y, isWarp] of [[0, 0, true], [half, half, true], [half, 0, false], [0, half, false]]) {
      const ends = isWarp ? [x, y, x + half, y] : [x, y, x, y + half];
      const round = context.createLinearGradient(...ends);
      for (const [at, shade] of [[0, "#d2d2d2"], [0.5, "#ffffff"], [1, "#d2d2d2"]]) round.addColorStop(at, shade);
      context.fillStyle = round;
      context.fillRect(x, y, half, half);
    }
  });
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.repeat.set(80, 80);
  texture.anisotropy = 2;
  return texture;
}

/** Makes two meshes for the two sides of a sheet, in two colours. Returns their group and both. */
export function makeSheet(THREE, geometry) {
  const map = weaveTexture(THREE);
  const side = (which, color) => {
    const material = new THREE.MeshStandardMaterial({ color, map, side: which, roughness: 0.78 });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.receiveShadow = true;
    return mesh;
  };
  const front = side(THREE.FrontSide, 0xb23a34);
  front.castShadow = true;
  front.material.shadowSide = THREE.DoubleSide;
  const back = side(THREE.BackSide, 0xc9924f);
  const sheet = new THREE.Group();
  sheet.add(front, back);
  return { sheet, front, back };
}

/**
 * Makes the scene without the sheet, which hangs from y = 1 to y = -1: lights, floor, two glows,
 * the rod.
 */
export function makeScene(THREE) {
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xa8b8e0, 0x5a4638, 1.15));

  const key = new THREE.DirectionalLight(0xfff1dc, 2.5);
  key.position.set(2.2, 3.6, 3.2);
  key.castShadow = true;
  key.shadow.mapSize.set(1024, 1024);
  Object.assign(key.shadow.camera, { left: -2.4, right: 2.4, top: 2.4, bottom: -2.4, near: 1, far: 10 });
  key.shadow.bias = -0.0006;
  key.shadow.normalBias = 0.03;
  key.shadow.radius = 5;

  const fill = new THREE.DirectionalLight(0x7fa4ff, 0.6);
  fill.position.set(-3.4, 0.6, 2);
  const rim = new THREE.DirectionalLight(0xff9a5c, 1.6);
  rim.position.set(-1.6, 2, -3.4);
  scene.add(key, fill, rim);

  const floor = new THREE.Mesh(
    new THREE.CircleGeometry(4.5, 64),
    new THREE.MeshStandardMaterial({
      color: 0x3a3f4d, roughness: 0.95, transparent: true, depthWrite: false, alphaMap: radialGradient(THREE, "#fff", "#000"),
    }),
  );
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -1.55;
  floor.receiveShadow = true;
  scene.add(floor);

  for (const [tint, x, y, z, size] of [
    ["rgb(255 150 90 / 0.30)", -1.5, 1.0, -2.4, 4.2],
    ["rgb(110 150 255 / 0.20)", 1.9, 0.1, -2.6, 4.6],
  ]) {
    const glow = new THREE.Sprite(new THREE.SpriteMaterial({
      map: radialGradient(THREE, tint, "rgb(0 0 0 / 0)"), blending: THREE.AdditiveBlending, depthWrite: false,
    }));
    glow.position.set(x, y, z);
    glow.scale.setScalar(size);
    scene.add(glow);
  }

  const rod = new THREE.Mesh(
    new THREE.CylinderGeometry(0.016, 0.016, 2.3, 20),
    new THREE.MeshStandardMaterial({ color: 0x9a8f80, roughness: 0.35, metalness: 0.8 }),
  );
  rod.rotation.z = Math.PI / 2;
  rod.position.y = 1.012;
  scene.add(rod);
  return scene;
}

/** Makes a renderer with a transparent background, so that the page's own background shows. */
export function makeRenderer(THREE, canvas) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 1.05;
  renderer.outputColorSpace = THREE.SRGBColorSpace;
  renderer.shadowMap.enabled = true;
  // From release 182 on, three.js has one kind of soft shadow, under another name.
  renderer.shadowMap.type = Number(THREE.REVISION) < 182 ? THREE.PCFSoftShadowMap : THREE.PCFShadowMap;
  return renderer;
}
