// Capsule or cylinder from a mesh of two hemispheres. Below zero, `bevel` means round ends.
uniform mat4 clipFromWorld;
uniform vec3 from;
uniform vec3 to;
uniform vec3 across;
uniform vec3 along;
uniform float radius;
uniform float leastRadius; // of a capsule that is one metre away [m]
uniform float bevel; // edge radius of a cylinder; below 0: capsule
in vec4 place; // unit direction, index of the end

const float HALF_PI = 1.5707963;

// Latitude on the hemisphere, 0 at the rim to 1 at the pole.
float latitude() {
    return asin(clamp(abs(place.y), 0.0, 1.0)) / HALF_PI;
}

// Transforms from the frame of the rod (radial, axial, radial) to world space.
vec3 toWorld(vec3 v) {
    return across * v.x + along * v.y + cross(across, along) * v.z;
}

// Radial unit direction; zero at the pole, where it is not defined.
vec2 radialDirection() {
    float wide = length(place.xz);
    return wide > 1.0e-4 ? place.xz / wide : vec2(0.0);
}

vec3 outward() {
    if (bevel < 0.0) return toWorld(place.xyz);
    // The first half of the latitudes covers the bevelled edge, the rest the flat end.
    float turn = min(2.0 * latitude(), 1.0) * HALF_PI;
    vec2 n = radialDirection() * cos(turn);
    return toWorld(vec3(n.x, (place.w * 2.0 - 1.0) * sin(turn), n.y));
}

// Distance from the eye to the end of the capsule, along the view [m].
float distanceToEnd() {
    return (clipFromWorld * vec4(mix(from, to, place.w), 1.0)).w;
}

// Radius that a capsule is drawn with [m].
float drawnRadius() {
    return max(radius, leastRadius * distanceToEnd());
}

vec3 surfacePosition() {
    vec3 end = mix(from, to, place.w);
    if (bevel < 0.0) return end + toWorld(place.xyz) * drawnRadius();
    float inside = (radius - bevel) * (1.0 - max(2.0 * latitude() - 1.0, 0.0));
    return end + toWorld(vec3(radialDirection().x, 0.0, radialDirection().y)) * inside + outward() * bevel;
}
