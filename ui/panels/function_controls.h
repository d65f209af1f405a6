// The choice of the speed functions that drive the surface, and how several are joined.
#pragma once

#include <functional>
#include <optional>

#include "solver/speed/speed_registry.h"
#include "ui/panels/case_widget.h"

class QComboBox;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace tidemark::ui {

class MapChoice;
class TermControls;

class FunctionControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit FunctionControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_joining(QVBoxLayout& column);
  void show_terms(const solver::SpeedSetting& setting);
  void choose(std::size_t place, const QString& function);
  void add_term();
  void add_map_choice(QVBoxLayout& column);
  void take_map(const std::shared_ptr<const document::SpeedMap>& map);
  void say(const QString& problem);
  void change(const std::function<void(solver::SpeedSetting&)>& apply, std::uint64_t gesture = 0);
  // Why the case cannot be driven by it yet; empty: it can.
  [[nodiscard]] QString obstacle(const solver::SpeedKind& kind) const;

  QVBoxLayout* list_;
  std::vector<TermControls*> terms_;
  QWidget* joining_;
  QComboBox* combine_;
  QPushButton* add_;
  QLabel* problem_;
  MapChoice* map_;
  std::optional<std::size_t> place_of_map_;  // of a function that waits for its map
};

}  // namespace tidemark::ui
