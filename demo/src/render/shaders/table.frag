// Matt ground that fades into the background colour.
uniform vec3 eye;
uniform vec3 backdrop;
uniform sampler2D depths;
uniform float depthRange; // depth of the volume of the depth map
uniform float radius;     // half the width of this volume
uniform vec3 middle;      // centre of the paper

in vec3 at;
layout (location = 0) out vec4 colour;

const vec3 GROUND = vec3(0.631, 0.658, 0.694); // #d0d4d8

// Mean distance to the occluders of the key light; 0 if there are none.
float occluderDistance(vec3 at) {
    vec3 s = (shadowFromWorld * vec4(at, 1.0)).xyz * 0.5 + 0.5;
    float sum = 0.0;
    float count = 0.0;
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 4; x++) {
            vec2 p = s.xy + (vec2(float(x), float(y)) - 1.5) * (0.22 / (2.0 * radius));
            float d = texture(depths, p).r;
            if (d < s.z - 0.0002) {
                sum += s.z - d;
                count += 1.0;
            }
        }
    }
    return count > 0.0 ? sum / count * depthRange : 0.0;
}

void main() {
    vec3 edge = abs((shadowFromWorld * vec4(at, 1.0)).xyz);
    float far = max(edge.x, edge.y) < 1.0 ? occluderDistance(at) : 0.0;
    float lit = 1.0;
    if (far > 0.0) {
        // Penumbra: the farther the occluder, the softer the shadow.
        float soft = clamp(0.012 + 0.045 * far, 0.014, 0.30);
        lit = softVisibility((shadowFromWorld * vec4(at, 1.0)).xyz * 0.5 + 0.5, soft / (2.0 * radius), 0.0002);
    }
    float open = 1.0;
    if (length(at - middle) < radius + 2.0) {
        open = 0.28 + 0.72 * skyLight(at + vec3(0.0, 0.03, 0.0), vec3(0.0, 1.0, 0.0), 14.0 * noiseDirection(), 4);
    }
    vec3 light = GROUND * (ambientLight(vec3(0.0, 1.0, 0.0), open) + keyColour * lit * keyTowards.y);
    float fade = smoothstep(9.0, 34.0, length(at.xz));
    colour = vec4(mix(light, backdrop, fade), 1.0);
}
