// Figures of the surface, the labels and what was measured, for reading and for reports.
#pragma once

#include <filesystem>
#include <memory>

#include "ui/panels/panel.h"

class QLabel;
class QTableWidget;

namespace tidemark {

class BackgroundJob;
struct RegionRow;

class StatisticsPanel : public Panel {
  Q_OBJECT
 public:
  explicit StatisticsPanel(QWidget* parent = nullptr);
  ~StatisticsPanel() override;

  void copy() const;  // to the clipboard
  // Written away from the user interface; how it went is said in the panel.
  void export_csv(const std::filesystem::path& file);

 protected:
  void attach() override;
  void refresh() override;

 private:
  QWidget* make_surface();
  QWidget* make_tables();
  QWidget* make_buttons();
  void show_surface(const std::vector<RegionRow>& rows);
  void show_labels(const std::vector<RegionRow>& rows);
  void show_measurements(const std::vector<Measurement>& measurements);
  void choose_file();
  void say(const QString& message);

  QLabel* volume_;
  QLabel* area_;
  QLabel* voxels_;
  QLabel* mean_;
  QLabel* deviation_;
  QLabel* labels_title_;
  QTableWidget* labels_;
  QLabel* measurements_title_;
  QTableWidget* measured_;
  QLabel* message_;
  std::shared_ptr<BackgroundJob> writing_;
};

}  // namespace tidemark
