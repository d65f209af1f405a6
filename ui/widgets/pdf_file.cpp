#include "ui/widgets/pdf_file.h"

#include <QPdfWriter>
#include <QTextDocument>

#include "core/atomic_file.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {

Status write_pdf_file(const QString& html, const QString& title, const std::filesystem::path& file) {
  constexpr int kResolution = 300;  // dots per inch
  constexpr double kMargin = 18.0;  // mm
  auto target = AtomicFile::create(file);
  if (!target) return pass_on(target);
  {
    QPdfWriter writer(text_of(target->temporary_path()));
    writer.setResolution(kResolution);
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins(QMarginsF(kMargin, kMargin, kMargin, kMargin), QPageLayout::Millimeter);
    writer.setTitle(title);
    writer.setCreator(QStringLiteral("Tidemark"));
    QTextDocument document;
    document.setHtml(html);
    document.print(&writer);
  }
  std::error_code error;
  if (std::filesystem::file_size(target->temporary_path(), error) == 0 || error) {
    return fail(ErrorKind::write, "{}: cannot be written", file.string());
  }
  return target->commit();
}

}  // namespace tidemark::ui
