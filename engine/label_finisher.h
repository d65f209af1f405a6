// The tools that finish a case's labels: previewed beside the user interface, then applied.
#pragma once

#include <memory>
#include <vector>

#include "document/label_tool.h"
#include "engine/job_runner.h"

namespace tidemark::engine {

class CaseProxy;

// What a tool would make of labels.
struct LabelPreview {
  document::LabelToolUse use;
  std::vector<std::uint8_t> labels;
  document::LabelVoxels from;
  std::vector<document::LabelRegion> regions;
  double before_ml = 0.0;  // of those labels
  double after_ml = 0.0;   // of all that they would become
};

class LabelFinisher : public JobRunner {
  Q_OBJECT
 public:
  // Belongs to the proxy, and does not outlive it.
  explicit LabelFinisher(CaseProxy& proxy);

  // The former preview stays until the new one is there; ends with changed(), failed() or cancelled().
  void begin(const document::LabelToolUse& use, const std::vector<std::uint8_t>& labels);
  // Null: there is none.
  [[nodiscard]] const std::shared_ptr<const LabelPreview>& preview() const { return preview_; }
  // Whether it is of the labels as they are now.
  [[nodiscard]] bool is_current() const;
  void cancel() { give_up(); }
  void clear();  // the preview, and what is being computed

  // The labels become what the preview shows: one entry of the history. Nothing without a current preview.
  void apply(document::Take take);

 signals:
  void changed();  // preview()

 private:
  CaseProxy& proxy_;
  std::shared_ptr<const LabelPreview> preview_;
};

}  // namespace tidemark::engine
