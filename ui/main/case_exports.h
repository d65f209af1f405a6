// The export of a case's results for other programs.
#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "engine/weak_receiver.h"
#include "ui/main/case_window.h"

namespace tidemark::ui {

class CaseFiles;
class MainWindow;

class CaseExports : public QObject {
  Q_OBJECT
 public:
  CaseExports(MainWindow& window, CaseFiles& files);
  ~CaseExports() override;

  // Ask where to.
  void export_mask(CaseWindow& window);
  void export_mesh(CaseWindow& window);
  void export_picture(CaseWindow& window);
  void export_statistics(CaseWindow& window);
  void export_report(CaseWindow& window);
  void export_recipe(CaseWindow& window);
  void export_comparison(CaseWindow& window, const std::string& csv);  // of readers

  // The same without asking. The suffix says which format.
  void write_mask(CaseWindow& window, const QString& file);
  void write_labels(CaseWindow& window, const QString& file);
  void write_surface(CaseWindow& window, const QString& file);
  void write_picture(CaseWindow& window, const QString& file);
  void write_statistics(CaseWindow& window, const QString& file);
  // The case pauses: all of a report is of one moment.
  void write_report(CaseWindow& window, const QString& file);

 private:
  enum class Voxels { nothing, surface, labels };
  Voxels ask_for_voxels(const CaseWindow& window);  // `nothing` when given up

  MainWindow& window_;
  CaseFiles& files_;
  std::shared_ptr<engine::WeakReceiver> receiver_;
};

}  // namespace tidemark::ui
