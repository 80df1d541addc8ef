// Printed paper: matt, with fibre texture, some transmission, and ink on one side.

uniform vec3 eye;
uniform vec2 span;
uniform sampler2D ink;
// Of each cell of the sheet: normal of the front, longer than one by how crumpled it is; sharpness
// of its folds.
uniform sampler2D creases;

in vec3 at;
in vec2 uv;
centroid in vec3 facing;
centroid in float loose; // 1.0 at a torn edge, 0.0 one triangle further in

layout (location = 0) out vec4 colour;

const vec3 PAPER = vec3(0.913, 0.871, 0.807); // #f5f0e8
const vec3 INK = vec3(0.030, 0.031, 0.038);

float hash(vec2 p) {
    uvec2 q = uvec2(ivec2(p)) * uvec2(1597334673u, 3812015801u);
    uint n = (q.x ^ q.y) * 1597334673u;
    n ^= n >> 15;
    n *= 2246822519u;
    return float(n >> 8) / 16777216.0;
}

float noise(vec2 p) {
    vec2 i = floor(p);
    vec2 f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    return mix(
        mix(hash(i), hash(i + vec2(1.0, 0.0)), f.x),
        mix(hash(i + vec2(0.0, 1.0)), hash(i + vec2(1.0, 1.0)), f.x),
        f.y);
}

// Fibre texture of the paper, a few tenths of a millimetre in size.
float fibreTexture(vec2 m) {
    return noise(m * 31.0) + 0.6 * noise(m.yx * 67.0 + 40.0) + 0.4 * noise(vec2(m.x * 140.0, m.y * 23.0)) - 1.0;
}

// Coverage of a pixel by paper: the upper and the lower end are cut in a sawtooth.
float paperCoverage(vec2 m, float footprint) {
    float end = min(m.y, span.y - m.y);
    float saw = 0.052 * abs(2.0 * fract(m.x / 0.104) - 1.0);
    return clamp(0.5 + (end - saw) / max(footprint, 1.0e-4), 0.0, 1.0);
}

// Scales a vector to length one, unless it is zero.
vec3 unit(vec3 a) {
    return a * inversesqrt(max(dot(a, a), 1.0e-24));
}

// Concentration of the mean shift at full sharpness: two facets stay apart from an angle of
// 2 / sqrt(CONCENTRATION) on.
const float CONCENTRATION = 60.0;

// Normal of the front: the normals of the nearest nine cells, interpolated by a quadratic B-spline,
// and moved to the nearest mode of these where the sheet is creased (mean shift with the kernel of
// von Mises and Fisher). It is as long as the paper is crumpled there, plus one.
vec3 creasedNormal() {
    ivec2 last = textureSize(creases, 0) - 1;
    vec2 place = uv * vec2(last + 1) - 0.5;
    vec2 middle = floor(place + 0.5);
    vec2 f = place - middle;
    vec2 spline[3] = vec2[3](0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f));
    vec3 normals[9];
    float weights[9];
    vec3 mean = vec3(0.0);
    float sharp = 0.0;
    float crumpled = 0.0;
    for (int i = 0; i < 9; i++) {
        ivec2 side = ivec2(i % 3, i / 3);
        vec4 cell = texelFetch(creases, clamp(ivec2(middle) + side - 1, ivec2(0), last), 0);
        float size = max(length(cell.xyz), 1.0e-6);
        normals[i] = cell.xyz / size;
        weights[i] = spline[side.x].x * spline[side.y].y;
        mean += weights[i] * normals[i];
        sharp += weights[i] * cell.w;
        crumpled += weights[i] * max(size - 1.0, 0.0);
    }
    for (int round = 0; round < 4 && sharp > 0.0; round++) {
        vec3 mode = unit(mean);
        mean = vec3(0.0);
        for (int i = 0; i < 9; i++) {
            mean += weights[i] * exp(max(CONCENTRATION * sharp * (dot(normals[i], mode) - 1.0), -18.0)) * normals[i];
        }
    }
    return unit(mean) * (1.0 + crumpled);
}

// Slope of a surface of triangles with random heights, in a grid of equilateral triangles with
// sides of `side` that is turned by `angle`.
vec2 facetSlope(vec2 m, float angle, float side) {
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    mat2 grid = mat2(1.0, 0.0, 0.57735, 1.15470) * turn;
    vec2 q = grid * m / side;
    vec2 cell = floor(q);
    vec2 f = q - cell;
    bool isLower = f.x > f.y;
    float low = hash(cell);
    float high = hash(cell + 1.0);
    float between = hash(cell + (isLower ? vec2(1.0, 0.0) : vec2(0.0, 1.0)));
    return (isLower ? vec2(between - low, high - between) : vec2(high - between, between - low)) * grid;
}

