// From light to pixels: vignette, filmic curve, sRGB, and half a step of noise against banding.
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

float grain(vec2 p) {
    return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); // Jimenez 2014
}

void main() {
    vec3 light = texture(scene, screen).rgb * exposure;
    vec2 p = (screen - 0.5) * vec2(mix(1.0, aspect, 0.45), 1.0);
    light *= 1.0 - 0.62 * smoothstep(0.25, 0.95, length(p));
    vec3 c = srgb(filmic(light));
    vec2 g = gl_FragCoord.xy;
    vec3 n = vec3(grain(g), grain(g + 17.0), grain(g + 43.0)) - 0.5;
    colour = vec4(c + n / 255.0, 1.0);
}
