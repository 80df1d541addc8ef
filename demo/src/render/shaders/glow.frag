uniform sampler2D halo;
uniform vec3 tint;
in vec2 uv;
layout (location = 0) out vec4 colour;
void main() {
    float h = texture(halo, uv).r;
    colour = vec4(tint * h * h, 0.0);
}
