// Shading of a thread: brightest across the light direction, from both sides (after Kajiya and
// Kay, "Rendering fur with three dimensional textures", 1989), and brighter against the light.
uniform vec3 eye;
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform vec3 warp;
uniform vec3 weft;
uniform float dim;

in vec3 at;
in vec3 along;
in vec3 facing;
in vec4 look;

layout (location = 0) out vec4 colour;

float across(vec3 t, vec3 l) {
    float c = dot(t, l);
    return sqrt(max(1.0 - c * c, 0.0));
}

void main() {
    vec3 t = normalize(along + vec3(0.0, 1.0e-7, 0.0));
    vec3 v = normalize(eye - at);
    vec3 albedo = mix(weft, warp, step(0.5, look.x)) * mix(0.72, 1.12, look.y);
    // The shadow map is read a little towards the light, outside the shadow of the edge itself.
    float lit = keyVisibility(at + keyTowards * 0.018, 1, 1.2, 0.0010);
    float against = pow(max(dot(-v, keyTowards), 0.0), 3.0);
    vec3 light = keyColour * lit * albedo * across(t, keyTowards) * (0.24 + 0.5 * against);
    float glint = pow(across(t, normalize(keyTowards + v)), 40.0);
    light += keyColour * lit * glint * 0.05;
    light += fillColour * albedo * across(t, fillTowards) * 0.35;
    float back = pow(max(dot(-v, rimTowards), 0.0), 2.0);
    light += rimColour * albedo * across(t, rimTowards) * (0.05 + 0.30 * back);
    light += albedo * mix(vec3(0.050, 0.054, 0.074), vec3(0.165, 0.190, 0.265), 0.5 + 0.5 * abs(facing.y)) * 0.75;
    colour = vec4(limited(light) * dim, look.z);
}
