#include "ui/panels/panel.h"

#include <QLabel>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {

Panel::Panel(const QString& hint, QWidget* parent)
    : CaseWidget(parent), hint_(make_note(hint)), content_(new QWidget), parts_(new QVBoxLayout(content_)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->setSpacing(kSpace);
  column->addWidget(hint_);
  column->addWidget(content_);
  column->addStretch(1);
  parts_->setContentsMargins(0, 0, 0, 0);
  parts_->setSpacing(kSpaceGroups);
  content_->setEnabled(false);
}

void Panel::add(QWidget* part) {
  parts_->addWidget(part);
}

void Panel::add(CaseWidget* part) {
  parts_->addWidget(part);
  proxy_parts_.push_back(part);
  part->set_proxy(proxy());
}

void Panel::fill_height() {
  auto* column = static_cast<QVBoxLayout*>(layout());
  delete column->takeAt(column->count() - 1);  // the space below the parts
  column->setStretchFactor(content_, 1);
  parts_->setStretch(0, 1);
}

void Panel::attach() {
  hint_->setVisible(proxy() == nullptr);
  content_->setEnabled(proxy() != nullptr);
  for (CaseWidget* part : proxy_parts_) part->set_proxy(proxy());
}

}  // namespace tidemark::ui
