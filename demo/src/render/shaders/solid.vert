out vec3 at;
out vec3 facing;
void main() {
    at = spot();
    facing = outward();
    gl_Position = clipFromWorld * vec4(at, 1.0);
}
