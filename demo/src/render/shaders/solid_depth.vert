void main() {
    gl_Position = clipFromWorld * vec4(surfacePosition(), 1.0);
}
