#include "ui/main/status_bar.h"

#include <QLabel>
#include <QToolButton>

#include "engine/message_text.h"
#include "ui/main/value_bar.h"
#include "ui/settings.h"

namespace tidemark::ui {

StatusBar::StatusBar(const engine::Engine& engine, QWidget* parent)
    : QStatusBar(parent), values_(new ValueBar), value_details_(new QToolButton) {
  addWidget(values_, 1);
  value_details_->setText(tr("Details"));
  value_details_->setAccessibleName(tr("Details of the values under the mouse"));
  value_details_->setToolTip(tr("Shows also the terms of the equation under the mouse: D, φ, κ and |∇φ|."));
  value_details_->setAutoRaise(true);
  value_details_->setCheckable(true);
  connect(value_details_, &QToolButton::toggled, values_, &ValueBar::set_detailed);
  connect(value_details_, &QToolButton::clicked, this, [](bool on) { settings::details("values").set(on); });
  value_details_->setChecked(settings::details("values").get());
  value_details_->hide();  // until there is a case
  addPermanentWidget(value_details_);
  note_renderer(engine);
}

void StatusBar::set_proxy(engine::CaseProxy* proxy) {
  values_->set_proxy(proxy);
  value_details_->setVisible(proxy != nullptr);
}

// Where the processor does what a GPU would do.
void StatusBar::note_renderer(const engine::Engine& engine) {
  const bool drawn_by_host = engine.renderer() == renderer::RendererKind::host;
  const bool has_gpu = engine.graphics() == engine::Engine::Graphics::hardware;
  if (has_gpu && !drawn_by_host) return;
  auto* note = new QLabel(drawn_by_host ? tr("Drawn by the processor") : tr("Software OpenGL"));
  note->setObjectName(QStringLiteral("renderer note"));
  QStringList text(drawn_by_host ? tr("The processor draws the pictures: %1.")
                                 : tr("OpenGL draws the pictures, but the processor plays the GPU: %1."));
  text.front() = text.front().arg(engine::message_text(engine.renderer_reason()));
  if (engine.graphics() == engine::Engine::Graphics::none) {
    text << tr("OpenGL: %1.").arg(engine::message_text(engine.graphics_problem()));
  }
  if (!engine.renderer_problem().empty()) text << engine::message_text(engine.renderer_problem()) + '.';
  if (!has_gpu) text << tr("The automatic executor is the host's, the processor, too.");
  note->setToolTip(text.join(QChar(' ')));
  addPermanentWidget(note);
}

}  // namespace tidemark::ui
