// How open to the sky a place is, 0 to 1: four directions, a small map of depths each.
uniform mat4 skyFromWorld[4];
uniform vec3 skyTowards[4];
uniform sampler2DShadow skyMaps;

// `at` is a little off its surface, which faces along `n`.
float skyLight(vec3 at, vec3 n, float spread) {
    float open = 0.0;
    float total = 0.0;
    for (int i = 0; i < 4; i++) {
        vec3 s = (skyFromWorld[i] * vec4(at, 1.0)).xyz * 0.5 + 0.5;
        float w = 0.06 + max(dot(n, skyTowards[i]), 0.0);
        float lit = 1.0;
        if (all(greaterThan(s.xy, vec2(0.02))) && all(lessThan(s.xy, vec2(0.98))) && s.z < 1.0) {
            vec2 texel = spread / vec2(textureSize(skyMaps, 0));
            for (int j = 0; j < 2; j++) {
                // By turns across one diagonal and the other.
                vec2 side = vec2(i % 2 == 0 ? 1.0 : -1.0, 1.0) * (2.0 * float(j) - 1.0);
                vec2 p = clamp(s.xy + side * texel, 0.004, 0.996);
                p = 0.5 * (p + vec2(float(i % 2), float(i / 2)));
                // Only what is near darkens, the nearer the more: far shadows are the key light's alone.
                float any = texture(skyMaps, vec3(p, s.z - 0.0006));
                vec2 farther = vec2(
                    texture(skyMaps, vec3(p, s.z - 0.005)), texture(skyMaps, vec3(p, s.z - 0.014)));
                lit -= 0.5 * dot(max(farther - any, 0.0), vec2(0.55, 0.45));
            }
        }
        open += w * lit;
        total += w;
    }
    return open / total;
}

// The brief's ambient light and the light of its two half domes, on a surface that faces along `n`.
vec3 around(vec3 n, float open) {
    vec3 dome = mix(vec3(0.434, 0.479, 0.527), vec3(0.745, 0.807, 0.871), 0.5 + 0.5 * n.y);
    return (vec3(0.5) + 0.3 * dome) * open;
}
