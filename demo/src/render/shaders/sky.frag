uniform vec3 lowColour;
uniform vec3 highColour;
uniform vec3 forward;
uniform vec3 across; // to the right border of the screen at a distance of one
uniform vec3 upward; // to the upper border
uniform vec2 shift;   // lens shift
in vec2 screen;
layout (location = 0) out vec4 colour;
void main() {
    vec2 p = 2.0 * screen - 1.0 - shift;
    vec3 d = normalize(forward + across * p.x + upward * p.y);
    // Haze over the horizon, which the floor fades into; dark above and below.
    float haze = exp(-14.0 * (d.y + 0.10) * (d.y + 0.10));
    vec3 base = mix(lowColour, highColour, haze);
    colour = vec4(base + highColour * 0.7 * haze * haze, 1.0);
}
