uniform mat4 clipFromWorld;
uniform vec3 centre;
uniform vec3 eye;
uniform vec3 velocity;
uniform float time;
uniform float floorHeight;
uniform float pixel; // width of a pixel at a distance of 1 m [m]
in vec3 mote; // corner, number

out vec2 place;
out float bright;

const vec3 SIZE = vec3(6.0, 3.4, 5.0); // box that the drops fall through [m]
const float EXPOSURE = 0.018;          // time that a streak shows [s]

// Numbers between 0 and 1 from a number (golden ratios in three dimensions).
vec3 spread(float i) {
    return fract(i * vec3(0.8191725, 0.6710436, 0.5497005) + 0.5);
}

void main() {
    vec3 seed = spread(mote.z);
    float pace = mix(0.85, 1.15, spread(mote.z + 31.0).x);
    vec3 inside = fract(seed + velocity * (pace * time) / SIZE);
    vec3 at = centre + (inside - 0.5) * SIZE;
    vec3 along = velocity * (0.5 * EXPOSURE * pace);
    // A streak is at least one pixel wide, and paler then.
    float width = max(0.0022, 0.7 * pixel * distance(eye, at));
    vec3 side = normalize(cross(along, eye - at)) * width;
    vec3 border = smoothstep(vec3(0.0), vec3(0.12), min(inside, 1.0 - inside));
    bright = border.x * border.y * border.z * step(floorHeight, at.y - abs(along.y));
    bright *= 0.0022 / width;
    place = mote.xy;
    gl_Position = clipFromWorld * vec4(at + along * mote.y + side * mote.x, 1.0);
}
