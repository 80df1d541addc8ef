uniform vec3 tint;
uniform float core; // strength of the white core
in vec2 place;
layout (location = 0) out vec4 colour;
void main() {
    // A hot core in a wide skirt; the window ends it at the border.
    float r2 = dot(place, place);
    float window = max(1.0 - r2, 0.0);
    float h = 0.5 * exp(-90.0 * r2) + 0.3 * exp(-18.0 * r2) + 0.2 * exp(-4.0 * r2);
    vec3 light = tint * h + core * exp(-300.0 * r2);
    colour = vec4(light * window * window, 0.0);
}
