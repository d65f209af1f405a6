#include "ui/widgets/pdf_file.h"

#include <QBuffer>
#include <QPdfWriter>
#include <QTextDocument>

#include "core/atomic_file.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {

bool is_pdf_name(const std::filesystem::path& file) {
  return text_of(file.extension()).compare(QLatin1String(".pdf"), Qt::CaseInsensitive) == 0;
}

// By way of memory: a QPdfWriter tells of no write that fails.
Status write_pdf_file(const QString& html, const QString& title, const std::filesystem::path& file) {
  constexpr int kResolution = 300;  // dots per inch
  constexpr double kMargin = 18.0;  // mm
  QBuffer pages;
  pages.open(QIODevice::WriteOnly);
  {
    QPdfWriter writer(&pages);
    writer.setResolution(kResolution);
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins(QMarginsF(kMargin, kMargin, kMargin, kMargin), QPageLayout::Millimeter);
    writer.setTitle(title);
    writer.setCreator(QStringLiteral("Tidemark"));
    QTextDocument document;
    document.setHtml(html);
    document.print(&writer);
  }
  return write_file(file, pages.data().toStdString());
}

}  // namespace tidemark::ui
