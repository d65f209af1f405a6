// Drawing as computing: primitives whose vertices shaders make from their numbers, one fragment a result.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "gpu/handles.h"
#include "gpu/texture.h"

namespace tidemark::gpu {

enum class Primitive { points, lines, triangles };

// The vertex array that core contexts need for a draw; this one has no attributes.
class VertexArray {
 public:
  VertexArray() = default;
  static VertexArray create(Device& device);
  void bind() const;

 private:
  VertexArrayHandle handle_;
};

// Draws with the program, the framebuffer and the vertex array in use; vertices are numbered from 0.
void draw(Primitive primitive, std::int64_t vertices);

// Compiles such a draw's program in this thread, on a processor that plays the GPU. Draws nothing.
void prepare_draw();

// Fragments reach their texels unchanged: no test, no blending, no dithering, lines and points one texel
// wide.
void begin_exact_drawing();

// The first `count` textures of the framebuffer in use get this value.
void clear_colours(int count, glm::vec4 value = glm::vec4(0.0F));

// Only this rectangle is drawn to, while the object lives.
class ScissorScope {
 public:
  explicit ScissorScope(const TexelRect& rect);
  ScissorScope(const ScissorScope&) = delete;
  ScissorScope& operator=(const ScissorScope&) = delete;
  ~ScissorScope();
};

// How fragments combine with what is in the texture, while the object lives. `under`: fragments, multiplied
// by their opacity, lie behind what is there.
enum class Blending { add, largest, smallest, under, replace };
class BlendScope {
 public:
  explicit BlendScope(Blending blending);
  BlendScope(const BlendScope&) = delete;
  BlendScope& operator=(const BlendScope&) = delete;
  ~BlendScope();
};

}  // namespace tidemark::gpu
