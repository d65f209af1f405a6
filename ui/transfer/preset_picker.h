// The presets, each with a small picture of itself.
#pragma once

#include <QComboBox>
#include <vector>

#include "engine/source_summary.h"
#include "renderer/transfer_function.h"

namespace tidemark::ui {

class PresetPicker : public QComboBox {
  Q_OBJECT
 public:
  explicit PresetPicker(QWidget* parent = nullptr);

  // Draws the pictures over this histogram.
  void set_summary(const engine::SourceSummary& summary);
  // Shows which preset this is, in the source's units, if it is one.
  void show_function(const renderer::TransferFunction& function);

 signals:
  void picked(const tidemark::renderer::TransferFunction& preset);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void draw_pictures();

  std::vector<renderer::TransferFunction> presets_;
  engine::SourceSummary summary_;
};

}  // namespace tidemark::ui
