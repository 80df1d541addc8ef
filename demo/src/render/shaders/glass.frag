// Solid ball of glass: refraction of what is drawn behind it, twice at its surface, with dispersion;
// reflection of the lamps and the haze.
uniform vec3 eye;
uniform vec3 centre;
uniform float ball; // radius [m]
uniform mat4 clipFromWorld;
uniform sampler2D scene; // the picture without glass, linear
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform vec3 lowColour;
uniform vec3 highColour;
uniform float floorHeight;
uniform float dim;

centroid in vec3 at;
centroid in vec3 facing;
layout (location = 0) out vec4 colour;

// The haze of the backdrop in a direction, as in `sky.frag`.
vec3 haze(vec3 d) {
    float near = exp(-14.0 * (d.y + 0.10) * (d.y + 0.10));
    return mix(lowColour, highColour, near) + highColour * 0.7 * near * near;
}

// Light of a square lamp with soft borders, `size` across, in a direction.
float lamp(vec3 d, vec3 towards, float size) {
    vec3 side = normalize(cross(towards, vec3(0.0, 1.0, 0.0)));
    vec2 p = vec2(dot(d, side), dot(d, cross(side, towards))) / size;
    vec2 inside = smoothstep(vec2(1.0), vec2(0.8), abs(p));
    return dot(d, towards) > 0.0 ? inside.x * inside.y : 0.0;
}

vec3 lamps(vec3 d) {
    return keyColour * 1.6 * lamp(d, keyTowards, 0.27)
        + fillColour * 2.2 * lamp(d, fillTowards, 0.34)
        + rimColour * 0.9 * lamp(d, rimTowards, 0.16);
}

// What a ray sees that leaves the ball at `from`: the picture where the ray meets the floor or goes
// far, and the haze beyond the picture.
vec3 seen(vec3 from, vec3 d) {
    float far = d.y < -0.02 ? min((floorHeight - from.y) / d.y, 3.5) : 3.5;
    vec4 clip = clipFromWorld * vec4(from + d * far, 1.0);
    vec2 p = 0.5 + 0.5 * clip.xy / max(clip.w, 0.01);
    vec2 border = min(p, 1.0 - p);
    float inside = smoothstep(0.0, 0.05, min(border.x, border.y)) * step(0.01, clip.w);
    return mix(haze(d), texture(scene, clamp(p, 0.0, 1.0)).rgb, inside);
}

// Light through the ball for one index of refraction.
vec3 through(vec3 v, vec3 n, float index) {
    vec3 d = refract(v, n, 1.0 / index);
    vec3 from = at - d * (2.0 * dot(d, n) * ball);
    vec3 leaves = refract(d, (centre - from) / ball, index);
    return seen(from, leaves) + 0.6 * lamps(leaves);
}

void main() {
    vec3 n = normalize(facing);
    vec3 v = normalize(at - eye);
    float fresnel = 0.04 + 0.96 * pow(1.0 - clamp(-dot(n, v), 0.0, 1.0), 5.0);
    float lit = keyVisibility(at + n * 0.03, 1, 1.5, 0.0008);
    vec3 light = vec3(through(v, n, 1.44).r, through(v, n, 1.46).g, through(v, n, 1.48).b);
    // Slightly green where the way through the glass is long.
    light *= exp(-vec3(0.50, 0.22, 0.28) * clamp(-dot(n, v), 0.0, 1.0) * 2.0 * ball);
    vec3 mirror = reflect(v, n);
    vec3 reflected = haze(mirror) * 1.5 + lamps(mirror) * (0.15 + 0.85 * lit);
    light += fresnel * reflected;
    // Light that gathers at the rim on the far side of the lamps.
    float rim = pow(1.0 - clamp(-dot(n, v), 0.0, 1.0), 3.0);
    light += rim * 0.10 * (keyColour * lit * max(dot(n, -keyTowards), 0.0) + rimColour * max(dot(n, rimTowards), 0.0));
    colour = vec4(limited(light) * dim, 1.0);
}
