// Cloths, handles, pointers and geometries in reactive objects of Vue, which are proxies of them.

import init, { Cloth } from "muslin";
import { Pointers } from "muslin/pointers";
import { ClothGeometry } from "muslin/three";
import { createApp, h, isReactive, onMounted, reactive, ref } from "vue";
import { play, report } from "../shared.mjs";

async function run() {
  const hash = await play(init, Cloth);
  const cloth = ref(Cloth.grid());
  const made = reactive({
    collider: cloth.value.addCollider({ shape: "sphere", position: [0, -9, 0], radius: 0.5 }),
    attachment: cloth.value.attach([0], [0, 0, 0]),
    pointers: new Pointers(cloth.value),
    geometry: new ClothGeometry(cloth.value),
  });
  const ticks = cloth.value.advance(1 / 60);
  made.pointers.press(1, [1, -1, 5], [0, 0, -1]);
  const held = made.pointers.size;
  made.pointers.liftAll();
  made.collider.moveTo([0, -8, 0]);
  made.collider.remove();
  made.attachment.moveTo([0, 0.1, 0]);
  made.attachment.detach();
  const updated = made.geometry.update();
  const proxies = [cloth.value, ...Object.values(made)].filter(isReactive).length;
  cloth.value.free();
  return { hash, ticks, held, updated, proxies, isFreed: cloth.value.isFreed };
}

createApp({
  setup() {
    onMounted(() => report(run()));
    return () => h("p", "cloth");
  },
}).mount("#app");
