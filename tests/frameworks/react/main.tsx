// A page of react-three-fiber: a cloth hangs in the wind, a ball pushes it, and a pointer pulls it.

import { Canvas, useFrame } from "@react-three/fiber";
import { type Cloth as MuslinCloth, version } from "muslin";
import { Cloth, Collider, useCloth } from "muslin/react";
import type { ClothGeometry } from "muslin/three";
import { type RefObject, StrictMode, useLayoutEffect, useRef, useState } from "react";
import { createRoot } from "react-dom/client";
import { DoubleSide, type Group, type Material, type Mesh, Vector3 } from "three";

declare global {
  interface Window {
    /** What the page shows, after each frame. */
    result?: object;
    /** What the test changes. */
    controls: { setColumns(n: number): void; setPaused(is: boolean): void; setShown(is: boolean): void };
    mesh: Mesh<ClothGeometry, Material> | null;
  }
}

/** Radius of the ball [m]. */
const RADIUS = 0.25;

/** A ball that swings through the cloth; it is moved through its ref. */
function Ball({ ball }: { ball: RefObject<Group | null> }) {
  useFrame(({ clock }) => ball.current!.position.setZ(0.45 * Math.cos(1.5 * clock.elapsedTime)));
  return (
    <Collider ref={ball} shape="sphere" radius={RADIUS} position={[0, -1.1, 0.45]} friction={0.2}>
      <mesh>
        <sphereGeometry args={[RADIUS - 0.01, 32, 16]} />
        <meshStandardMaterial color="#d8a13a" />
      </mesh>
    </Collider>
  );
}

/** Gives the cloth that it is inside to the page. */
function Probe({ keep }: { keep: (cloth: MuslinCloth) => void }) {
  const cloth = useCloth();
  useLayoutEffect(() => void keep(cloth), [cloth, keep]);
  return null;
}

/** Stores what there is after the cloth's frame: it comes after the cloth, so it runs later. */
function Report({ ball, cloth }: { ball: RefObject<Group | null>; cloth: RefObject<MuslinCloth | null> }) {
  useFrame(() => {
    const { mesh } = window;
    if (!mesh || !ball.current || !cloth.current || cloth.current.isFreed) return;
    const { positions, time, wind, material, stats } = cloth.current;
    const center = mesh.worldToLocal(ball.current.getWorldPosition(new Vector3()));
    const at = new Vector3();
    let [gap, right, bulge] = [Infinity, -Infinity, 0];
    for (let i = 0; i < positions.length; i += 3) {
      at.fromArray(positions, i);
      gap = Math.min(gap, at.distanceTo(center) - RADIUS);
      right = Math.max(right, at.x);
      bulge = Math.max(bulge, Math.abs(at.z));
    }
    const [{ particles }, { density }, speed] = [stats, material, wind.velocity[2]];
    window.result = { version: version(), time, particles, density, speed, gap, right, bulge };
  });
  return null;
}

function App() {
  const [columns, setColumns] = useState(30);
  const [isShown, setShown] = useState(true);
  const [paused, setPaused] = useState(false);
  window.controls = { setColumns, setPaused, setShown };
  const grid = { columns, rows: columns, spacing: 1.6 / (columns - 1), pinMode: "top-edge", material: "denim" } as const;
  const ball = useRef<Group>(null);
  const cloth = useRef<MuslinCloth>(null);
  const keep = (mesh: Mesh | null) => {
    window.mesh = mesh as Mesh<ClothGeometry, Material> | null;
  };
  return (
    <Canvas camera={{ position: [0, 0, 3.2], fov: 40 }} dpr={1}>
      <hemisphereLight args={["#bfd0ff", "#403020", 1.5]} />
      <directionalLight position={[2, 3, 4]} intensity={2} />
      {isShown && (
        <Cloth
          ref={keep}
          grid={grid}
          position={[-0.8, 0.8, 0]}
          wind={{ velocity: [0, 0, 1] }}
          pointers={{ radius: 0.05 }}
          paused={paused}
        >
          <meshStandardMaterial color="#b23a34" roughness={0.8} side={DoubleSide} />
          <group position={[0.8, 0, 0]}>
            <Ball ball={ball} />
          </group>
          <Probe keep={(found) => void (cloth.current = found)} />
        </Cloth>
      )}
      <Report ball={ball} cloth={cloth} />
    </Canvas>
  );
}

createRoot(document.getElementById("root")!).render(<StrictMode><App /></StrictMode>);
