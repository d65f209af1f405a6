#include "dense_gl.h"

#include <chrono>

#include "gpu/program.h"
#include "solver/gl/step_uniforms.h"
#include "solver/model.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::bench {

Result<DenseRun> run_dense_gl(gpu::Device& device, const Volume& source, const solver::Parameters& parameters,
                              const solver::Field& phi, std::int64_t steps) {
  TIDEMARK_TRY(device.make_current());
  const solver::Model model(source.geometry, parameters,
                            solver::TentSpeed(std::make_shared<const Volume>(source), parameters));
  auto program = gpu::Program::compute(device, "bench/dense.comp", solver::step_defines(model));
  if (!program) return pass_on(program);
  const std::int64_t bytes = source.geometry.voxel_count() * 4;
  if (bytes > device.capabilities().largest_storage_buffer) {
    return fail(ErrorKind::capability, "a buffer of {} MB is needed; this driver allows {} MB", bytes >> 20,
                device.capabilities().largest_storage_buffer >> 20);
  }
  gpu::Buffer buffers[3];
  for (gpu::Buffer& buffer : buffers) {
    auto made = gpu::Buffer::create(device, bytes, "dense");
    if (!made) return pass_on(made);
    buffer = std::move(*made);
  }
  buffers[0].upload_values<float>(0, phi.dense());
  buffers[2].upload_values<float>(0, source.values());
  buffers[2].bind_storage(2);
  program->use();
  solver::set_step_uniforms(*program, model.constants<float>());
  solver::set_tent_uniforms(*program, solver::tent_of(parameters));
  const glm::ivec3 size(source.geometry.size);
  program->set("volume_size", size);
  const auto run = [&](std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      buffers[i % 2].bind_storage(0);
      buffers[(i + 1) % 2].bind_storage(1);
      gpu::dispatch({(size.x + 63) / 64, (size.y + 3) / 4, size.z});
      gpu::finish_writes();
    }
    gpu::wait_for_gpu();
  };
  run(2);  // compiles
  const auto start = std::chrono::steady_clock::now();
  run(steps);
  DenseRun result;
  result.steps = steps;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  TIDEMARK_TRY(device.check("computing the whole volume"));
  return result;
}

}  // namespace tidemark::bench
