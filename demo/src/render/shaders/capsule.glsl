// A rod from a shell of two half balls. Its ends are round, or flat with edges that are round by `bevel`.
uniform mat4 clipFromWorld;
uniform vec3 from;
uniform vec3 to;
uniform vec3 across;
uniform vec3 along;
uniform float radius;
uniform float bevel; // below 0: round ends
in vec4 place; // direction, which end

const float HALF_PI = 1.5707963;

// How far a place of the shell is on its way from the rim of an end to the middle of it, 0 to 1.
float climb() {
    return asin(clamp(abs(place.y), 0.0, 1.0)) / HALF_PI;
}

// In the frame of the rod: aside, along, aside.
vec3 inWorld(vec3 v) {
    return across * v.x + along * v.y + cross(across, along) * v.z;
}

// Away from the axis, also at the middle of an end, where there is no such direction.
vec2 aside() {
    float wide = length(place.xz);
    return wide > 1.0e-4 ? place.xz / wide : vec2(0.0);
}

vec3 outward() {
    if (bevel < 0.0) return inWorld(place.xyz);
    // The first half of the way leads over the edge, the rest over the flat.
    float turn = min(2.0 * climb(), 1.0) * HALF_PI;
    vec2 n = aside() * cos(turn);
    return inWorld(vec3(n.x, (place.w * 2.0 - 1.0) * sin(turn), n.y));
}

vec3 spot() {
    vec3 end = mix(from, to, place.w);
    if (bevel < 0.0) return end + inWorld(place.xyz) * radius;
    float inside = (radius - bevel) * (1.0 - max(2.0 * climb() - 1.0, 0.0));
    return end + inWorld(vec3(aside().x, 0.0, aside().y)) * inside + outward() * bevel;
}
