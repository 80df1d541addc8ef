// Woven cloth: two-sided, with anisotropic specular reflection, sheen at grazing angles and
// transmission of the key light. The parameters come from the appearance of the fabric.

uniform vec3 eye;
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform vec4 gloss;  // roughness across and along, strength, strength of reflections
uniform vec2 fibres; // strength of sheen, strength of transmission
uniform float dim;      // 1.0, less under the wireframe
uniform float mirrored; // 1.0: reflection on the floor
uniform float floorHeight;

in vec3 at;
in vec3 facing;
in vec2 uv;
in float loose; // 1.0 at a torn edge, 0.0 one triangle further in

layout (location = 0) out vec4 colour;

// Analytic environment for reflections: a graded dome with three soft lights.
vec3 studio(vec3 d) {
    vec3 dome = mix(vec3(0.010, 0.014, 0.030), vec3(0.055, 0.075, 0.150), smoothstep(-0.35, 0.95, d.y));
    float key = pow(max(dot(d, keyTowards), 0.0), 7.0);
    float fill = pow(max(dot(d, fillTowards), 0.0), 5.0);
    float rim = pow(max(dot(d, rimTowards), 0.0), 9.0);
    return dome + 0.34 * keyColour * key + 0.5 * fillColour * fill + 0.5 * rimColour * rim;
}

// Anisotropic GGX with roughness along weft and warp (Burley, "Physically Based Shading
// at Disney", 2012); visibility by Kelemen's approximation.
float satin(vec3 n, vec3 t, vec3 b, vec3 l, vec3 v, vec2 width) {
    vec3 h = normalize(l + v);
    float nh = dot(n, h);
    vec3 q = vec3(dot(t, h) / width.x, dot(b, h) / width.y, nh);
    float d = dot(q, q);
    float spread = 1.0 / (PI * width.x * width.y * d * d);
    float vh = max(dot(v, h), 0.1);
    return spread * 0.25 / (vh * vh);
}

// Sheen of loose fibres: inverted Gaussian lobe (Estevez and Kulla, 2017, simplified).
float fuzz(float nh, float nl, float nv) {
    float s2 = max(1.0 - nh * nh, 0.0);
    float spread = (2.0 + 1.0 / 0.32) * pow(s2, 0.5 / 0.32) / (2.0 * PI);
    return spread / (4.0 * (nl + nv - nl * nv) + 0.02);
}

// Normalises a vector; returns `otherwise` if it is too short, as for triangles seen edge-on.
vec3 direction(vec3 a, vec3 otherwise) {
    float length2 = dot(a, a);
    return length2 > 1.0e-20 ? a * inversesqrt(length2) : otherwise;
}

void main() {
    bool front = gl_FrontFacing != (mirrored > 0.5);
    vec3 v = normalize(eye - at);
    vec3 smoothN = direction(facing, v);
    if (!front) smoothN = -smoothN;
    // At a fold an interpolated normal may point away from the eye; it is bent back to the horizon.
    float away = dot(smoothN, v);
    if (away < 0.02) smoothN = normalize(smoothN + v * (0.02 - away));

    // Warp and weft directions from the screen derivatives of position and texture coordinates.
    vec3 px = dFdx(at);
    vec3 py = dFdy(at);
    vec2 ux = dFdx(uv);
    vec2 uy = dFdy(uv);
    float flip = ux.x * uy.y - ux.y * uy.x < 0.0 ? -1.0 : 1.0;
    vec3 t = (px * uy.y - py * ux.y) * flip;
    t = direction(t - smoothN * dot(smoothN, t), cross(smoothN, v.yzx));
    vec3 b = cross(smoothN, t);
    // Metres of cloth per pixel, and how frayed the weave is here.
    float footprint = max(length(ux * span), length(uy * span));
    float undone = smoothstep(0.35, 1.0, loose);

    vec2 tilt = weave(uv * span, footprint) * (1.0 + 1.5 * undone);
    vec3 n = normalize(smoothN + t * tilt.x + b * tilt.y);

    float hem;
    vec3 albedo = fabricColour(front, uv, footprint, hem);

    float nv = clamp(dot(n, v), 0.03, 1.0); // above one, `pow` would return NaN
    float nl = dot(n, keyTowards);
    float side = dot(smoothN, keyTowards) >= 0.0 ? 1.0 : -1.0;
    float slope = sqrt(max(1.0 - nl * nl, 0.0));
    float lit = keyVisibility(at + smoothN * side * (0.010 + 0.030 * slope), 2, 1.5, 0.0008);

    vec3 light = vec3(0.0);
    // Key light: wrapped diffuse, specular and sheen on the lit face; transmission on the other.
    float soft = max(nl, 0.0);
    // Approximate openness: points that face away from the key light or lie in shadow are occluded.
    float open = lit * smoothstep(-0.15, 0.55, nl);
    vec3 h = normalize(keyTowards + v);
    float lobe = satin(n, t, b, keyTowards, v, gloss.xy) * max(nl, 0.0);
    light += keyColour * lit * (albedo * soft / PI * 1.08 + vec3(gloss.z * (1.0 - 0.6 * undone)) * lobe);
    light += keyColour * lit * max(nl, 0.0) * (fibres.x + 0.12 * undone) * mix(vec3(1.0), normalize(albedo + 0.05) * 1.7, 0.35) * fuzz(dot(n, h), max(nl, 0.0), nv);
    float through = max(-nl, 0.0);
    through = 0.30 * through + 0.55 * pow(max(dot(-v, keyTowards), 0.0), 4.0) * step(0.0, -nl);
    light += keyColour * lit * through * (1.0 - 0.30 * hem) * albedo * fibres.y * (1.0 + 0.4 * undone) * 0.80;

    // Fill and rim light cast no shadow, so faces that point away from them get none of their light.
    float fl = max((dot(n, fillTowards) + 0.25) / 1.25, 0.0);
    light += fillColour * albedo * fl / PI * 1.6;
    float rl = max(dot(n, rimTowards), 0.0);
    light += rimColour * (albedo * rl / PI * 0.35 + 0.5 * pow(1.0 - nv, 3.0) * max(dot(smoothN, rimTowards) + 0.35, 0.0) * 0.6);
    light += rimColour * max(-dot(n, rimTowards), 0.0) * albedo * 0.07 * fibres.y;

    // Ambient light of sky and floor, and reflections of the environment.
    vec3 dome = mix(vec3(0.050, 0.054, 0.074), vec3(0.165, 0.190, 0.265), 0.5 + 0.5 * n.y);
    float hollow = 0.5 + 0.5 * open;
    light += albedo * dome * hollow * 1.05;
    float grazing = pow(1.0 - nv, 4.0);
    vec3 mirror = reflect(-v, normalize(mix(n, smoothN, 0.3)));
    light += studio(mirror) * gloss.w * (0.045 + 0.34 * grazing) * mix(0.35, 1.0, max(open, through * lit));

    float alpha = 1.0;
    if (mirrored > 0.5) alpha = 0.75 * exp(-1.9 * max(at.y - floorHeight, 0.0));
    colour = vec4(clamp(light, 0.0, 16.0) * dim, alpha);
}
