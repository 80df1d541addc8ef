// A hanging sheet with Babylon.js.

import init, { Cloth } from "../muslin/index.js";
import { makeClothMesh, pullClothMesh } from "./cloth-mesh.js";

const { BABYLON } = globalThis;
const { Color3, Color4, Vector3 } = BABYLON;
const $ = (id) => document.getElementById(id);
const canvas = $("stage");

await init();

const cloth = Cloth.grid({
  columns: 40,
  rows: 40,
  spacing: 2 / 39,
  origin: [-1, 1, 0],
  pinMode: "top-corners",
  material: "cotton",
  settings: { tearing: true, iterations: 4 },
});
cloth.material = { tearStretch: 1.8 };
const setWind = (speed) => (cloth.wind = { velocity: [0.3 * speed, 0, speed], gust: 0.6, wander: 0.5, turbulence: 0.3 });
setWind(1.5);

const engine = new BABYLON.Engine(canvas, true, { premultipliedAlpha: false });
const scene = new BABYLON.Scene(engine);
scene.useRightHandedSystem = true; // as the cloth is
scene.clearColor = new Color4(0, 0, 0, 0);
scene.ambientColor = new Color3(1, 1, 1);

const camera = new BABYLON.ArcRotateCamera("camera", 1.25, 1.5, 4.6, new Vector3(0, -0.15, 0), scene);
camera.fov = 0.7;
camera.wheelDeltaPercentage = 0.01;
camera.panningSensibility = 0;
[camera.lowerRadiusLimit, camera.upperRadiusLimit, camera.minZ] = [1.5, 14, 0.1];
camera.attachControl(true);

const sky = new BABYLON.HemisphericLight("sky", Vector3.Up(), scene);
sky.intensity = 0.5;
sky.groundColor = new Color3(0.3, 0.24, 0.2);
const key = new BABYLON.DirectionalLight("key", new Vector3(-0.5, -0.8, -0.7), scene);
key.position = new Vector3(2.2, 3.6, 3.2);
key.diffuse = new Color3(1, 0.94, 0.84);
key.intensity = 0.95;
const rim = new BABYLON.DirectionalLight("rim", new Vector3(0.4, -0.4, 1), scene);
rim.diffuse = new Color3(1, 0.62, 0.36);
rim.intensity = 0.5;

const { mesh, update } = makeClothMesh(BABYLON, cloth, scene);
const fabric = new BABYLON.StandardMaterial("fabric", scene);
fabric.diffuseColor = new Color3(0.22, 0.34, 0.62);
fabric.specularColor = new Color3(0.1, 0.1, 0.11);
fabric.specularPower = 24;
fabric.ambientColor = new Color3(0.03, 0.035, 0.05);
fabric.backFaceCulling = false;
fabric.twoSidedLighting = true;
// Front faces are counter-clockwise; Babylon.js assumes otherwise in a right-handed scene.
fabric.sideOrientation = BABYLON.Material.CounterClockWiseSideOrientation;
mesh.material = fabric;
pullClothMesh(BABYLON, cloth, mesh, scene);

const rod = BABYLON.MeshBuilder.CreateCylinder("rod", { height: 2.3, diameter: 0.032 }, scene);
rod.rotation.z = Math.PI / 2;
rod.position.y = 1.012;
rod.material = new BABYLON.StandardMaterial("brass", scene);
rod.material.diffuseColor = new Color3(0.5, 0.45, 0.38);

$("wind").addEventListener("input", ({ target }) => {
  document.querySelector("output").value = target.value;
  setWind(target.valueAsNumber);
});
$("reset").addEventListener("click", () => cloth.reset());
$("cut").addEventListener("click", () => cloth.cut([-0.7, 0.3, -4], [0.5, -0.4, -4], [0, 0, 8]));

/** Moves the camera so far away that the whole sheet is in view. */
function fit() {
  engine.resize();
  const aspect = canvas.clientWidth / canvas.clientHeight;
  camera.radius = 1.5 / (Math.tan(camera.fov / 2) * Math.min(aspect, 1.05));
}
addEventListener("resize", fit);
fit();

engine.runRenderLoop(() => {
  cloth.advance(Math.min(engine.getDeltaTime() / 1000, 0.1));
  update();
  scene.render();
  const { particles, pieces } = cloth.stats;
  $("stats").textContent = `${particles} particles · ${pieces === 1 ? "whole" : `${pieces} pieces`}`;
});
