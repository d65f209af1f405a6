// All that the passes make of a page, as cards in the order of the steps.
#pragma once

#include <QList>
#include <memory>

#include "engine/case_passes.h"
#include "ui/passes/message_bits.h"
#include "ui/passes/page_map.h"
#include "ui/passes/pass_card.h"
#include "ui/passes/texel_picture.h"

class QLabel;

namespace tidemark::ui {

class PassCards : public CardColumns {
  Q_OBJECT
 public:
  explicit PassCards(QWidget* parent = nullptr);

  // Null: there is nothing to show.
  void show_record(const std::shared_ptr<const engine::RecordedStep>& recorded);

 private:
  void add_address();
  void add_substreams();
  void add_derivatives();
  void add_speeds();
  void add_update();
  void add_message();
  QList<TexelPicture*> add_row(PassCard& card, const QStringList& names, int side, const QString& title = {},
                               const QString& tip = {});

  void show_address(const solver::PassRecord& record);
  void show_phi(const solver::PassRecord& record);
  void show_steps(const solver::PassRecord& record);
  void show_message(const solver::PassRecord& record);
  void clear();

  std::shared_ptr<const engine::RecordedStep> shown_;
  PageMap* virtual_pages_ = nullptr;
  PageMap* physical_pages_ = nullptr;
  QLabel* address_ = nullptr;
  TexelPicture* phi_ = nullptr;
  TexelPicture* substreams_ = nullptr;
  QList<TexelPicture*> slices_;                      // below and above
  std::array<QList<TexelPicture*>, 4> differences_;  // a buffer a row
  QList<TexelPicture*> speeds_;
  QList<TexelPicture*> update_;  // phi, new phi, change
  std::array<QList<TexelPicture*>, 2> across_;
  MessageBits* bits_ = nullptr;
  QLabel* code_ = nullptr;
  QLabel* decision_ = nullptr;
};

}  // namespace tidemark::ui
