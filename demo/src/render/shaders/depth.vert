uniform mat4 shadowFromWorld;
in vec3 position;
void main() {
    gl_Position = shadowFromWorld * vec4(position, 1.0);
}
