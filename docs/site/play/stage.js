// The picture of the playground: lights, floor, camera, and the cloths that the code shows.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { ClothGeometry, ClothPointers } from "muslin/three";

/** Colours of the two sides of each fabric. */
const COLORS = {
  silk: [0x4766e8, 0x9fb4ff],
  cotton: [0xe9e2d2, 0xcfc6b2],
  denim: [0x2f4778, 0x8fa3c4],
  leather: [0x7a4a2c, 0xb08a68],
  paper: [0xf2efe6, 0xdedacd],
  "flag-nylon": [0xc8443c, 0xe0756c],
};

/** How far a pointer may miss a cloth and still grab it [m]. */
const GRAB_RADIUS = 0.05;
const ARROW = 0.12;

export class Stage {
  /** The cloths that are drawn: each with its geometry, meshes and pointers. */
  cloths = [];

  constructor(canvas, settings) {
    this.canvas = canvas;
    this.settings = settings;
    this.scene = makeScene();
    this.camera = new THREE.PerspectiveCamera(36, 1, 0.05, 60);
    this.camera.position.set(1.5, 0.35, 4.6);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    new ResizeObserver(() => this.fit()).observe(canvas);
    this.fit();
    this.canvas.addEventListener("keydown", (event) => this.orbitByKey(event));
  }

  /** Draws a cloth from now on. */
  show(cloth, { color } = {}) {
    const [front, back] = color === undefined ? COLORS[this.settings.fabric] ?? COLORS.silk : [color, color];
    const geometry = new ClothGeometry(cloth);
    const meshes = [[front, THREE.FrontSide], [back, THREE.BackSide]].map(([tint, side]) => {
      const material = new THREE.MeshPhysicalMaterial({
        color: tint, side, roughness: 0.55, sheen: 0.6, sheenRoughness: 0.4, sheenColor: new THREE.Color(tint).lerp(new THREE.Color(0xffffff), 0.5),
      });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.receiveShadow = true;
      return mesh;
    });
    meshes[0].castShadow = true;
    meshes[0].material.shadowSide = THREE.DoubleSide;
    this.scene.add(...meshes);
    const pointers = new ClothPointers(meshes[0], this.camera, this.canvas, { radius: GRAB_RADIUS });
    const shown = { cloth, geometry, meshes, pointers };
    this.cloths.push(shown);
    // Made after the pointers, so that a press that grabs cloth does not turn the camera.
    this.orbit ??= this.makeOrbit();
    return meshes[0];
  }

  makeOrbit() {
    const orbit = new OrbitControls(this.camera, this.canvas);
    Object.assign(orbit, { enableDamping: true, minDistance: 0.8, maxDistance: 14, enablePan: false });
    orbit.target.set(0, 0, 0);
    return orbit;
  }

  /** Turns the camera with the arrow keys. */
  orbitByKey(event) {
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!turn) return;
    event.preventDefault();
    const at = new THREE.Spherical().setFromVector3(this.camera.position);
    at.theta += ARROW * turn[0];
    at.phi = Math.min(Math.max(at.phi + ARROW * turn[1], 0.1), Math.PI - 0.1);
    this.camera.position.setFromSpherical(at);
    this.camera.lookAt(0, 0, 0);
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A narrow picture shows as much of the scene's width as a square one.
    this.camera.zoom = Math.min(this.camera.aspect, 1);
    this.camera.updateProjectionMatrix();
  }

  draw(seconds) {
    for (const { cloth, geometry } of this.cloths) if (!cloth.isFreed) geometry.update();
    this.orbit?.update(seconds);
    if (!this.orbit) this.camera.lookAt(0, 0, 0);
    this.renderer.render(this.scene, this.camera);
  }
}

function makeScene() {
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xb8c6ff, 0x2a2230, 1.1));
  const key = new THREE.DirectionalLight(0xfff0dc, 2.6);
  key.position.set(2.4, 3.8, 3.2);
  key.castShadow = true;
  key.shadow.mapSize.set(1024, 1024);
  Object.assign(key.shadow.camera, { left: -2.6, right: 2.6, top: 2.6, bottom: -2.6, near: 1, far: 12 });
  key.shadow.bias = -0.0006;
  key.shadow.normalBias = 0.03;
  key.shadow.radius = 5;
  const rim = new THREE.DirectionalLight(0x6f8dff, 1.5);
  rim.position.set(-2.2, 1.6, -3.2);
  scene.add(key, rim);
  const floor = new THREE.Mesh(
    new THREE.CircleGeometry(6, 64),
    new THREE.ShadowMaterial({ color: 0x000000, opacity: 0.5 }),
  );
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -1.4;
  floor.receiveShadow = true;
  scene.add(floor);
  return scene;
}
