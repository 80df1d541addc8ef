// Post-processing: vignette, filmic tone curve, sRGB, and ordered dither of half a step against banding.
uniform sampler2D scene;
uniform float aspect;
uniform float exposure;
in vec2 screen;
layout (location = 0) out vec4 colour;

vec3 filmic(vec3 x) {
    x *= 0.62;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// Ordered dither in steps of 1/16 (Bayer 1973): hides banding, and compresses well as PNG.
float steps(ivec2 p) {
    ivec2 low = p & 1;
    ivec2 high = (p >> 1) & 1;
    int order = 8 * (low.x ^ low.y) + 4 * low.y + 2 * (high.x ^ high.y) + high.y;
    return (float(order) + 0.5) / 16.0;
}

void main() {
    vec3 light = texture(scene, screen).rgb * exposure;
    vec2 p = (screen - 0.5) * vec2(mix(1.0, aspect, 0.45), 1.0);
    light *= 1.0 - 0.62 * smoothstep(0.25, 0.95, length(p));
    vec3 c = srgb(filmic(light));
    // Only dark areas show banding; the texture of cloth hides it.
    float dark = 1.0 - smoothstep(0.15, 0.35, c.b);
    colour = vec4(c + dark * (steps(ivec2(gl_FragCoord.xy)) - 0.5) / 255.0, 1.0);
}
