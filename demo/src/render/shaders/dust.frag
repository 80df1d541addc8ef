uniform vec3 keyColour;
in vec2 place;
in float glint;
layout (location = 0) out vec4 colour;
void main() {
    colour = vec4(keyColour * 0.08 * glint * smoothstep(1.0, 0.0, length(place)), 0.0);
}