// Slope of crumpled paper: creases that are finer than the cells. Three grids of different sizes and
// angles together have irregular facets.
vec2 crumpledSlope(vec2 m) {
    return facetSlope(m, 0.4, 0.62) + facetSlope(m + 17.0, 1.35, 0.43) + 0.7 * facetSlope(m + 40.0, 2.2, 0.27);
}

void main() {
    vec2 m = uv * span;
    vec2 ux = dFdx(m);
    vec2 uy = dFdy(m);
    vec3 px = dFdx(at);
    vec3 py = dFdy(at);
    float footprint = max(length(ux), length(uy));
    float covered = paperCoverage(m, min(footprint, 0.05));

    bool front = gl_FrontFacing;
    vec3 v = normalize(eye - at);
    vec3 n = creasedNormal();
    float crumpled = max(length(n) - 1.0, 0.0);
    if (dot(n, n) < 0.5) n = facing;
    n = dot(n, n) > 1.0e-12 ? normalize(n) : v;
    // Where the facets tilt most, they lie in the creases.
    float crease = 1.0;
    if (crumpled > 0.0) {
        float flip = ux.x * uy.y - ux.y * uy.x < 0.0 ? -1.0 : 1.0;
        vec3 across = unit((px * uy.y - py * ux.y) * flip);
        vec3 along = unit((py * ux.x - px * uy.x) * flip);
        vec2 slope = 0.48 * crumpled * crumpledSlope(m);
        vec3 tilted = normalize(n - slope.x * across - slope.y * along);
        crease = mix(1.0, smoothstep(0.75, 1.0, dot(n, tilted)), 0.5 * crumpled);
        n = tilted;
    }
    if (!front) n = -n;
    float away = dot(n, v);
    if (away < 0.02) n = normalize(n + v * (0.02 - away));

    // The print; from behind it is soft and pale.
    float here = texture(ink, uv).r;
    float behind = texture(ink, uv, 2.6).r;
    float inked = front ? 0.96 * pow(here, 0.8) : 0.10 * behind;
    float fine = 1.0 - smoothstep(0.006, 0.03, footprint);
    float fibre = fibreTexture(m);
    // Thermal print is slightly uneven.
    inked *= 1.0 - fine * 0.10 * noise(m * 57.0 + 9.0);
    vec3 albedo = mix(PAPER * (1.0 + 0.022 * fine * fibre + 0.014 * (noise(m * 1.7) - 0.5)), INK, inked);
    // The cut edge is darker.
    float rim = min(min(m.x, span.x - m.x), min(m.y, span.y - m.y));
    albedo *= 1.0 - 0.10 * (1.0 - smoothstep(0.0, max(0.03, footprint), rim));

    // Bare fibres at a torn edge are brighter.
    albedo = mix(albedo, vec3(0.95, 0.93, 0.89), 0.8 * smoothstep(0.72, 1.0, loose + 0.12 * fibre));

    // The fibre texture as a bump map.
    vec3 relief = cross(py, n) * dFdx(fibre) + cross(n, px) * dFdy(fibre);
    float scale = dot(cross(px, py), n);
    vec3 rough = normalize(abs(scale) * n - 0.0012 * fine * sign(scale) * relief);

    float nl = dot(rough, keyTowards);
    float slope = sqrt(max(1.0 - nl * nl, 0.0));
    float side = nl >= 0.0 ? 1.0 : -1.0;
    float lit = keyVisibility(at + n * side * (0.014 + 0.035 * slope), 1, 2.4, 0.0002);
    float open = skyLight(at + n * 0.07, n, vec2(2.0), 2);
    open = crease * (0.30 + 0.70 * smoothstep(0.0, 1.0, open));

    vec3 light = albedo * (ambientLight(rough, open) + keyColour * lit * max(nl, 0.0));
    // The light ground reflects the key light to what faces down.
    light += albedo * keyColour * 0.40 * max(-n.y, 0.0) * open;
    // Transmitted light: warmer, and less where there is ink on either side.
    float through = max(-dot(n, keyTowards), 0.0) * lit;
    light += mix(PAPER, INK, 0.45 * max(here, behind)) * keyColour * through * vec3(0.36, 0.33, 0.28);
    // Weak specular reflection.
    vec3 h = normalize(keyTowards + v);
    light += keyColour * lit * max(nl, 0.0) * (0.035 + 0.03 * inked) * pow(max(dot(rough, h), 0.0), 14.0);
    colour = vec4(light, covered);
}
