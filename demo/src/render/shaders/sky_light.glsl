// Ambient visibility of a point, 0 to 1, from the depth maps of four sky directions.
uniform mat4 skyFromWorld[4];
uniform vec3 skyTowards[4];
uniform sampler2DShadow skyMaps;

// `at` is offset a little from its surface, whose normal is `n`. Each direction takes `taps` samples on
// a spiral that begins towards `towards`, whose length is the radius of the spiral [texels].
float skyLight(vec3 at, vec3 n, vec2 towards, int taps) {
    float visible = 0.0;
    float total = 0.0;
    for (int i = 0; i < 4; i++) {
        vec3 s = (skyFromWorld[i] * vec4(at, 1.0)).xyz * 0.5 + 0.5;
        float w = 0.06 + max(dot(n, skyTowards[i]), 0.0);
        float lit = 1.0;
        if (all(greaterThan(s.xy, vec2(0.02))) && all(lessThan(s.xy, vec2(0.98))) && s.z < 1.0) {
            vec2 texel = 1.0 / vec2(textureSize(skyMaps, 0));
            for (int j = 0; j < taps; j++) {
                vec2 p = clamp(s.xy + sqrt((float(j) + 0.5) / float(taps)) * towards * texel, 0.004, 0.996);
                towards = GOLDEN * towards;
                p = 0.5 * (p + vec2(float(i % 2), float(i / 2)));
                // Only near occluders darken; shadows of far ones are left to the key light.
                float any = texture(skyMaps, vec3(p, s.z - 0.0006));
                vec2 farther = vec2(
                    texture(skyMaps, vec3(p, s.z - 0.005)), texture(skyMaps, vec3(p, s.z - 0.014)));
                lit -= dot(max(farther - any, 0.0), vec2(0.55, 0.45)) / float(taps);
            }
        }
        visible += w * lit;
        total += w;
    }
    return visible / total;
}

// The specified ambient and hemisphere light on a surface with normal `n`.
vec3 ambientLight(vec3 n, float visible) {
    vec3 dome = mix(vec3(0.434, 0.479, 0.527), vec3(0.745, 0.807, 0.871), 0.5 + 0.5 * n.y);
    return (vec3(0.5) + 0.3 * dome) * visible;
}
