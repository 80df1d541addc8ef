// Dark, slightly polished floor with a pool of key light and the shadow of the cloth.

uniform vec3 eye;
uniform vec3 centre;
uniform vec3 rimTowards;
uniform vec3 rimColour;
in vec3 at;
layout (location = 0) out vec4 colour;

void main() {
    vec3 v = normalize(eye - at);
    // Distance along the light from the plane of the sheet: the longer it is, the softer the shadow.
    float distanceToSheet = max((centre.z - at.z) / keyTowards.z, 0.0);
    float lit = keyVisibility(at + vec3(0.0, 0.004, 0.0), 3, clamp(0.35 + 0.55 * distanceToSheet, 0.5, 2.2), 0.0020);
    float r = length(at.xz - centre.xz);
    float pool = exp(-r * r * 0.115);
    vec3 albedo = vec3(0.062, 0.068, 0.098);
    vec3 light = albedo * keyColour * keyTowards.y * lit * pool * 0.62;
    light += albedo * vec3(0.16, 0.21, 0.42) * (0.35 + 0.65 * pool) * (0.6 + 0.4 * lit);
    // The polish reflects the rim light as a long warm streak.
    float streak = pow(max(dot(reflect(-v, vec3(0.0, 1.0, 0.0)), rimTowards), 0.0), 14.0);
    light += rimColour * streak * 0.05 * pool;
    float fresnel = pow(1.0 - clamp(v.y, 0.0, 1.0), 5.0);
    float fade = 1.0 - smoothstep(1.6, 6.2, r);
    float cover = fade * mix(0.82, 0.55, fresnel);
    colour = vec4(light, cover);
}
