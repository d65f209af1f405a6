// The parameters in which a part of a lesson differs, a row each.
#pragma once

#include <QMenu>
#include <QPushButton>
#include <QWidget>
#include <set>

#include "ui/lessons/parameter_names.h"
#include "ui/lessons/row_grid.h"

namespace tidemark::ui {

class ParameterRows : public QWidget {
  Q_OBJECT
 public:
  // The first `always` parameters have a row also where they do not differ, and keep it.
  explicit ParameterRows(std::size_t always, QWidget* parent = nullptr);

  // `parameters` is changed by the user, and must outlive the showing; null: none.
  void show_parameters(solver::Parameters* parameters, const solver::Parameters& base);

 signals:
  void edited();

 private:
  void fill();
  void fill_menu();
  void add_row(std::size_t index);
  [[nodiscard]] QWidget* make_editor(const NamedParameter& parameter);
  [[nodiscard]] QWidget* make_number(const NamedParameter& parameter, double solver::Parameters::*member);
  [[nodiscard]] QWidget* make_optional(const NamedParameter& parameter,
                                       std::optional<double> solver::Parameters::*member);
  [[nodiscard]] QWidget* make_choice(const NamedParameter& parameter, const QStringList& words, int index,
                                     const std::function<void(int)>& set);

  std::size_t always_;
  solver::Parameters* parameters_ = nullptr;
  solver::Parameters base_;
  std::set<std::size_t> opened_;  // have a row, though they may not differ yet
  RowGrid* rows_;
  QPushButton* add_;
  QMenu* menu_;
};

}  // namespace tidemark::ui
