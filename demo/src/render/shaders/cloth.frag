// Woven cloth: two-sided, with anisotropic specular reflection (GGX), sheen at grazing angles,
// transmittance, and occlusion in folds. The parameters come from the appearance of the fabric.

uniform vec3 eye;
uniform vec3 fillTowards;
uniform vec3 fillColour;
uniform vec3 rimTowards;
uniform vec3 rimColour;
uniform mat4 rimFromWorld;
uniform sampler2DShadow rimMap;
uniform vec4 gloss;  // roughness across and along, strength, strength of reflections
uniform vec2 fibres; // strength of sheen, transmittance
uniform float dim;      // 1.0, less under the wireframe
uniform float mirrored; // 1.0: reflection on the floor
uniform float floorHeight;

in vec3 at;
in vec2 uv;
centroid in vec3 facing;
centroid in float loose; // 1.0 at a torn edge, 0.0 one triangle further in
centroid in float depth; // in a fold of the front [m]; below zero on a ridge

layout (location = 0) out vec4 colour;

// Analytic environment for reflections: a dark dome with three soft boxes.
vec3 studio(vec3 d) {
    vec3 dome = mix(vec3(0.008, 0.010, 0.022), vec3(0.035, 0.050, 0.120), smoothstep(-0.35, 0.95, d.y));
    float key = pow(max(dot(d, keyTowards), 0.0), 9.0);
    float fill = pow(max(dot(d, fillTowards), 0.0), 5.0);
    float rim = pow(max(dot(d, rimTowards), 0.0), 9.0);
    return dome + 0.30 * keyColour * key + 0.6 * fillColour * fill + 0.5 * rimColour * rim;
}

// Anisotropic GGX with roughness along weft and warp (Burley, "Physically Based Shading
// at Disney", 2012); visibility by Kelemen's approximation.
float satin(vec3 n, vec3 t, vec3 b, vec3 l, vec3 v, vec2 width) {
    vec3 h = normalize(l + v);
    vec3 q = vec3(dot(t, h) / width.x, dot(b, h) / width.y, dot(n, h));
    float d = dot(q, q);
    float spread = 1.0 / (PI * width.x * width.y * d * d);
    float vh = max(dot(v, h), 0.1);
    return spread * 0.25 / (vh * vh) * max(dot(n, l), 0.0);
}

// Sheen of loose fibres: inverted Gaussian lobe (Estevez and Kulla, 2017, simplified).
float fuzz(float nh, float nl, float nv) {
    float s2 = max(1.0 - nh * nh, 0.0);
    float spread = (2.0 + 1.0 / 0.32) * pow(s2, 0.5 / 0.32) / (2.0 * PI);
    return spread / (4.0 * (nl + nv - nl * nv) + 0.02);
}

