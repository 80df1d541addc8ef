import init, { Cloth } from "muslin";
import { ClothGeometry } from "muslin/three";
import { expect, test } from "vitest";
import { play } from "../shared.mjs";

test(`the package runs ${typeof document === "object" ? "in jsdom" : "in node"}`, async () => {
  expect(await play(init, Cloth)).toBe(process.env.GOLDEN);
  expect(new ClothGeometry(Cloth.grid()).update()).toBe(false);
}, 60_000); // on a machine that is busy with other tests too
