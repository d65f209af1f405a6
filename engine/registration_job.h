// Rigid registration beside the user interface.
#pragma once

#include <memory>

#include "engine/job_runner.h"
#include "engine/shown_image.h"
#include "imaging/registration/registration.h"

namespace tidemark::engine {

class RegistrationJob : public JobRunner {
  Q_OBJECT
 public:
  explicit RegistrationJob(QObject* parent = nullptr);

  // Ends with registered() or failed(). The search begins where the image is now.
  void start(std::shared_ptr<const document::CaseImage> image, std::shared_ptr<const Volume> study);

 signals:
  void registered(const tidemark::imaging::Registration& found);
};

}  // namespace tidemark::engine
