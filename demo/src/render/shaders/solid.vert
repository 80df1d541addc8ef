uniform float mirrored; // 1.0: drawn upside down, as the polished floor shows it
uniform float floorHeight;

out vec3 at;
out vec3 facing;
void main() {
    at = spot();
    facing = outward();
    gl_Position = clipFromWorld * vec4(at.x, mix(at.y, 2.0 * floorHeight - at.y, mirrored), at.z, 1.0);
}
