// Shader programs.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "gpu/buffer.h"
#include "gpu/handles.h"
#include "gpu/shader_source.h"

namespace tidemark::gpu {

// Compiles and links. Fails (ErrorKind::internal) with the compiler's messages, which name file and line.
class Program {
 public:
  Program() = default;
  static Result<Program> compute(Device& device, std::string_view path, const Defines& defines);
  // `geometry` may be empty.
  static Result<Program> render(Device& device, std::string_view vertex, std::string_view geometry,
                                std::string_view fragment, const Defines& defines);

  void use() const;

  // Uniforms, of the program in use. A name that the program does not have (or that the compiler found
  // unused) is ignored.
  void set(const char* name, int value) const;
  void set(const char* name, unsigned value) const;
  void set(const char* name, float value) const;
  void set(const char* name, glm::ivec2 value) const;
  void set(const char* name, glm::ivec3 value) const;
  void set(const char* name, glm::vec2 value) const;
  void set(const char* name, glm::vec3 value) const;
  void set(const char* name, glm::vec4 value) const;
  void set(const char* name, const glm::mat4& value) const;

  [[nodiscard]] bool has_uniform(const char* name) const { return location(name) >= 0; }

 private:
  [[nodiscard]] int location(const char* name) const;

  ProgramHandle handle_;
  mutable std::unordered_map<std::string, int> locations_;
};

// Run `groups` work groups of the program in use, or as many as are written at `offset` of `arguments`.
void dispatch(glm::ivec3 groups);
void dispatch(const Buffer& arguments, std::int64_t offset);
// What shaders wrote to buffers, textures and dispatch arguments is there for the commands that follow.
void finish_writes();
// Waits until the GPU has done everything.
void wait_for_gpu();

}  // namespace tidemark::gpu
