// The dialog that writes a result for other systems as a file, polygons as a file for each segment.
#pragma once

#include <QLineEdit>

#include "engine/result_jobs.h"
#include "ui/results/result_dialog.h"

namespace tidemark::ui {

enum class ResultFile { segmentation, structure_set, level_set, meshes };

class WriteResultDialog : public ResultDialog {
  Q_OBJECT
 public:
  WriteResultDialog(CaseWindow& window, ResultFile kind);

 signals:
  void written(const QString& file);  // it closes then

 protected:
  [[nodiscard]] bool ready() const override { return !file_->text().trimmed().isEmpty(); }
  void confirm(std::function<void()> go_on) override;
  void begin(const Snapshot& snapshot) override;
  void give_up() override { jobs_.cancel(); }

 private:
  QWidget* make_target();
  void choose();
  [[nodiscard]] QStringList suffixes() const;  // the usual one first
  [[nodiscard]] QStringList files() const;     // that are written
  [[nodiscard]] QString usual_file() const;

  ResultFile kind_;
  engine::ResultJobs jobs_;
  QLineEdit* file_;
};

}  // namespace tidemark::ui
