// Entry point `muslin/react`: a cloth and its colliders as components of react-three-fiber.

import {
  createContext,
  createElement,
  forwardRef,
  useContext,
  useImperativeHandle,
  useLayoutEffect,
  useRef,
  useState,
} from "react";
import { useFrame, useThree } from "@react-three/fiber";
import { Matrix4, Quaternion, Vector3 } from "three";
import init, { Cloth as MuslinCloth } from "./index.js";
import { isLoaded } from "./memory.js";
import { ClothGeometry, ClothPointers } from "./three.js";

const ClothContext = createContext(undefined);

/** The first load of the module, and its error if it failed. */
let [loading, failure] = [undefined, undefined];

/** Suspends the component until the module is loaded: throws a promise that React awaits. */
function suspendUntilLoaded() {
  if (isLoaded()) return;
  if (failure) throw failure;
  throw (loading ??= init().catch((error) => (failure = error)));
}

/** Returns whether two values of props have the same contents: plain objects and arrays by their values. */
function isSame(a, b) {
  if (Object.is(a, b)) return true;
  const isPlain = (value) => Array.isArray(value) || value?.constructor === Object;
  if (!isPlain(a) || !isPlain(b)) return false;
  const [keys, others] = [Object.keys(a), Object.keys(b)];
  return keys.length === others.length && keys.every((key) => isSame(a[key], b[key]));
}

/** Returns the earlier value as long as the new one has the same contents, so that effects do not run again. */
function useSame(value) {
  const last = useRef(value);
  if (!isSame(last.current, value)) last.current = value;
  return last.current;
}

/**
 * Makes a cloth and its geometry after the first render and whenever `shape` changes, and frees
 * both when they are not needed any more.
 */
function useClothGeometry(shape, make) {
  const [geometry, setGeometry] = useState(undefined);
  useLayoutEffect(() => {
    const made = new ClothGeometry(make());
    setGeometry(made);
    return () => {
      setGeometry(undefined);
      made.dispose();
      made.cloth.free();
    };
  }, [shape]);
  return geometry;
}

/** Assigns a property of the cloth whenever the prop changes. */
function useAssigned(cloth, key, value) {
  const same = useSame(value);
  useLayoutEffect(() => {
    if (same !== undefined) cloth[key] = same;
  }, [cloth, key, same]);
}

export const Cloth = forwardRef(function Cloth({ grid, mesh, ...rest }, ref) {
  suspendUntilLoaded();
  const { material, settings, ...shape } = mesh ?? grid ?? {};
  const make = () => (mesh ? MuslinCloth.mesh(mesh) : MuslinCloth.grid(grid));
  const geometry = useClothGeometry(useSame({ isMesh: mesh !== undefined, ...shape }), make);
  // A freed cloth stays in the state until React renders again.
  const isLive = geometry && !geometry.cloth.isFreed;
  return isLive ? createElement(ClothMesh, { ...rest, geometry, desc: { material, settings }, ref }) : null;
});

const ClothMesh = forwardRef(function ClothMesh(props, ref) {
  const { geometry, desc, wind, pointers = true, paused = false, children, ...rest } = props;
  const { cloth } = geometry;
  const mesh = useRef(null);
  const colliders = useRef(new Set()).current;
  const camera = useThree((state) => state.camera);
  const element = useThree((state) => state.events.connected ?? state.gl.domElement);
  const options = useSame(pointers);
  useImperativeHandle(ref, () => mesh.current, []);
  useAssigned(cloth, "material", desc.material);
  useAssigned(cloth, "settings", desc.settings);
  useAssigned(cloth, "wind", wind);
  useLayoutEffect(() => {
    if (options === false) return undefined;
    const grabbing = new ClothPointers(mesh.current, camera, element, options === true ? {} : options);
    return () => grabbing.dispose();
  }, [geometry, camera, element, options]);
  useFrame((_, seconds) => {
    if (cloth.isFreed) return;
    for (const follow of colliders) follow();
    if (!paused) cloth.advance(seconds);
    geometry.update();
  });
  const value = useSame({ cloth, colliders });
  const content = createElement(ClothContext.Provider, { value }, children);
  return createElement("mesh", { ...rest, ref: mesh, geometry }, content);
});

function useClothContext(user) {
  const context = useContext(ClothContext);
  if (!context) throw new Error(`${user} must be inside <Cloth>`);
  return context;
}

export function useCloth() {
  return useClothContext("useCloth()").cloth;
}

const [pose, position, rotation, scale] = [new Matrix4(), new Vector3(), new Quaternion(), new Vector3()];

/**
 * Returns position and rotation of an object in the space of the mesh that it is inside, as one
 * list. It is the product of the matrices below the mesh, so it stays the same if the mesh moves.
 */
function poseOf(object, mesh) {
  pose.identity();
  for (let at = object; at !== mesh; at = at.parent) {
    if (at.matrixAutoUpdate) at.updateMatrix();
    pose.premultiply(at.matrix);
  }
  pose.decompose(position, rotation, scale);
  return [...position.toArray(), ...rotation.toArray()];
}

/** Adds a collider where `group` is, and returns a function that removes it. */
function addFollowing({ cloth, colliders }, desc, group, mesh) {
  let last = poseOf(group, mesh);
  const collider = cloth.addCollider({ ...desc, position: last.slice(0, 3), rotation: last.slice(3) });
  const follow = () => {
    const next = poseOf(group, mesh);
    if (!isSame(next, last)) collider.moveTo(next.slice(0, 3), next.slice(3));
    last = next;
  };
  colliders.add(follow);
  return () => {
    colliders.delete(follow);
    if (!cloth.isFreed) collider.remove();
  };
}

/** The fields of a collider that are no props of a group. */
const COLLIDER_PROPS = [
  ...["shape", "friction", "restitution", "tangentialRestitution", "thickness", "radius", "topRadius", "halfHeight"],
  ...["halfExtents", "spacing", "columns", "rows", "solid", "positions", "indices", "heights"],
];

export const Collider = forwardRef(function Collider({ children, ...props }, ref) {
  const context = useClothContext("<Collider>");
  const group = useRef(null);
  const isOfCollider = ([key]) => COLLIDER_PROPS.includes(key);
  const entries = Object.entries(props);
  const desc = useSame(Object.fromEntries(entries.filter(isOfCollider)));
  const rest = Object.fromEntries(entries.filter((entry) => !isOfCollider(entry)));
  useImperativeHandle(ref, () => group.current, []);
  useLayoutEffect(() => {
    let mesh = group.current;
    while (mesh.geometry?.cloth !== context.cloth) mesh = mesh.parent;
    return addFollowing(context, desc, group.current, mesh);
  }, [context, desc]);
  return createElement("group", { ...rest, ref: group }, children);
});
