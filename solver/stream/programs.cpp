// The programs of the stream executor's passes.
#include "solver/stream/region_passes.h"

namespace tidemark::solver {
namespace {

struct Wanted {
  gpu::Program& program;
  Substream substream;
  const char* fragment;
  gpu::Defines defines;
};

Status compile(gpu::Device& device, const GeometryEngine& geometry, const gpu::Defines& common,
               const Wanted& wanted) {
  gpu::Defines defines = geometry.defines(wanted.substream);
  defines.insert(defines.end(), common.begin(), common.end());
  defines.insert(defines.end(), wanted.defines.begin(), wanted.defines.end());
  auto program = gpu::Program::render(device, GeometryEngine::vertex_shader(wanted.substream), "",
                                      fmt::format("solver/stream/{}.frag", wanted.fragment), defines);
  if (!program) return pass_on(program);
  wanted.program = std::move(*program);
  return {};
}

}  // namespace

Result<RegionPasses> RegionPasses::create(gpu::Device& device, const GeometryEngine& geometry,
                                          const DriveTextures& drive, const Model& model,
                                          std::int64_t largest_region) {
  RegionPasses passes;
  constexpr std::int64_t kRow = GeometryEngine::kPlacesPerRow;
  passes.largest_region_ = std::max(kRow, (largest_region + kRow - 1) / kRow * kRow);
  const gpu::Defines in_memory = {{"IN_MEMORY", ""}};
  const gpu::Defines neighbours = {{"NEIGHBOURS", ""}};
  for (const Wanted& wanted : {Wanted{passes.neighbours_, Substream::blocks, "neighbours", neighbours},
                               Wanted{passes.motion_blocks_, Substream::blocks, "motion_blocks", {}},
                               Wanted{passes.motion_pages_, Substream::page_point, "motion_pages", in_memory},
                               Wanted{passes.page_message_, Substream::page_point, "page_message", {}},
                               Wanted{passes.fill_, Substream::whole_page, "constant", in_memory},
                               Wanted{passes.fill_points_, Substream::page_point, "constant", in_memory},
                               Wanted{passes.copy_, Substream::whole_page, "copy", in_memory},
                               Wanted{passes.paint_, Substream::whole_page, "paint", in_memory}}) {
    TIDEMARK_TRY(compile(device, geometry, {}, wanted));
  }
  TIDEMARK_TRY(passes.compile_step(device, geometry, drive, model));
  return passes;
}

Status RegionPasses::compile_step(gpu::Device& device, const GeometryEngine& geometry,
                                  const DriveTextures& drive, const Model& model) {
  gpu::Defines common = step_defines(model);
  gpu::add(common, drive.defines());
  if (common == step_defines_) return {};
  const gpu::Defines neighbours = {{"NEIGHBOURS", ""}};
  for (const Wanted& wanted : {Wanted{derivatives_[0], Substream::interior, "derivatives", neighbours},
                               Wanted{derivatives_[1], Substream::edges, "derivatives", neighbours},
                               Wanted{derivatives_[2], Substream::corners, "derivatives", neighbours},
                               Wanted{speeds_, Substream::whole_page, "speeds", {}},
                               Wanted{update_, Substream::whole_page, "update", {{"IN_MEMORY", ""}}}}) {
    TIDEMARK_TRY(compile(device, geometry, common, wanted));
  }
  step_defines_ = std::move(common);
  return {};
}

}  // namespace tidemark::solver
