uniform vec3 lowColour;
uniform vec3 highColour;
uniform float aspect;
in vec2 screen;
layout (location = 0) out vec4 colour;
void main() {
    // Soft light behind the cloth, centred above the middle of the screen.
    vec2 p = (screen - vec2(0.5, 0.60)) * vec2(min(aspect, 1.6), 1.0);
    float halo = exp(-dot(p, p) * 4.2);
    float rise = smoothstep(0.0, 1.0, screen.y);
    vec3 base = mix(lowColour, highColour, 0.25 + 0.55 * rise);
    colour = vec4(mix(base, highColour * 1.9, 0.75 * halo), 1.0);
}
