#include "gpu/draw.h"

#include "gpu/gl.h"

namespace tidemark::gpu {

VertexArray VertexArray::create(Device& device) {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  VertexArray array;
  array.handle_ = VertexArrayHandle(device, id);
  return array;
}

void VertexArray::bind() const {
  glBindVertexArray(handle_.id());
}

void draw(Primitive primitive, std::int64_t vertices) {
  const GLenum mode = primitive == Primitive::points  ? GL_POINTS
                      : primitive == Primitive::lines ? GL_LINES
                                                      : GL_TRIANGLES;
  if (vertices > 0) glDrawArrays(mode, 0, static_cast<GLsizei>(vertices));
}

void prepare_draw() {
  const ScissorScope nowhere({0, 0, 0, 0});
  draw(Primitive::triangles, 3);
}

void begin_exact_drawing() {
  for (const GLenum test :
       {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND, GL_DITHER, GL_MULTISAMPLE,
        GL_LINE_SMOOTH, GL_COLOR_LOGIC_OP, GL_PROGRAM_POINT_SIZE}) {
    glDisable(test);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glLineWidth(1.0F);
  glPointSize(1.0F);
}

void clear_colours(int count, glm::vec4 value) {
  for (GLint i = 0; i < count; ++i) glClearBufferfv(GL_COLOR, i, &value.x);
}

ScissorScope::ScissorScope(const TexelRect& rect) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<GLint>(rect.x), static_cast<GLint>(rect.y), static_cast<GLsizei>(rect.width),
            static_cast<GLsizei>(rect.height));
}

ScissorScope::~ScissorScope() {
  glDisable(GL_SCISSOR_TEST);
}

BlendScope::BlendScope(Blending blending) {
  glEnable(GL_BLEND);
  glBlendFunc(blending == Blending::under ? GL_ONE_MINUS_DST_ALPHA : GL_ONE,
              blending == Blending::replace ? GL_ZERO : GL_ONE);
  glBlendEquation(blending == Blending::largest    ? GL_MAX
                  : blending == Blending::smallest ? GL_MIN
                                                   : GL_FUNC_ADD);
}

BlendScope::~BlendScope() {
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);
}

}  // namespace tidemark::gpu
