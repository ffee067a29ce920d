// One triangle over the whole picture, at the far plane: where depth is tested, only what a mesh leaves free is drawn.
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 1.0, 1.0);
}
