"use client";

import init, { Cloth } from "muslin";
import { useEffect } from "react";
import { play, report, resultOf } from "../../shared.mjs";

export default function Client() {
  useEffect(() => {
    const inWorker = () => resultOf(new Worker(new URL("./worker.js", import.meta.url), { type: "module" }));
    report(play(init, Cloth).then(async (hash) => ({ hash, worker: await inWorker() })));
  }, []);
  return null;
}
