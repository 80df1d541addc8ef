// Weave, print and hem of a fabric. `m` is a position in texture space in metres, `footprint` the
// metres of cloth per pixel.

uniform vec2 span;
uniform vec4 cloth; // threads per metre, relief, slub, weave: 0 plain, 1 twill, 2 ripstop
uniform vec3 frontAlbedo;
uniform vec3 backAlbedo;
uniform vec3 seamAlbedo;
uniform float seamCover;
uniform float printed; // 0 nothing, 1 the flag, 2 stripes, 3 two bands above the hem
uniform float roundHem; // 1.0: a disc with a circular hem

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

// Bump of the surface along weft and warp: crossing threads, and uneven yarn (slub). Both fade out
// before they alias; `unseen` returns the variance of the slopes that have faded.
vec2 weave(vec2 m, float footprint, out float unseen) {
    vec2 t = m * cloth.x;
    float near = 1.0 - smoothstep(0.18, 0.42, footprint * cloth.x);
    unseen = 0.25 * cloth.y * cloth.y * (1.0 - near);
    vec2 bump = vec2(0.0);
    if (near > 0.0) {
        if (cloth.w == 1.0) {
            // In twill each weft thread is shifted by one warp thread: diagonal ridges to the upper right.
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
        // Ripstop: a thicker thread every 9 mm in both directions.
        float fine = 1.0 - smoothstep(0.0015, 0.0045, footprint);
        vec2 cell = fract(m / 0.009) - 0.5;
        bump += fine * 0.25 * cell * exp(-cell * cell * 160.0) * 12.0;
    }
    float fine = 1.0 - smoothstep(0.05, 0.25, footprint * 65.0);
    vec2 slub = vec2(
        noise(vec2(m.x * 65.0, m.y * 2.5)) - 0.5,
        noise(vec2(m.x * 2.0 + 71.0, m.y * 65.0)) - 0.5);
    return bump + fine * cloth.z * slub;
}

// Step that is smoothed over the width of a pixel.
float smoothedStep(float edge, float x, float footprint) {
    return smoothstep(edge - footprint, edge + footprint, x);
}

// Print of the flag: three waves, and a ring at the hoist.
vec3 flag(vec2 p, float footprint) {
    vec3 night = vec3(0.022, 0.052, 0.235);
    vec3 ivory = frontAlbedo;
    vec3 coral = vec3(0.86, 0.135, 0.055);
    float swing = 0.035 * sin(2.0 * PI * (1.25 * p.x + 0.1));
    float w = footprint / span.y;
    vec3 c = mix(night, ivory, smoothedStep(0.40 + swing, p.y, w));
    c = mix(c, coral, smoothedStep(0.62 + swing, p.y, w));
    vec2 q = (p - vec2(0.21, 0.20)) * span / span.y;
    float ring = abs(length(q) - 0.085);
    c = mix(ivory, c, smoothedStep(0.026, ring, w));
    return c;
}

// Weight of a stripe of this half width, at a distance from its middle.
float stripe(float from, float halfWidth, float footprint) {
    return smoothstep(halfWidth + footprint, halfWidth - footprint, from);
}

// Colour of a face, with hem and seam. `hem` returns the weight of the hem.
vec3 fabricColour(bool front, vec2 uv, float footprint, out float hem) {
    vec2 m = uv * span;
    vec3 c = front ? frontAlbedo : backAlbedo;
    // Texture coordinates count upwards, but the flag is defined from the top.
    if (printed == 1.0) c = flag(vec2(uv.x, 1.0 - uv.y), footprint);
    if (cloth.w == 1.0) {
        // Denim: uneven indigo along the warp, and white weft between the ridges.
        float streak = noise(vec2(m.x * 210.0, m.y * 3.0)) - 0.5;
        float fade = noise(m * 2.6 + 11.0) - 0.5;
        c *= 1.0 + (front ? 0.40 : 0.16) * streak * (1.0 - smoothstep(0.003, 0.02, footprint)) + 0.34 * fade;
        float near = 1.0 - smoothstep(0.18, 0.42, footprint * cloth.x);
        float ridge = 0.5 + 0.5 * sin(PI * (m.x + m.y) * cloth.x);
        vec3 white = vec3(0.50, 0.54, 0.62);
        c = mix(c, front ? white : frontAlbedo, near * 0.34 * (1.0 - ridge));
    } else if (printed != 1.0) {
        float fine = 1.0 - smoothstep(0.2, 0.7, footprint * 65.0);
        c *= 1.0 + fine * cloth.z * (noise(vec2(m.x * 65.0, m.y * 2.5)) + noise(vec2(m.x * 2.0 + 71.0, m.y * 65.0)) - 1.0);
    }
    if (printed == 2.0) c = mix(c, seamAlbedo, stripe(abs(fract(m.y / 0.034) - 0.5) * 0.034, 0.0055, footprint));
    if (printed == 3.0) {
        c = mix(c, seamAlbedo, stripe(abs(m.y - 0.052), 0.011, footprint));
        c = mix(c, seamAlbedo, stripe(abs(m.y - 0.078), 0.004, footprint));
    }
    // Hem: folded twice, so its colour is deeper and less light passes; with a seam.
    vec2 inside = min(m, span - m);
    float edge = min(inside.x, inside.y);
    vec2 fromCentre = m - 0.5 * span;
    if (roundHem > 0.5) edge = 0.5 * span.x - length(fromCentre);
    hem = 1.0 - smoothstep(0.025, 0.025 + max(footprint, 0.0008), edge);
    c *= 1.0 - 0.07 * hem;
    float seam = 1.0 - smoothstep(0.0, 0.0016 + 0.7 * footprint, abs(edge - 0.0225));
    if (cloth.w == 1.0) {
        // Topstitching: two seams of separate stitches.
        seam = max(seam, 1.0 - smoothstep(0.0, 0.0016 + 0.7 * footprint, abs(edge - 0.0125)));
        float run = (inside.x < inside.y ? m.y : m.x) / 0.011;
        if (roundHem > 0.5) run = atan(fromCentre.y, fromCentre.x) * 0.5 * span.x / 0.011;
        float gap = smoothstep(0.30, 0.42, abs(fract(run) - 0.5));
        seam *= 1.0 - gap * (1.0 - smoothstep(0.15, 0.6, footprint / 0.011));
    }
    return mix(c, seamAlbedo, seam * seamCover * clamp(0.0040 / max(footprint, 0.0016), 0.5, 1.0));
}
