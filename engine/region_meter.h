// The measures of a case's surface or of one of its labels, found beside the user interface.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "document/label_tool.h"
#include "document/measures.h"
#include "engine/job_runner.h"

namespace tidemark::engine {

class CaseProxy;

// Measures stay until the case or the display's images change.
class RegionMeter : public JobRunner {
  Q_OBJECT
 public:
  // Belongs to the proxy, and does not outlive it.
  explicit RegionMeter(CaseProxy& proxy);

  // Of document::kTheSurface or a label, as they are now: with the values of the study and of all images of
  // the display on its grid. Ends with changed(), failed() or cancelled().
  void begin(std::uint8_t label);
  void cancel() { give_up(); }
  void clear();  // the measures, and what is being computed

  // Of label() in the case as it is now; null: there are none.
  [[nodiscard]] const std::shared_ptr<const document::Measures>& measures() const { return measures_; }
  [[nodiscard]] std::uint8_t label() const { return label_; }

 signals:
  void changed();  // measures()

 private:
  using Images = std::vector<std::shared_ptr<const document::CaseImage>>;
  [[nodiscard]] Images images_now() const;  // of the display
  void compute();
  void follow_case();

  CaseProxy& proxy_;
  std::uint8_t label_ = document::kTheSurface;
  std::int64_t step_ = 0;  // of the case when it was asked
  std::uint64_t edits_ = 0;
  Images images_;
  std::shared_ptr<const solver::Field> phi_;
  std::shared_ptr<const document::Measures> measures_;
};

}  // namespace tidemark::engine
