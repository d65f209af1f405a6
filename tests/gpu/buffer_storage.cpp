#include "tests/gpu/buffer_storage.h"

#include "gpu/gl.h"

namespace tidemark::test {

bool cannot_be_mapped(const gpu::Buffer& buffer) {
  glBindBuffer(GL_COPY_READ_BUFFER, buffer.id());
  GLint immutable = GL_FALSE;
  GLint flags = -1;
  glGetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_IMMUTABLE_STORAGE, &immutable);
  glGetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_STORAGE_FLAGS, &flags);
  constexpr GLint kMapped = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_CLIENT_STORAGE_BIT;
  return immutable == GL_TRUE && (flags & kMapped) == 0;
}

}  // namespace tidemark::test
