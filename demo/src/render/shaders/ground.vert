uniform mat4 clipFromWorld;
uniform float reach;
uniform float floorHeight;
in vec2 corner;
out vec3 at;
void main() {
    at = vec3(corner.x * reach, floorHeight, corner.y * reach);
    gl_Position = clipFromWorld * vec4(at, 1.0);
}
