// Shared by all lit shaders: key light and its shadow map.
#ifdef GL_ES
precision highp sampler2DShadow;
#endif

uniform vec3 keyTowards;
uniform vec3 keyColour;
uniform mat4 shadowFromWorld;
uniform sampler2DShadow shadowMap;

// Turns by the golden angle: point `i` of `n` of a spiral that fills the unit disc evenly (Vogel,
// 1979) is sqrt((i + 0.5) / n) times a direction that has turned `i` times.
const mat2 GOLDEN = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// Direction that varies from pixel to pixel: gradient noise (Jimenez, SIGGRAPH 2014).
vec2 noiseDirection() {
    float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return vec2(cos(turn), sin(turn));
}

// Visibility of the key light through a disc of `radius` in the shadow map, around the projected
// point `s`. Each pixel turns the disc, so that no steps show.
float softVisibility(vec3 s, float radius, float bias) {
    vec2 border = min(s.xy, 1.0 - s.xy);
    if (min(border.x, border.y) <= 0.0 || s.z >= 1.0) return 1.0;
    vec2 towards = radius * noiseDirection();
    float lit = 0.0;
    for (int i = 0; i < 24; i++) {
        vec2 at = s.xy + sqrt((float(i) + 0.5) / 24.0) * towards;
        lit += texture(shadowMap, vec3(at, s.z - bias));
        towards = GOLDEN * towards;
    }
    return mix(1.0, lit / 24.0, smoothstep(0.0, 0.06, min(border.x, border.y)));
}

// Radiance that a pixel may have: brighter samples would outweigh the others in the resolve and
// leave stairs.
vec3 limited(vec3 light) {
    return clamp(light, 0.0, 3.5);
}

// Visibility of the key light: percentage-closer filter with a tent of (2n+1)² taps, `spread` texels apart.
// Each tap is bilinear over four texels, so there are no gaps up to a spread of two texels.
float keyVisibility(vec3 at, int n, float spread, float bias) {
    vec3 s = (shadowFromWorld * vec4(at, 1.0)).xyz * 0.5 + 0.5;
    vec2 border = min(s.xy, 1.0 - s.xy);
    if (min(border.x, border.y) <= 0.0 || s.z >= 1.0) return 1.0;
    vec2 texel = spread / vec2(textureSize(shadowMap, 0));
    float lit = 0.0;
    float total = 0.0;
    float reach = float(n) + 1.0;
    for (int y = -n; y <= n; y++) {
        for (int x = -n; x <= n; x++) {
            vec2 o = vec2(float(x), float(y));
            float w = max(0.0, 1.0 - length(o) / reach);
            lit += w * texture(shadowMap, vec3(s.xy + o * texel, s.z - bias));
            total += w;
        }
    }
    lit /= total;
    // Fades out towards the border of the map.
    return mix(1.0, lit, smoothstep(0.0, 0.06, min(border.x, border.y)));
}
