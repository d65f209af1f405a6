#include "gpu/program.h"

#include <glm/gtc/type_ptr.hpp>
#include <sstream>
#include <vector>

#include "gpu/gl.h"
#include "gpu/label.h"

namespace tidemark::gpu {
namespace {

const char* glsl_version(const Device& device) {
  return device.capabilities().at_least(4, 5) ? "450 core" : "330 core";
}

// The first line of a compiler's messages that is an error: the others mostly follow from it.
std::string first_error(const std::string& log) {
  std::istringstream lines(log);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.find("error") != std::string::npos) return line;
  }
  return log.substr(0, log.find('\n'));
}

template <class Get, class GetLog>
std::string info_log(GLuint id, Get get, GetLog get_log) {
  GLint length = 0;
  get(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) get_log(id, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

Result<ShaderHandle> compile(Device& device, GLenum stage, std::string_view path, const Defines& defines) {
  auto source = assemble_shader(path, glsl_version(device), defines);
  if (!source) return pass_on(source);
  ShaderHandle shader(device, glCreateShader(stage));
  const char* text = source->text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  TIDEMARK_TRY(device.check("compiling a shader"));
  const std::string log = name_files(info_log(shader.id(), glGetShaderiv, glGetShaderInfoLog), *source);
  device.report_message(log);
  return fail(ErrorKind::internal, "{}", first_error(log));
}

Result<ProgramHandle> link(Device& device, std::string_view label, const std::vector<ShaderHandle>& shaders) {
  ProgramHandle program(device, glCreateProgram());
  for (const ShaderHandle& shader : shaders) glAttachShader(program.id(), shader.id());
  glLinkProgram(program.id());
  for (const ShaderHandle& shader : shaders) glDetachShader(program.id(), shader.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  TIDEMARK_TRY(device.check("linking a shader"));
  if (linked != GL_TRUE) {
    return fail(ErrorKind::internal, "{}: {}", label,
                info_log(program.id(), glGetProgramiv, glGetProgramInfoLog));
  }
  set_label(device, GL_PROGRAM, program.id(), label);
  return program;
}

}  // namespace

Result<Program> Program::compute(Device& device, std::string_view path, const Defines& defines) {
  TIDEMARK_TRY(device.announce({{std::string(path)}, defines}));
  std::vector<ShaderHandle> shaders;
  auto shader = compile(device, GL_COMPUTE_SHADER, path, defines);
  if (!shader) return pass_on(shader);
  shaders.push_back(std::move(*shader));
  auto handle = link(device, path, shaders);
  if (!handle) return pass_on(handle);
  Program program;
  program.handle_ = std::move(*handle);
  return program;
}

Result<Program> Program::render(Device& device, std::string_view vertex, std::string_view geometry,
                                std::string_view fragment, const Defines& defines) {
  ProgramSource source{{}, defines};
  for (const std::string_view path : {vertex, geometry, fragment}) {
    if (!path.empty()) source.stages.emplace_back(path);
  }
  TIDEMARK_TRY(device.announce(source));
  std::vector<ShaderHandle> shaders;
  for (const auto& [stage, path] : {std::pair{GL_VERTEX_SHADER, vertex},
                                    {GL_GEOMETRY_SHADER, geometry},
                                    {GL_FRAGMENT_SHADER, fragment}}) {
    if (path.empty()) continue;
    auto shader = compile(device, static_cast<GLenum>(stage), path, defines);
    if (!shader) return pass_on(shader);
    shaders.push_back(std::move(*shader));
  }
  auto handle = link(device, fragment, shaders);
  if (!handle) return pass_on(handle);
  Program program;
  program.handle_ = std::move(*handle);
  return program;
}

void Program::use() const {
  glUseProgram(handle_.id());
}

int Program::location(const char* name) const {
  const auto known = locations_.find(name);
  if (known != locations_.end()) return known->second;
  const int location = glGetUniformLocation(handle_.id(), name);
  locations_.emplace(name, location);
  return location;
}

void Program::set(const char* name, int value) const {
  glUniform1i(location(name), value);
}
void Program::set(const char* name, unsigned value) const {
  glUniform1ui(location(name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}
void Program::set(const char* name, glm::ivec2 value) const {
  glUniform2i(location(name), value.x, value.y);
}
void Program::set(const char* name, glm::ivec3 value) const {
  glUniform3i(location(name), value.x, value.y, value.z);
}
void Program::set(const char* name, glm::vec2 value) const {
  glUniform2f(location(name), value.x, value.y);
}
void Program::set(const char* name, glm::vec3 value) const {
  glUniform3f(location(name), value.x, value.y, value.z);
}
void Program::set(const char* name, glm::vec4 value) const {
  glUniform4f(location(name), value.x, value.y, value.z, value.w);
}
void Program::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}

void dispatch(glm::ivec3 groups) {
  glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                    static_cast<GLuint>(groups.z));
}

void dispatch(const Buffer& arguments, std::int64_t offset) {
  arguments.bind_as_dispatch_arguments();
  glDispatchComputeIndirect(offset);
}

void finish_writes() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void wait_for_gpu() {
  glFinish();
}

}  // namespace tidemark::gpu
