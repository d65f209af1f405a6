// The editor of how the values of a case's volume and its surface show (paper section 6.2).
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QTabWidget>
#include <filesystem>
#include <optional>

#include "engine/display.h"
#include "engine/source_summary.h"

namespace tidemark::ui {

class HistogramPlot;
class JointHistogramPlot;
class PresetPicker;
class PrimitivePage;
enum class PrimitiveKind;
struct AxisPrimitive;

// Everything is read from the display and written to it at once: there is nothing to apply. A hidden editor
// draws nothing.
class TransferFunctionEditor : public QWidget {
  Q_OBJECT
 public:
  explicit TransferFunctionEditor(QWidget* parent = nullptr);

  // Sets the display to edit; null: none. `unit` is that of the volume's values ("HU"), empty when it has
  // none.
  void set_display(engine::Display* display, const engine::SourceSummary* summary, const QString& unit = {});

  // Loads a file in the presets' format. An error is shown, and changes nothing.
  void load(const std::filesystem::path& file);
  void save(const std::filesystem::path& file);

  [[nodiscard]] PrimitivePage* volume_page() const { return volume_page_; }
  [[nodiscard]] PrimitivePage* surface_page() const { return surface_page_; }
  [[nodiscard]] PresetPicker* presets() const { return presets_; }
  [[nodiscard]] QComboBox* region_box() const { return region_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }
  [[nodiscard]] QString message() const { return message_->text(); }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* make_top_row();
  QWidget* make_volume_tab();
  QWidget* make_surface_tab();
  void refresh();
  void show_volume();
  void refresh_axes();
  void replace(const renderer::TransferFunction& function);
  void edit(PrimitiveKind kind, const std::vector<AxisPrimitive>& primitives, int chosen);
  void say(const QString& message);
  void ask_load();
  void ask_save();

  QPointer<engine::Display> display_;
  engine::SourceSummary summary_;
  QString unit_;
  std::optional<engine::DisplaySettings> shown_;  // the settings that the widgets show
  bool new_volume_ = true;                        // of which nothing is drawn yet
  int surface_chosen_ = 0;

  QWidget* top_row_;
  PresetPicker* presets_;
  QPushButton* save_;
  QLabel* message_;
  QTabWidget* tabs_;
  QCheckBox* show_source_;
  QComboBox* region_;
  HistogramPlot* histogram_;
  JointHistogramPlot* joint_;
  JointHistogramPlot* surface_plane_;
  PrimitivePage* volume_page_;
  PrimitivePage* surface_page_;
};

}  // namespace tidemark::ui
