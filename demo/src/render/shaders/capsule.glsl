// A rod with round ends, from a shell of two half balls.
uniform mat4 clipFromWorld;
uniform vec3 from;
uniform vec3 to;
uniform vec3 across;
uniform vec3 along;
uniform float radius;
in vec4 place; // direction, which end

vec3 outward() {
    return across * place.x + along * place.y + cross(across, along) * place.z;
}

vec3 spot() {
    return mix(from, to, place.w) + outward() * radius;
}
