// A model on a server of the site: asked about the case with the clicks of its strokes, and what it has found
// as the surface, as labels or as what drives the surface.
#pragma once

#include <QPointer>
#include <QSet>
#include <memory>

#include "engine/model_client.h"
#include "ui/panels/case_widget.h"
#include "ui/panels/per_case.h"

class QLabel;
class QPushButton;
class QToolButton;

namespace tidemark::ui {

class Form;
class ModelChoice;
class WorkLine;

// Hidden where the site names no server. A question and its answer belong to the case that was shown when
// they were asked for: an answer to another case waits until that is shown.
class ModelControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ModelControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  // What is kept of a case as long as it is open.
  struct OfCase {
    QSet<QString> allowed;  // where the user lets its voxels go
    std::shared_ptr<const engine::ModelFinding> finding;
    QString said;
  };

  void add_question(Form& form);
  void add_answer(Form& form);
  void connect_client();
  void ask();
  [[nodiscard]] bool may_send();
  void take(std::shared_ptr<const engine::ModelFinding> finding);
  void use_as_surface();
  void use_as_labels();
  void use_as_speed();
  void drive_by(const std::shared_ptr<const document::SpeedMap>& map);
  void begin(const QString& what);
  void end(const QString& said);
  [[nodiscard]] QString clicks_text() const;
  [[nodiscard]] static QString finding_text(const engine::ModelFinding& finding);

  engine::ModelClient client_;
  QPointer<engine::CaseProxy> asked_;  // the case of what the client does
  PerCase<OfCase> cases_;
  QWidget* content_;
  ModelChoice* choice_;
  QLabel* clicks_;
  QToolButton* tool_;
  QPushButton* ask_;
  WorkLine* work_;
  QWidget* answer_;
  QLabel* found_;
  std::shared_ptr<const solver::Strokes> counted_;
};

}  // namespace tidemark::ui
