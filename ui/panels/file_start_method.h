// The start from a file.
#pragma once

#include <memory>

#include "ui/panels/start_files.h"
#include "ui/panels/start_method.h"

class QLineEdit;

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

class RefineChoice;

class FileStartMethod : public StartMethod {
  Q_OBJECT
 public:
  explicit FileStartMethod(StartFile kind, QWidget* parent = nullptr);
  ~FileStartMethod() override;
  [[nodiscard]] QString title() const override;
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  [[nodiscard]] bool has_levels() const override { return kind_ == StartFile::mask; }
  // Reads the file beside the user interface, then begins in the case of the request.
  void start(int levels) override;

 protected:
  void refresh() override {}

 private:
  void choose();
  void take(const Result<document::Start>& start, engine::CaseProxy* proxy);

  StartFile kind_;
  QLineEdit* path_;
  RefineChoice* refine_ = nullptr;  // of a mask
  std::shared_ptr<engine::BackgroundJob> reading_;
};

}  // namespace tidemark::ui
