// One triangle that covers the view.

out vec2 view_position;  // -1..1, y upward

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  view_position = corner;
  gl_Position = vec4(corner, 0.0, 1.0);
}
