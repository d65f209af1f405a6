// The start from a file.
#pragma once

#include <memory>

#include "ui/panels/per_case.h"
#include "ui/panels/start_files.h"
#include "ui/panels/start_method.h"

class QLineEdit;
class QPushButton;

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

class RefineChoice;

class FileStartMethod : public StartMethod {
  Q_OBJECT
 public:
  explicit FileStartMethod(StartFile kind, QWidget* parent = nullptr);
  [[nodiscard]] QString title() const override;
  [[nodiscard]] QString sentence() const override;
  [[nodiscard]] bool can_start() const override;
  [[nodiscard]] bool has_levels() const override { return kind_ == StartFile::mask; }
  // Reads the file beside the user interface, then begins in the case of the request. What came of it is told
  // while that case is shown.
  void start(int levels) override;

 protected:
  void attach() override;
  void refresh() override { show_reading(); }

 private:
  // For one case; given up with it.
  struct Reading {
    std::shared_ptr<engine::BackgroundJob> job;  // null: none
    QString problem;                             // to be told
    QString remark;                              // to be told

    Reading() = default;
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;
    ~Reading() { give_up(); }
    void give_up();
  };

  [[nodiscard]] bool is_reading() const;
  void choose();
  void cancel();
  void take(const Result<LoadedStart>& loaded, engine::CaseProxy* of);
  void show_reading();

  StartFile kind_;
  QLineEdit* path_;
  QPushButton* cancel_;             // while the file is read
  RefineChoice* refine_ = nullptr;  // of a mask
  PerCase<Reading> readings_;
};

}  // namespace tidemark::ui
