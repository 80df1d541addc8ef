// Post-processing in daylight: exposure, shoulder curve, sRGB, and ordered dither of half a step.
uniform sampler2D scene;
uniform float exposure;
in vec2 screen;
layout (location = 0) out vec4 colour;

vec3 shoulder(vec3 x) {
    vec3 over = max(x - 0.7, 0.0);
    return min(x, 0.7) + 0.3 * (1.0 - exp(-over / 0.3));
}

vec3 srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
    vec3 c = srgb(shoulder(exposure * texture(scene, screen).rgb));
    ivec2 p = ivec2(gl_FragCoord.xy);
    int order = 8 * ((p.x ^ p.y) & 1) + 4 * (p.y & 1) + 2 * (((p.x ^ p.y) >> 1) & 1) + ((p.y >> 1) & 1);
    colour = vec4(c + ((float(order) + 0.5) / 16.0 - 0.5) / 255.0, 1.0);
}
