uniform float mirrored; // 1.0: reflection on the floor, drawn below it
uniform float floorHeight;

out vec3 at;
out vec3 facing;
void main() {
    at = surfacePosition();
    facing = outward();
    gl_Position = clipFromWorld * vec4(at.x, mix(at.y, 2.0 * floorHeight - at.y, mirrored), at.z, 1.0);
}
