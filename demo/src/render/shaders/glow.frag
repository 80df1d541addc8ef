uniform vec3 tint;
uniform float core; // strength of the white core
in vec2 place;
layout (location = 0) out vec4 colour;
void main() {
    // A hot core in a wide skirt; the window ends it at the border.
    float r2 = dot(place, place);
    float window = max(1.0 - r2, 0.0);
    float skirt = exp(-4.0 * r2);
    float middle = skirt * skirt * skirt * skirt;
    float hot = middle * middle * middle * middle * middle * middle;
    vec3 light = tint * (0.5 * hot + 0.3 * middle + 0.2 * skirt) + core * hot * hot * hot;
    colour = vec4(light * window * window, 0.0);
}
