// Dark, polished floor: a pool of key light with a shadow that hardens towards its caster (PCSS),
// light of the other lamps, and a blurred reflection of the halos.

uniform vec3 eye;
uniform vec3 centre;
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform sampler2D depths;  // coarse depth map of the key light
uniform float depthRange;  // depth of its volume [m]
uniform float radius;      // half the width of its volume [m]
uniform int haloCount;
uniform vec4 halos[6];     // centre [m] and radius [m]
uniform vec3 haloTints[6];
uniform int footCount;
uniform vec3 feet[8];      // x, z and radius of solids that stand on the floor [m]
uniform int glassCount;
uniform vec4 glass[6];     // centre [m] and radius [m] of balls of glass
in vec3 at;
layout (location = 0) out vec4 colour;

const float LAMP = 0.10; // width of the penumbra per metre from the caster

// Mean distance from the casters of the key light [m]; 0 if there are none.
float casterDistance(vec3 s) {
    // Beyond the map nothing is cast.
    if (any(lessThan(s.xy, vec2(0.0))) || any(greaterThan(s.xy, vec2(1.0)))) return 0.0;
    float sum = 0.0;
    float count = 0.0;
    vec2 towards = 0.14 / radius * noiseDirection();
    for (int i = 0; i < 16; i++) {
        float d = texture(depths, s.xy + sqrt((float(i) + 0.5) / 16.0) * towards).r;
        towards = GOLDEN * towards;
        if (d < s.z - 0.001) {
            sum += s.z - d;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count * depthRange : 0.0;
}

void main() {
    vec2 p = at.xz - centre.xz;
    float r2 = dot(p, p);
    float fade = 1.0 - smoothstep(1.8, 7.5, sqrt(r2));
    if (fade <= 0.0) discard;
    vec3 v = normalize(eye - at);
    vec3 s = (shadowFromWorld * vec4(at, 1.0)).xyz * 0.5 + 0.5;
    float lit = 1.0;
    float away = casterDistance(s);
    if (away > 0.0) lit = softVisibility(s, clamp(LAMP * away, 0.012, 0.34) * 0.5 / radius, 0.0010);
    // Solids that stand on the floor darken it around their feet.
    float contact = 1.0;
    for (int i = 0; i < footCount; i++) {
        float far = max(length(at.xz - feet[i].xy) - feet[i].z, 0.0);
        contact *= 1.0 - 0.75 * exp(-far / (0.03 + 0.25 * feet[i].z));
    }
    // A ball of glass keeps light from its surroundings, and gathers it behind its middle.
    float gathered = 0.0;
    for (int i = 0; i < glassCount; i++) {
        vec2 off = at.xz - glass[i].xz;
        contact *= 1.0 - 0.6 * exp(-dot(off, off) * 7.0 / (glass[i].w * glass[i].w));
        // The shadow is an ellipse, longer along the light; so is what shines through it.
        vec3 axis = cross(at - glass[i].xyz, keyTowards) / glass[i].w;
        float q = dot(axis, axis);
        float inside = smoothstep(1.06, 0.90, q);
        lit *= 1.0 - 0.55 * inside;
        gathered += inside * (2.6 * exp(-q * 16.0) + 0.35 * smoothstep(0.45, 0.95, q)) * lit;
    }
    float pool = exp(-0.16 * r2);
    vec3 albedo = vec3(0.066, 0.070, 0.092);
    vec3 light = albedo * keyColour * keyTowards.y * pool * 0.80 * (0.04 + 0.96 * lit + gathered);
    light += albedo * fillColour * 0.45 * exp(-0.30 * dot(p - vec2(0.9, 0.5), p - vec2(0.9, 0.5)));
    light += albedo * rimColour * 0.13 * exp(-0.35 * dot(p - vec2(1.7, -1.2), p - vec2(1.7, -1.2)));
    light += albedo * vec3(0.10, 0.13, 0.30) * (0.3 + 0.7 * pool) * (0.7 + 0.3 * lit);
    light *= contact;
    // Reflections: a long streak of the rim light, and the halos.
    vec3 mirror = reflect(-v, vec3(0.0, 1.0, 0.0));
    float fresnel = 0.06 + 0.94 * pow(1.0 - clamp(v.y, 0.0, 1.0), 5.0);
    light += rimColour * pow(max(dot(mirror, rimTowards), 0.0), 14.0) * 0.04 * pool;
    for (int i = 0; i < haloCount; i++) {
        vec3 to = halos[i].xyz - at;
        vec3 off = to - mirror * max(dot(to, mirror), 0.0);
        light += haloTints[i] * exp(-dot(off, off) * 5.0 / (halos[i].w * halos[i].w)) * (0.2 + 0.8 * fresnel) * 0.55;
    }
    float cover = fade * mix(0.86, 0.55, fresnel);
    colour = vec4(light, cover);
}
