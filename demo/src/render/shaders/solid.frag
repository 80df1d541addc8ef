// Lacquered solid: diffuse reflection with a soft specular lobe.
uniform vec3 eye;
uniform vec3 albedo;
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform float dim;
uniform float mirrored;
uniform float floorHeight;

centroid in vec3 at;
centroid in vec3 facing;
in float thinness;
layout (location = 0) out vec4 colour;

float lobe(vec3 n, vec3 v, vec3 l, float sharp) {
    return pow(max(dot(n, normalize(l + v)), 0.0), sharp) * max(dot(n, l), 0.0);
}

void main() {
    vec3 v = normalize(eye - at);
    // Normals that turn away within a pixel would give each one another colour.
    vec3 n = normalize(mix(normalize(facing), v, clamp(thinness, 0.0, 1.0)));
    float nl = max(dot(n, keyTowards), 0.0);
    float slope = sqrt(max(1.0 - nl * nl, 0.0));
    float lit = keyVisibility(at + n * (0.012 + 0.03 * slope), 2, 1.5, 0.0008);
    // Where a rod is a few pixels wide, its bright edge is narrower than one: the mean over the pixel.
    float nv = dot(n, v);
    float fresnel = 0.05 + 0.6 * pow(1.0 - clamp(nv + 0.5 * fwidth(nv), 0.0, 1.0), 5.0);
    vec3 light = keyColour * lit * (albedo * nl * 0.30 + vec3(1.0, 0.97, 0.9) * lobe(n, v, keyTowards, 60.0) * 0.55);
    light += fillColour * (albedo * max(dot(n, fillTowards), 0.0) * 0.5 + 0.4 * lobe(n, v, fillTowards, 30.0));
    light += rimColour * (albedo * max(dot(n, rimTowards), 0.0) * 0.18 + 0.5 * lobe(n, v, rimTowards, 40.0) + 0.35 * fresnel * max(dot(n, rimTowards) + 0.2, 0.0));
    vec3 dome = mix(vec3(0.030, 0.034, 0.054), vec3(0.145, 0.170, 0.255), 0.5 + 0.5 * n.y);
    light += dome * (albedo * 0.6 + fresnel * 0.5);
    // The reflection fades with height over the floor.
    float cover = mirrored > 0.5 ? 0.75 * exp(-1.9 * max(at.y - floorHeight, 0.0)) : 1.0;
    cover /= max(thinness, 1.0);
    colour = vec4(limited(light) * dim, cover);
}
