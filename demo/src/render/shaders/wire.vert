uniform mat4 clipFromWorld;
in vec3 position;
void main() {
    gl_Position = clipFromWorld * vec4(position, 1.0);
    gl_Position.z -= 0.0006 * gl_Position.w; // depth offset in front of the cloth
}