// Visibility of the rim light, by four taps.
float rimVisibility(vec3 place) {
    vec3 s = (rimFromWorld * vec4(place, 1.0)).xyz * 0.5 + 0.5;
    float texel = 0.75 / float(textureSize(rimMap, 0).x);
    float lit = 0.0;
    for (int i = 0; i < 4; i++) {
        vec2 o = texel * vec2(i % 2 == 0 ? 1.0 : -1.0, i < 2 ? 1.0 : -1.0);
        lit += texture(rimMap, vec3(s.xy + o, s.z - 0.0020));
    }
    return 0.25 * lit;
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

    float unseen;
    vec2 tilt = weave(uv * span, footprint, unseen) * (1.0 + 1.5 * undone);
    vec3 n = normalize(smoothN + t * tilt.x + b * tilt.y);
    // Threads finer than a pixel widen the highlight instead (Toksvig, 2005).
    vec2 width = sqrt(gloss.xy * gloss.xy + unseen);

    float hem;
    vec3 albedo = fabricColour(front, uv, footprint, hem);

    float nv = clamp(dot(n, v), 0.03, 1.0); // above one, `pow` would return NaN
    float nl = dot(n, keyTowards);
    float side = dot(smoothN, keyTowards) >= 0.0 ? 1.0 : -1.0;
    float slope = sqrt(max(1.0 - nl * nl, 0.0));
    float lit = keyVisibility(at + smoothN * side * (0.006 + 0.022 * slope), 2, 1.5, 0.0006);

    // Occlusion in folds, with the light that the cloth reflects to itself (Jimenez et al., 2016).
    float fold = front ? depth : -depth;
    float open = exp(-max(fold, 0.0) / 0.020);
    vec3 openTint = open / (1.0 - albedo * (1.0 - open));
    float ridge = clamp(-fold / 0.030, 0.0, 1.0);
    // Denim is worn on its ridges.
    if (cloth.w == 1.0) albedo = mix(albedo, vec3(0.40, 0.46, 0.56), 0.18 * ridge);

    vec3 light = vec3(0.0);
    // Key light: diffuse, two specular lobes and sheen on the lit face; transmission on the other.
    vec3 key = keyColour * lit * mix(0.45, 1.0, open);
    vec3 h = normalize(keyTowards + v);
    vec3 thread = albedo / max(max(albedo.r, albedo.g), max(albedo.b, 0.02));
    float sharp = satin(n, t, b, keyTowards, v, width);
    float broad = satin(n, t, b, keyTowards, v, min(2.6 * width, 0.9));
    float shine = gloss.z * (1.0 - 0.6 * undone);
    light += key * albedo * max(nl, 0.0) / PI;
    light += key * shine * (sharp * mix(vec3(1.0), thread, 0.25) + 0.5 * broad * thread);
    light += key * max(nl, 0.0) * (fibres.x + 0.12 * undone) * mix(vec3(1.0), thread, 0.5) * fuzz(dot(n, h), max(nl, 0.0), nv);
    // Light through the cloth is dyed by it, and more so where it passes at a slant (Beer-Lambert).
    float slant = 1.0 / clamp(-nl, 0.25, 1.0);
    vec3 tint = fibres.y * (1.0 + 0.4 * undone) * (1.0 - 0.35 * hem) * pow(albedo, vec3(0.8 + slant));
    float through = 0.44 * max(-nl, 0.0) + 0.9 * pow(max(dot(-v, keyTowards), 0.0), 4.0) * step(0.0, -nl);
    light += keyColour * lit * through * tint * mix(0.25, 1.0, open);

    // The fill light casts no shadow; folds occlude it.
    float fl = max((dot(n, fillTowards) + 0.25) / 1.25, 0.0);
    light += fillColour * openTint * (albedo * fl / PI + 0.5 * shine * thread * satin(n, t, b, fillTowards, v, min(1.6 * width, 0.9)));
    float rl = dot(n, rimTowards);
    vec3 rim = rimColour * rimVisibility(at + smoothN * (dot(smoothN, rimTowards) >= 0.0 ? 0.03 : -0.03));
    float edge = pow(1.0 - nv, 3.0);
    light += rim * (albedo * max(rl, 0.0) / PI * 0.16 * open + min(0.15 + 0.25 * gloss.w, 0.45) * edge * smoothstep(-0.2, 0.6, rl));
    light += rim * open * 1.2 * shine * mix(vec3(1.0), thread, 0.25) * satin(n, t, b, rimTowards, v, 1.2 * width);
    light += rim * 0.12 * max(-rl, 0.0) * fibres.y * albedo * albedo;

    // Hemisphere light of sky and floor, and reflections of the environment.
    vec3 dome = mix(vec3(0.050, 0.046, 0.066), vec3(0.105, 0.130, 0.235), 0.5 + 0.5 * n.y);
    // The room behind the stage is blue.
    dome += vec3(0.040, 0.085, 0.165) * max(-n.z, 0.0);
    light += albedo * dome * openTint * (1.0 + 0.3 * ridge);
    vec3 mirror = reflect(-v, normalize(mix(n, smoothN, 0.3)));
    light += studio(mirror) * gloss.w * (0.05 + 0.40 * pow(1.0 - nv, 4.0)) * open;

    float alpha = 1.0;
    if (mirrored > 0.5) alpha = 0.75 * exp(-1.9 * max(at.y - floorHeight, 0.0));
    colour = vec4(limited(light) * dim, alpha);
}
