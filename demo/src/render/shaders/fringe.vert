// A loose thread as a ribbon that faces the eye. A thread that is finer than a pixel is drawn one
// pixel wide and proportionally fainter.
uniform mat4 clipFromWorld;
uniform vec2 pixels;
uniform float lens; // focal length in pixels

#ifdef GL_ES
precision highp sampler2D;
#endif
uniform sampler2D threads; // four texels per thread, 64 threads per row

in vec3 corner; // side, position along the thread (0 root, 1 tip), index of the thread

// Parameters of the thread, read from the texture.
vec3 root;
vec3 reach;
vec3 normal;
vec4 traits; // half width, lean out of the cloth, phase of the curl, weft (0) or warp (1) plus shade

out vec3 at;
out vec3 along;
out vec3 facing;
out vec4 look; // weft 0 or warp 1, shade, coverage, position along the thread

vec3 threadPoint(float s) {
    float len = length(reach);
    vec3 n = normal;
    vec3 side = cross(n, reach) / max(len, 1.0e-6);
    float curl = s * s * len;
    vec3 p = root + reach * s;
    p += n * (0.9 * traits.y * s + 0.22 * s * s * cos(traits.z)) * len;
    p += side * 0.34 * curl * sin(traits.z + 2.2 * s);
    // Longer threads sag more.
    p.y -= curl * min(0.85, 16.0 * len);
    return p;
}

void main() {
    int thread = int(corner.z);
    // Rows are stored from the last to the first.
    ivec2 first = ivec2(4 * (thread % 64), textureSize(threads, 0).y - 1 - thread / 64);
    vec4 texels[4];
    for (int i = 0; i < 4; i++) texels[i] = texelFetch(threads, first + ivec2(i, 0), 0);
    root = texels[0].xyz;
    reach = texels[1].xyz;
    normal = texels[2].xyz;
    traits = vec4(texels[0].w, texels[1].w, texels[2].w, texels[3].x);
    float s = corner.y;
    at = threadPoint(s);
    vec3 ahead = threadPoint(s + 0.05);
    along = ahead - at;
    facing = normal;
    vec4 here = clipFromWorld * vec4(at, 1.0);
    vec4 there = clipFromWorld * vec4(ahead, 1.0);
    vec2 line = (there.xy / there.w - here.xy / here.w) * pixels;
    line = dot(line, line) > 1.0e-8 ? normalize(line) : vec2(0.0, 1.0);
    // Half widths in pixels: the real one, and the drawn one.
    float fine = traits.x * (1.0 - 0.55 * s) * lens / max(here.w, 0.01);
    float wide = max(fine, 0.6);
    float shade = fract(traits.w);
    look = vec4(floor(traits.w), shade, min(1.0, 1.9 * fine / wide) * (1.0 - s * s * s * 0.6), s);
    here.xy += vec2(-line.y, line.x) * corner.x * wide * 2.0 / pixels * here.w;
    // Depth offset in front of the cloth.
    here.z -= 0.0004 * here.w * s;
    gl_Position = here;
}
