// The tools that finish a case's labels: previewed beside the user interface, then applied.
#pragma once

#include <memory>
#include <vector>

#include "engine/job_runner.h"
#include "engine/label_preview.h"

namespace tidemark::engine {

class CaseProxy;

class LabelFinisher : public JobRunner {
  Q_OBJECT
 public:
  // Belongs to the proxy, and does not outlive it.
  explicit LabelFinisher(CaseProxy& proxy);

  // The former preview stays until the new one is there; ends with changed(), failed() or cancelled().
  void begin(const document::LabelToolUse& use, const std::vector<std::uint8_t>& labels, document::Take take);
  // Null: there is none.
  [[nodiscard]] const std::shared_ptr<const LabelPreview>& preview() const { return preview_; }
  // Whether it is of the labels, and of the surface where that has a part in it, as they are now.
  [[nodiscard]] bool is_current() const { return preview_ && is_of_now(*preview_); }
  // Whether begin() was last called for this use, and for what is now, whatever has come of it.
  [[nodiscard]] bool asked_is_current(const document::LabelToolUse& use) const {
    return asked_ && asked_->use == use && is_of_now(*asked_);
  }
  void cancel() { give_up(); }
  void clear();  // the preview, and what is being computed

  // The labels become what the preview shows: one entry of the history. Nothing without a current preview.
  void apply();

 signals:
  void changed();  // preview()

 private:
  [[nodiscard]] bool is_of_now(const LabelPreview& preview) const;

  CaseProxy& proxy_;
  std::shared_ptr<const LabelPreview> asked_;  // without an outcome
  std::shared_ptr<const LabelPreview> preview_;
};

}  // namespace tidemark::engine
