#include "engine/registration_job.h"

#include <QCoreApplication>

namespace tidemark::engine {
namespace {

[[maybe_unused]] constexpr const char* kRegistrationSteps[] = {
    QT_TRANSLATE_NOOP("tidemark::RegistrationStep", "registering"),
};

}  // namespace

RegistrationJob::RegistrationJob(QObject* parent) : JobRunner("tidemark::RegistrationStep", parent) {}

void RegistrationJob::start(std::shared_ptr<const document::CaseImage> image,
                            std::shared_ptr<const Volume> study) {
  run(
      [image, study](const Progress& progress) {
        return tidemark::imaging::register_rigidly(*image->volume, *study, image->to_case, progress);
      },
      [this](const tidemark::imaging::Registration& found) { emit registered(found); });
}

}  // namespace tidemark::engine
