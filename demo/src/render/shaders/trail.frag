// White core with a coloured halo.
uniform vec3 glow;
in vec2 spark;
layout (location = 0) out vec4 colour;
void main() {
    float away = spark.x * spark.x;
    float halo = exp(-away * 7.0) * (1.0 - away);
    float core = exp(-away * 260.0);
    float heat = spark.y * spark.y;
    colour = vec4(glow * halo * heat * 0.55 + vec3(0.9, 0.97, 1.0) * core * heat * 3.0, 0.0);
}
