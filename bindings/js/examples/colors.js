// Vertex colours as inputs of a cloth: what artists paint into the `COLOR_0` of a glTF mesh.

/** The largest number of each type of array: 1 for floats, the top of the range for integers. */
const ONE = new Map([[Uint8Array, 255], [Uint8ClampedArray, 255], [Uint16Array, 65535]]);

/**
 * Returns one channel of vertex colours as a number from 0 to 1 for each particle, for `setMap`,
 * `setMaxDistances`, `setBackstops`, or to choose pins. `colors` has `components` numbers per vertex of
 * the mesh that the cloth was made from (3 or 4): floats, or normalised integers. The particle of
 * several vertices takes the colour of the last one.
 */
export function colorChannel(cloth, colors, channel, components = 4) {
  const one = ONE.get(colors.constructor) ?? 1;
  const { vertexParticles, sourceVertices } = cloth;
  const values = new Float32Array(vertexParticles.reduce((most, particle) => Math.max(most, particle), 0) + 1);
  vertexParticles.forEach((particle, vertex) => {
    values[particle] = colors[components * sourceVertices[vertex] + channel] / one;
  });
  return values;
}
