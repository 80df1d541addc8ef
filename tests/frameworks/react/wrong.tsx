// Uses of the components that the types must refuse.

import { Cloth, Collider } from "muslin/react";

export const wrong = [
  // @ts-expect-error: no such pin mode
  <Cloth grid={{ pinMode: "bottom" }} />,
  // @ts-expect-error: no such shape
  <Collider shape="cone" />,
  // @ts-expect-error: the geometry is the cloth's own
  <Cloth geometry={undefined} />,
];
