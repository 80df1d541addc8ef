// The shaders: two colours for the two sides, a key light, a rim light.

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 view;
out vec3 at, n;
void main() {
  at = position;
  n = normal;
  gl_Position = view * vec4(position, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 at, n;
out vec4 color;
void main() {
  vec3 normal = normalize(gl_FrontFacing ? n : -n);
  vec3 base = gl_FrontFacing ? vec3(0.025, 0.16, 0.19) : vec3(0.42, 0.22, 0.07);
  vec3 eye = normalize(vec3(0.0, -0.18, 4.2) - at);
  vec3 key = normalize(vec3(0.55, 0.75, 0.6));
  float lit = max(dot(normal, key), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  float gloss = pow(max(dot(normal, normalize(key + eye)), 0.0), 28.0);
  float rim = pow(1.0 - max(dot(normal, eye), 0.0), 3.0);
  vec3 light = vec3(1.0, 0.93, 0.82) * lit * 1.7 + mix(vec3(0.16, 0.13, 0.14), vec3(0.3, 0.36, 0.5), sky);
  vec3 shaded = base * light + vec3(1.0, 0.95, 0.85) * gloss * 0.28 + vec3(0.45, 0.6, 0.9) * rim * 0.16;
  shaded = shaded / (1.0 + 0.35 * shaded);
  color = vec4(pow(shaded, vec3(1.0 / 2.2)), 1.0);
}`;

/**
 * Makes a program and binds buffers for vertices of `stride` bytes. Returns the locations of its
 * uniforms.
 */
export function makeProgram(gl, stride) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  for (const attribute of [0, 1]) {
    gl.enableVertexAttribArray(attribute);
    gl.vertexAttribPointer(attribute, 3, gl.FLOAT, false, stride, 12 * attribute);
  }
  gl.enable(gl.DEPTH_TEST);
  return { view: gl.getUniformLocation(program, "view") };
}
