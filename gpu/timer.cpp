#include "gpu/timer.h"

#include "gpu/gl.h"

namespace tidemark::gpu {

Timer Timer::create(Device& device) {
  GLuint id = 0;
  glGenQueries(1, &id);
  Timer timer;
  timer.query_ = QueryHandle(device, id);
  return timer;
}

void Timer::begin() const {
  glBeginQuery(GL_TIME_ELAPSED, query_.id());
}
void Timer::end() const {
  glEndQuery(GL_TIME_ELAPSED);
}

double Timer::seconds() const {
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
  return static_cast<double>(nanoseconds) * 1e-9;
}

}  // namespace tidemark::gpu
