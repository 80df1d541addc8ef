// The class Skin: a render mesh that follows a cloth. It holds a function `live` that returns the
// cloth's RawCloth, or throws if the cloth was freed.

import * as raw from "./raw.js";
import { check, checkKeys, toFloat32Array, toNumber, toUint32Array } from "./check.js";
import { isTrap, viewOf } from "./memory.js";
import { CONSTRUCTOR_KEY, checkConstructorKey } from "./handles.js";
import { setState, stateOf } from "./state.js";
import { writeVertices } from "./write.js";

const KEYS = ["positions", "indices", "uvs", "smoothness"];

/** Makes a skin; turns a trap of the module into an error about memory. */
export function makeSkin(live, desc) {
  const cloth = live();
  checkKeys(desc, "desc", KEYS);
  const positions = toFloat32Array(desc.positions, "positions", 3);
  const indices = toUint32Array(desc.indices, "indices");
  const uvs = toFloat32Array(desc.uvs ?? [], "uvs", 2);
  const smoothness = toNumber(desc.smoothness ?? raw.default_smoothness(), "smoothness");
  try {
    return new Skin(CONSTRUCTOR_KEY, live, cloth.skin(positions, indices, uvs, smoothness));
  } catch (error) {
    if (!isTrap(error)) throw error;
    throw new Error("there is not enough memory for this skin", { cause: error });
  }
}

/** Returns the state of a skin and its RawSkin, updated. Throws if the skin or its cloth was freed. */
function refreshed(skin) {
  const state = stateOf(skin, "Skin");
  check(state.own, "skin", "be live, but was freed");
  const cloth = state.live();
  state.own.refresh(cloth);
  return { views: state.views, own: state.own, cloth };
}

export class Skin {
  constructor(key, live, own) {
    checkConstructorKey(key, "a skin is made by cloth.skin()");
    setState(this, { live, own, views: {} });
  }

  free() {
    const state = stateOf(this, "Skin");
    state.own?.free();
    [state.own, state.views] = [undefined, {}];
  }

  get isFreed() {
    return stateOf(this, "Skin").own === undefined;
  }

  get positions() {
    const { views, own } = refreshed(this);
    return viewOf(views, "positions", Float32Array, own.positions_ptr(), 3 * own.vertex_count());
  }

  get normals() {
    const { views, own } = refreshed(this);
    return viewOf(views, "normals", Float32Array, own.normals_ptr(), 3 * own.vertex_count());
  }

  get uvs() {
    const { views, own } = refreshed(this);
    return viewOf(views, "uvs", Float32Array, own.uvs_ptr(), 2 * own.vertex_count());
  }

  get indices() {
    const { views, own } = refreshed(this);
    return viewOf(views, "indices", Uint32Array, own.indices_ptr(), own.index_count());
  }

  get sourceVertices() {
    const { views, own } = refreshed(this);
    return viewOf(views, "sources", Uint32Array, own.source_vertices_ptr(), own.vertex_count());
  }

  get frayed() {
    const { views, own } = refreshed(this);
    return viewOf(views, "frayed", Uint8Array, own.frayed_ptr(), own.vertex_count());
  }

  get vertexCapacity() {
    return refreshed(this).own.vertex_capacity();
  }

  get topologyRevision() {
    return refreshed(this).own.topology_revision();
  }

  write(streams, desc = {}) {
    const { own, cloth } = refreshed(this);
    const target = {
      vertex_count: () => own.vertex_count(),
      reserve_staging: (size) => cloth.reserve_staging(size),
      write_vertices: (list, packed) => own.write_vertices(cloth, list, packed),
    };
    return writeVertices(target, streams, desc);
  }
}

// In engines with `using`.
if (Symbol.dispose) {
  const notEnumerable = (value) => ({ value, writable: true, configurable: true });
  Object.defineProperty(Skin.prototype, Symbol.dispose, notEnumerable(Skin.prototype.free));
}
