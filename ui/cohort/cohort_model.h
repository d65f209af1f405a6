// The cases of a cohort as a list, with the pictures that runs have made.
#pragma once

#include <QAbstractListModel>
#include <QString>
#include <memory>
#include <vector>

#include "document/cohort/review_list.h"

namespace tidemark::ui {

class CasePictures;

class CohortModel : public QAbstractListModel {
  Q_OBJECT
 public:
  CohortModel(cohort::CohortFolder folder, std::vector<cohort::ReviewEntry> entries,
              QObject* parent = nullptr);
  ~CohortModel() override;

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

  [[nodiscard]] const cohort::ReviewEntry& at(int row) const {
    return entries_[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] int row_of(const std::string& id) const;  // -1: none
  void set_decision(const cohort::Decision& decision);
  void set_status(const cohort::CaseStatus& status);  // its picture is read again
  // "47 cases: 12 accepted, 3 rejected"
  [[nodiscard]] QString summary() const;
  // What the list has no room for: why there is no result, and what reading has found.
  [[nodiscard]] QString details(int row) const;

 private:
  [[nodiscard]] QString picture_file(const std::string& id) const;
  [[nodiscard]] QString text_of(const cohort::ReviewEntry& entry) const;

  cohort::CohortFolder folder_;
  std::vector<cohort::ReviewEntry> entries_;
  std::unique_ptr<CasePictures> pictures_;
};

}  // namespace tidemark::ui
