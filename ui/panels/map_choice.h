// The choice of a file with the map that drives the surface.
#pragma once

#include <memory>

#include "core/result.h"
#include "document/drive.h"
#include "engine/background_job.h"
#include "ui/panels/case_widget.h"

class QLabel;
class QPushButton;

namespace tidemark::ui {

class MapChoice : public CaseWidget {
  Q_OBJECT
 public:
  explicit MapChoice(QWidget* parent = nullptr);
  ~MapChoice() override;

 signals:
  // Read from the file, for the case that is shown.
  void chosen(const std::shared_ptr<const document::SpeedMap>& map);
  void failed(const QString& message);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void choose();
  void read(const QString& file);
  void take(const Result<std::shared_ptr<const document::SpeedMap>>& map);
  void give_up();

  QPushButton* button_;
  QLabel* name_;
  QLabel* remark_;
  std::shared_ptr<engine::BackgroundJob> reading_;  // null: none
};

}  // namespace tidemark::ui
