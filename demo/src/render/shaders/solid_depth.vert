void main() {
    gl_Position = clipFromWorld * vec4(spot(), 1.0);
}
