in vec4 place; // x, y, side, brightness
out vec2 spark;
void main() {
    spark = place.zw;
    gl_Position = vec4(place.xy, 0.0, 1.0);
}
