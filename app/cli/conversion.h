// One input of `tidemark-cli convert` in all the forms that can be asked for.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/label_argument.h"
#include "app/cli/outputs.h"
#include "app/cli/study_input.h"
#include "core/progress.h"
#include "imaging/results/results.h"
#include "imaging/series.h"
#include "imaging/surface/surface.h"

namespace tidemark::cli {

// The meaning of INPUT, where the file does not show it.
enum class InputKind { volume, mask, labels, level_set };

struct ConversionOptions {
  StudyInput study;  // INPUT; its series and policy are the source's where there is one
  InputKind kind = InputKind::volume;
  std::string source;  // the study that INPUT was made of, whose grid, patient and frame of reference it gets
  std::vector<LabelArgument> labels;

  // INPUT as it is read.
  [[nodiscard]] StudyInput input() const;
  // The source as it is read; it must be given.
  [[nodiscard]] StudyInput source_study() const;
};

class Conversion {
 public:
  // Reads the input, and brings it onto the source's grid where there is one.
  static Result<Conversion> load(ConversionOptions options, const Progress& progress);

  // Whether the input is no more than a volume of values: it has no segments and no surface.
  [[nodiscard]] bool is_plain() const { return segments_.list.empty(); }

  Status write(const std::filesystem::path& file, FileForm form, const Progress& progress);
  // A surface for each segment, in a file that Outputs gets a name of: see mesh_files().
  Status write_each(const std::filesystem::path& like, const Progress& progress, Outputs& outputs);
  Status write_contours(const std::filesystem::path& file, const Progress& progress);

  [[nodiscard]] const Geometry& geometry() const { return segments_.geometry; }
  [[nodiscard]] const imaging::Segments& segments() const { return segments_; }
  [[nodiscard]] const std::vector<std::string>& changes() const { return segments_.changes; }
  [[nodiscard]] const char* scalar_name() const;
  [[nodiscard]] const std::optional<imaging::Mesh>& mesh() const { return mesh_; }  // if one was written
  [[nodiscard]] const std::vector<std::filesystem::path>& each() const { return each_; }  // written so
  [[nodiscard]] bool has_source() const { return !source_files_.empty(); }

 private:
  explicit Conversion(ConversionOptions options) : options_(std::move(options)) {}

  Status load_source(const Progress& progress);
  Status load_result(const Progress& progress);
  Status load_volume(const Progress& progress);
  Status split();
  Status require_segments() const;
  Status write_values(const std::filesystem::path& file);
  Status write_surface(const std::filesystem::path& file);

  ConversionOptions options_;
  std::optional<Geometry> grid_;        // the source's
  std::string frame_of_reference_uid_;  // the source's; empty where it is not known
  std::vector<std::filesystem::path> source_files_;
  std::shared_ptr<const imaging::StudyArchive> source_archive_;  // in which they lie, if they do
  std::optional<Volume> volume_;                                 // where the input is one
  imaging::Segments segments_;                                   // none in a plain volume
  std::optional<imaging::Mesh> mesh_;
  std::vector<std::filesystem::path> each_;
};

}  // namespace tidemark::cli
