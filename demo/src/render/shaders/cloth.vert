uniform mat4 clipFromWorld;
uniform float mirrored; // 1.0: reflection on the floor, drawn below it
uniform float floorHeight;

in vec3 position;
in vec3 normal;
in vec2 texcoord;
in float frayed;
in float hollow;

out vec3 at;
out vec2 uv;
// At a silhouette these must not be extrapolated beyond the triangle.
centroid out vec3 facing;
centroid out float loose;
centroid out float depth;

void main() {
    at = position;
    facing = normal;
    uv = texcoord;
    loose = frayed;
    depth = hollow;
    gl_Position = clipFromWorld * vec4(position.x, mix(position.y, 2.0 * floorHeight - position.y, mirrored), position.z, 1.0);
}
