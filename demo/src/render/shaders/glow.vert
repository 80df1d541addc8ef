uniform mat4 clipFromWorld;
uniform vec3 centre;
uniform vec3 right;
uniform vec3 up;
in vec2 corner;
out vec2 place;
void main() {
    place = corner;
    gl_Position = clipFromWorld * vec4(centre + right * corner.x + up * corner.y, 1.0);
}
