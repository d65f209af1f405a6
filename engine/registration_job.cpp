#include "engine/registration_job.h"

namespace tidemark::engine {

RegistrationJob::RegistrationJob(QObject* parent) : JobRunner(parent) {}

void RegistrationJob::start(std::shared_ptr<const document::CaseImage> image,
                            std::shared_ptr<const Volume> study) {
  run(
      [image, study](const Progress& progress) {
        return tidemark::imaging::register_rigidly(*image->volume, *study, image->to_case, progress);
      },
      [this](const tidemark::imaging::Registration& found) { emit registered(found); });
}

}  // namespace tidemark::engine
