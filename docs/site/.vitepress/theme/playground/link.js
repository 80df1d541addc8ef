// Links to a state of the playground: settings and code, compressed, in the fragment of the address,
// which no server gets.

import { checkedSettings, defaults } from "./settings.js";

const KEY = "play=";
/** The longest code that a link may hold, in characters. */
const MAX_CODE = 100_000;

/** Returns the fragment for a state. Settings at their defaults are left out. */
export async function fragmentFor({ code, settings }) {
  const initial = defaults();
  const changed = Object.entries(settings).filter(([name, value]) => initial[name] !== value);
  const bytes = new TextEncoder().encode(JSON.stringify({ code, settings: Object.fromEntries(changed) }));
  const packed = await piped(bytes, new CompressionStream("deflate-raw"));
  const text = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(""));
  return `#${KEY}${text.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/**
 * Returns the state that a fragment holds; none if it holds no state.
 *
 * @throws if it is damaged or not allowed
 */
export async function stateOf(fragment) {
  if (!fragment.startsWith(`#${KEY}`)) return undefined;
  const text = fragment.slice(1 + KEY.length).replaceAll("-", "+").replaceAll("_", "/");
  let state;
  try {
    const packed = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
    state = JSON.parse(new TextDecoder().decode(await piped(packed, new DecompressionStream("deflate-raw"))));
  } catch {
    throw new Error("the link is damaged: its end is missing or was changed");
  }
  if (typeof state?.code !== "string" || state.code.length > MAX_CODE) {
    throw new Error(`\`code\` of the link must be text of at most ${MAX_CODE} characters`);
  }
  return { code: state.code, settings: checkedSettings(state.settings) };
}

async function piped(bytes, transform) {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
