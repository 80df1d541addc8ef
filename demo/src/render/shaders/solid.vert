uniform float mirrored; // 1.0: reflection on the floor, drawn below it
uniform float floorHeight;

// Sampled inside the solid: outside of it, they would light up single pixels of the silhouette.
centroid out vec3 at;
centroid out vec3 facing;
out float thinness; // least radius over the radius; above 1.0 it is drawn wider than it is
void main() {
    at = surfacePosition();
    facing = outward();
    thinness = leastRadius * distanceToEnd() / radius;
    gl_Position = clipFromWorld * vec4(at.x, mix(at.y, 2.0 * floorHeight - at.y, mirrored), at.z, 1.0);
}
