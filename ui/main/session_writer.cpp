#include "ui/main/session_writer.h"

#include <QCloseEvent>
#include <utility>

#include "document/session_file.h"
#include "ui/main/main_window.h"
#include "ui/main/session_reader.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/question.h"

namespace tidemark::ui {

QString session_filter() {
  return SessionWriter::tr("Tidemark session (*.tidemark)");
}

SessionWriter::SessionWriter(MainWindow& window, CaseFiles& files)
    : QObject(&window), window_(window), files_(files) {
  // Later than within the answer of the case that goes.
  connect(&files, &CaseFiles::waits_no_more, this, &SessionWriter::close_after_exports, Qt::QueuedConnection);
}

void SessionWriter::save(CaseWindow& window) {
  window.session_file.isEmpty() ? save_as(window) : save_to(window, window.session_file);
}

void SessionWriter::save_as(CaseWindow& window) {
  const QString file = ask_for_file(window);
  if (!file.isEmpty()) save_to(window, file);
}

// One file is that of one case: two would write over each other's work.
QString SessionWriter::ask_for_file(CaseWindow& window) {
  const QString file = files_.ask_for_file(window, tr("Save the session"), session_filter());
  const CaseWindow* owner = window_.case_of_session(file);
  if (owner ? owner == &window : !window_.session_reader().reads(file)) return file;
  window_.tell(tr("%1 is the session of another open case. Choose another name.").arg(file));
  return {};
}

void SessionWriter::save_to(CaseWindow& window, const QString& file, CaseFiles::Ended ended) {
  const auto end = [file, ended = std::move(ended), saving = QPointer(&window)](bool written) {
    if (saving) saving->files_being_saved.removeOne(file);
    if (ended) ended(written);
  };
  const auto write = [this, file, end, saving = QPointer(&window)](const auto& snapshot) {
    if (!saving) return end(false);
    const auto work = [snapshot, path = path_of(file)] {
      return document::write_session(snapshot->contents, path);
    };
    files_.write(*saving, file, work, [this, file, saving, snapshot, end](bool written) {
      if (saving && written) {
        saving->session_file = file;
        saving->proxy().mark_saved(*snapshot);
        emit saved(*saving);
      }
      end(written);
    });
  };
  window.files_being_saved << file;
  window.proxy().take_snapshot(window.view_state(), write, [end] { end(false); });
}

void SessionWriter::close(CaseWindow& window, QCloseEvent* event) {
  if (closes_later(window)) return event->ignore();
  if (files_.waits_for(window)) {
    close_later(window, after_exports_);
    return event->ignore();
  }
  if (!window.proxy().state().modified) return event->accept();
  const auto answer = ask(&window_, tr("Close"),
                          tr("%1 has changes that are not in a session file.").arg(window.proxy().name()),
                          QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  event->setAccepted(answer == QMessageBox::Discard);
  if (answer != QMessageBox::Save) return;
  // It closes itself once the file is written.
  const QString file = window.session_file.isEmpty() ? ask_for_file(window) : window.session_file;
  if (file.isEmpty()) return;
  close_later(window, once_saved_);
  window.proxy().pause();
  save_to(window, file, [this, closing = QPointer(&window)](bool written) {
    if (!closing) return;
    if (!written) return keep_open(*closing);
    closing->proxy().after_commands([this, closing] {
      if (!closing) return;
      if (!closing->proxy().state().modified) return closing->close_saved();
      window_.tell(
          tr("%1 was changed while it was being saved, and stays open.").arg(closing->proxy().name()));
      keep_open(*closing);
    });
  });
}

void SessionWriter::close_later(const CaseWindow& window, QSet<const CaseWindow*>& when) {
  when << &window;
  connect(&window, &QObject::destroyed, this, [&when, key = &window] { when.remove(key); });
}

// Asked for anew, since it may have changes.
void SessionWriter::close_after_exports(const CaseWindow* window) {
  if (!after_exports_.remove(window)) return;
  const QPointer alive(window);
  window->parentWidget()->close();
  if (alive && !closes_later(*alive)) emit not_saved();
}

void SessionWriter::keep_open(const CaseWindow& window) {
  once_saved_.remove(&window);
  emit not_saved();
}

}  // namespace tidemark::ui
