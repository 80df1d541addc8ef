in vec2 place;
in float bright;
layout (location = 0) out vec4 colour;
void main() {
    float soft = (1.0 - place.x * place.x) * smoothstep(1.0, 0.3, abs(place.y));
    colour = vec4(vec3(0.12, 0.145, 0.20) * bright * soft, 0.0);
}
