// Skeleton of the figure and its clip: it walks on the spot for four seconds, then kicks.

/** Bones: name, parent, and the joint in the rest pose [m]. The figure faces +z; its left is +x. */
export const BONES = [
  ["hips", null, [0, 0.93, 0]],
  ["chest", "hips", [0, 1.11, 0]],
  ["head", "chest", [0, 1.47, -0.01]],
  ...["Left", "Right"].flatMap((side) => {
    const x = side === "Left" ? 1 : -1;
    return [
      [`thigh${side}`, "hips", [0.088 * x, 0.9, 0]],
      [`shin${side}`, `thigh${side}`, [0.088 * x, 0.49, 0]],
      [`foot${side}`, `shin${side}`, [0.088 * x, 0.08, 0]],
      [`arm${side}`, "chest", [0.165 * x, 1.385, 0]],
      [`forearm${side}`, `arm${side}`, [0.165 * x, 1.105, 0]],
    ];
  }),
];

export const boneIndex = (name) => BONES.findIndex(([bone]) => bone === name);

/** Duration of the clip, and time between its keyframes [s]. */
export const DURATION = 6;
export const STEP = 1 / 30;

export function smooth(from, to, x) {
  const share = Math.min(Math.max((x - from) / (to - from), 0), 1);
  return share * share * (3 - 2 * share);
}

/** Returns the quaternion of a rotation about z by `roll`, after one about y, after one about x [rad]. */
function rotation(pitch, yaw = 0, roll = 0) {
  const [a, b, c] = [pitch, yaw, roll].map((angle) => [Math.sin(angle / 2), Math.cos(angle / 2)]);
  return [
    c[1] * b[1] * a[0] - c[0] * b[0] * a[1],
    c[1] * b[0] * a[1] + c[0] * b[1] * a[0],
    c[0] * b[1] * a[1] - c[1] * b[0] * a[0],
    c[1] * b[1] * a[1] + c[0] * b[0] * a[0],
  ];
}

/** Returns how far the right leg has kicked at a time, −0.4 (drawn back) to 1 (highest). */
const kickAt = (t) => -0.4 * smooth(4.1, 4.5, t) + 1.4 * smooth(4.5, 5.05, t) - smooth(5.15, 5.8, t);

/** Returns the rotations of all bones, by name, and the height of the hips [m] at a time [s]. */
export function poseAt(time) {
  const t = time % DURATION;
  const walking = smooth(0, 0.5, t) * (1 - smooth(3.5, 4.05, t));
  const phase = 2 * Math.PI * t;
  const swing = walking * Math.sin(phase);
  const kick = kickAt(t);
  const pose = {
    hips: rotation(-0.1 * Math.max(kick, 0), 0.1 * swing, 0),
    chest: rotation(0.03 - 0.1 * Math.max(kick, 0), -0.2 * swing, 0),
    head: rotation(0.1 * Math.max(kick, 0), 0.1 * swing),
  };
  for (const [side, x] of [["Left", 1], ["Right", -1]]) {
    const forward = x * swing;
    // The knee bends while the leg swings forward.
    const lift = walking * Math.max(x * Math.cos(phase), 0) ** 2;
    const own = side === "Right" ? kick : 0;
    const thigh = 0.4 * forward + 0.22 * lift + 0.08 + 1.35 * own;
    const knee = 0.16 + 0.75 * lift + (own < 0 ? -1.2 * own : 0.5 * own * (1 - own));
    pose[`thigh${side}`] = rotation(-thigh);
    pose[`shin${side}`] = rotation(knee);
    pose[`foot${side}`] = rotation(thigh - knee + (own > 0 ? 0.9 * own - thigh * own + knee * own : 0));
    pose[`arm${side}`] = rotation(0.35 * forward - 0.05, 0, x * (0.3 + 0.25 * Math.max(kick, 0)));
    pose[`forearm${side}`] = rotation(-0.35 + 0.1 * forward);
  }
  return { pose, height: 0.925 + 0.012 * walking * Math.cos(2 * phase) };
}
