// How a fabric is woven, printed and hemmed. `m` is the place in the weave in metres, `footprint`
// how many of them a pixel covers.

uniform vec2 span;
uniform vec4 cloth; // threads a metre, relief, slub, weave: 0 plain, 1 twill, 2 ripstop
uniform vec3 frontAlbedo;
uniform vec3 backAlbedo;
uniform vec3 seamAlbedo;
uniform float seamCover;
uniform float printed;
uniform float roundHem; // 1.0: a disc, whose hem is a circle

const float PI = 3.14159265;

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

// Tilts of the surface along weft and warp: the threads pass over and under each other, and no
// thread is evenly thick. All of it fades before it could flicker.
vec2 weave(vec2 m, float footprint) {
    vec2 t = m * cloth.x;
    float near = 1.0 - smoothstep(0.24, 0.56, footprint * cloth.x);
    vec2 bump = vec2(0.0);
    if (near > 0.0) {
        if (cloth.w == 1.0) {
            // Each weft thread passes one warp thread further along: ridges run up to the right.
            float ridge = t.x + t.y;
            bump = near * cloth.y * (0.75 * cos(PI * ridge) * vec2(1.0)
                 + 0.35 * vec2(cos(2.0 * PI * t.x) * sin(PI * t.y), 0.0));
        } else {
            float over = sin(PI * t.x) * sin(PI * t.y);
            bump = near * cloth.y * (vec2(cos(PI * t.x) * sin(PI * t.y), sin(PI * t.x) * cos(PI * t.y))
                 + 0.27 * over * vec2(sin(2.0 * PI * t.x), sin(2.0 * PI * t.y)));
        }
    }
    if (cloth.w == 2.0) {
        // A stouter thread every 9 mm, both ways.
        float fine = 1.0 - smoothstep(0.0015, 0.0045, footprint);
        vec2 cell = fract(m / 0.009) - 0.5;
        bump += fine * 0.25 * cell * exp(-cell * cell * 160.0) * 12.0;
    }
    float fine = 1.0 - smoothstep(0.2, 0.7, footprint * 65.0);
    vec2 slub = vec2(
        noise(vec2(m.x * 65.0, m.y * 2.5)) - 0.5,
        noise(vec2(m.x * 2.0 + 71.0, m.y * 65.0)) - 0.5);
    return bump + fine * cloth.z * slub;
}

// A softened step that is as wide as a pixel.
float over(float edge, float x, float footprint) {
    return smoothstep(edge - footprint, edge + footprint, x);
}

// Three waves, and a ring at the hoist.
vec3 flag(vec2 p, float footprint) {
    vec3 night = vec3(0.022, 0.052, 0.235);
    vec3 ivory = frontAlbedo;
    vec3 coral = vec3(0.86, 0.135, 0.055);
    float swing = 0.035 * sin(2.0 * PI * (1.25 * p.x + 0.1));
    float w = footprint / span.y;
    vec3 c = mix(night, ivory, over(0.40 + swing, p.y, w));
    c = mix(c, coral, over(0.62 + swing, p.y, w));
    vec2 q = (p - vec2(0.21, 0.20)) * span / span.y;
    float ring = abs(length(q) - 0.085);
    c = mix(ivory, c, over(0.026, ring, w));
    return c;
}

// The colour of a face, hem and seam included. `hem` says how much of a hem it is.
vec3 dyed(bool front, vec2 uv, float footprint, out float hem) {
    vec2 m = uv * span;
    vec3 c = front ? frontAlbedo : backAlbedo;
    // The weave counts upwards, a flag is read downwards.
    if (printed > 0.5) c = flag(vec2(uv.x, 1.0 - uv.y), footprint);
    if (cloth.w == 1.0) {
        // Indigo takes unevenly along the warp, and the white weft shows between the ridges.
        float streak = noise(vec2(m.x * 210.0, m.y * 3.0)) - 0.5;
        float fade = noise(m * 2.6 + 11.0) - 0.5;
        c *= 1.0 + 0.30 * streak * (1.0 - smoothstep(0.002, 0.02, footprint)) + 0.22 * fade;
        float near = 1.0 - smoothstep(0.24, 0.56, footprint * cloth.x);
        float ridge = 0.5 + 0.5 * sin(PI * (m.x + m.y) * cloth.x);
        vec3 white = vec3(0.50, 0.54, 0.62);
        c = mix(c, front ? white : frontAlbedo, near * 0.34 * (1.0 - ridge));
    } else if (printed < 0.5) {
        float fine = 1.0 - smoothstep(0.2, 0.7, footprint * 65.0);
        c *= 1.0 + fine * cloth.z * (noise(vec2(m.x * 65.0, m.y * 2.5)) + noise(vec2(m.x * 2.0 + 71.0, m.y * 65.0)) - 1.0);
    }
    // A hem: folded over twice, so a little deeper in colour and lighter-tight, with a seam.
    vec2 inside = min(m, span - m);
    float edge = min(inside.x, inside.y);
    vec2 spoke = m - 0.5 * span;
    if (roundHem > 0.5) edge = 0.5 * span.x - length(spoke);
    hem = 1.0 - smoothstep(0.025, 0.025 + max(footprint, 0.0008), edge);
    c *= 1.0 - 0.07 * hem;
    float seam = 1.0 - smoothstep(0.0, 0.0016 + 0.7 * footprint, abs(edge - 0.0225));
    if (cloth.w == 1.0) {
        // Topstitching comes in pairs, stitch by stitch.
        seam = max(seam, 1.0 - smoothstep(0.0, 0.0016 + 0.7 * footprint, abs(edge - 0.0125)));
        float run = (inside.x < inside.y ? m.y : m.x) / 0.011;
        if (roundHem > 0.5) run = atan(spoke.y, spoke.x) * 0.5 * span.x / 0.011;
        float gap = smoothstep(0.30, 0.42, abs(fract(run) - 0.5));
        seam *= 1.0 - gap * (1.0 - smoothstep(0.15, 0.6, footprint / 0.011));
    }
    return mix(c, seamAlbedo, seam * seamCover * clamp(0.0040 / max(footprint, 0.0016), 0.5, 1.0));
}
