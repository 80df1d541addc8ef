uniform mat4 clipFromWorld;
uniform vec3 centre;
uniform vec3 right;
uniform vec3 up;
uniform vec3 keyTowards;
uniform float time;
in vec3 mote; // corner, number

out vec2 place;
out float glint;

// Numbers between 0 and 1 from a number (golden ratios in three dimensions).
vec3 spread(float i) {
    return fract(i * vec3(0.8191725, 0.6710436, 0.5497005) + 0.5);
}

void main() {
    vec3 seed = spread(mote.z);
    vec3 speed = spread(mote.z + 97.0);
    // Each mote rises slowly, sways, and starts again below.
    float path = fract(seed.y + time * mix(0.006, 0.014, speed.x));
    vec3 at = (vec3(seed.x, path, seed.z) - 0.5) * vec3(4.6, 2.9, 3.6);
    at.xz += 0.12 * sin(time * (0.2 + 0.3 * speed.yz) + 6.2831853 * seed.zx);
    // Distance from the axis of the key light.
    vec3 off = at - keyTowards * dot(at, keyTowards);
    float ends = smoothstep(0.0, 0.15, path) * smoothstep(1.0, 0.85, path);
    glint = exp(-1.1 * dot(off, off)) * ends * (0.55 + 0.45 * sin(time * (0.6 + speed.y) + 40.0 * seed.x));
    place = mote.xy;
    float size = mix(0.006, 0.022, speed.z * speed.z);
    gl_Position = clipFromWorld * vec4(centre + at + (right * mote.x + up * mote.y) * size, 1.0);
}
