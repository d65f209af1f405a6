// The measures of a case's surface or of one of its labels, found beside the user interface.
#pragma once

#include <memory>

#include "document/measures.h"
#include "engine/job_runner.h"

namespace tidemark::engine {

class CaseProxy;

class RegionMeter : public JobRunner {
  Q_OBJECT
 public:
  explicit RegionMeter(QObject* parent = nullptr);

  // Of document::kTheSurface or a label, as they are now: with the values of the study and of all images of
  // the display on its grid. Ends with measured(), failed() or cancelled().
  void begin(CaseProxy& proxy, std::uint8_t label);
  void cancel() { give_up(); }

 signals:
  void measured(const std::shared_ptr<const document::Measures>& measures);
};

}  // namespace tidemark::engine
