#include "ui/look/about_dialog.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

constexpr ThirdPartyPart kParts[] = {
    {"Qt 6", "LGPL-3.0-only", QT_TRANSLATE_NOOP("About", "windows and widgets")},
    {"DCMTK", "BSD-3-Clause", QT_TRANSLATE_NOOP("About", "DICOM")},
    {"OpenJPEG", "BSD-2-Clause", QT_TRANSLATE_NOOP("About", "JPEG 2000")},
    {"ITK", "Apache-2.0", QT_TRANSLATE_NOOP("About", "NIfTI, NRRD, MetaImage and GIPL; smoothing")},
    {"OpenVDB", "MPL-2.0", QT_TRANSLATE_NOOP("About", "polygons from the surface")},
    {"Highway", "Apache-2.0", QT_TRANSLATE_NOOP("About", "vector instructions")},
    {"GLM", "MIT", QT_TRANSLATE_NOOP("About", "vectors and matrices")},
    {"libepoxy", "MIT", QT_TRANSLATE_NOOP("About", "OpenGL's functions")},
    {"fmt", "MIT", QT_TRANSLATE_NOOP("About", "text of messages")},
    {"spdlog", "MIT", QT_TRANSLATE_NOOP("About", "logs")},
    {"tl::expected", "CC0-1.0", QT_TRANSLATE_NOOP("About", "errors as values")},
    {"JSON for Modern C++", "MIT", QT_TRANSLATE_NOOP("About", "recipes, presets and figures")},
    {"CLI11", "BSD-3-Clause", QT_TRANSLATE_NOOP("About", "the command line")},
    {"libzip", "BSD-3-Clause", QT_TRANSLATE_NOOP("About", "session files")},
    {"OpenSSL", "Apache-2.0", QT_TRANSLATE_NOOP("About", "checksums")},
    {"zlib", "Zlib", QT_TRANSLATE_NOOP("About", "compressed files")},
    {"libpng", "libpng-2.0", QT_TRANSLATE_NOOP("About", "pictures")},
    {"giflib", "MIT", QT_TRANSLATE_NOOP("About", "films")},
};

QLabel* paragraph(const QString& text) {
  auto* label = new QLabel(text);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextBrowserInteraction);
  label->setOpenExternalLinks(true);
  return label;
}

QLayout* heading() {
  auto* picture = new QLabel;
  picture->setPixmap(application_icon().pixmap(64, 64));
  auto* name = new QLabel(QStringLiteral("Tidemark"));
  QFont font = name->font();
  font.setPointSizeF(font.pointSizeF() * 1.8);
  name->setFont(font);
  auto* version = new QLabel(AboutDialog::tr("Version %1").arg(QStringLiteral(TIDEMARK_VERSION)));
  version->setObjectName(QStringLiteral("version"));
  version->setTextInteractionFlags(Qt::TextSelectableByMouse);

  auto* words = new QVBoxLayout;
  words->setSpacing(0);
  words->addStretch();
  words->addWidget(name);
  words->addWidget(version);
  words->addStretch();
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceGroups);
  row->addWidget(picture);
  row->addLayout(words, 1);
  return row;
}

// Loud enough to be noticed, without a colour that has another meaning.
QWidget* warning() {
  auto* sign = new QLabel;
  sign->setPixmap(icon(u"warning").pixmap(24, 24));
  auto* text = new QLabel(AboutDialog::tr("Research use only. Not for diagnostic use."));
  text->setObjectName(QStringLiteral("claim"));
  QFont font = text->font();
  font.setBold(true);
  text->setFont(font);
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  row->addWidget(sign);
  row->addWidget(text, 1);
  return box;
}

QTableWidget* parts_table() {
  const auto parts = third_party_parts();
  auto* table = new QTableWidget(static_cast<int>(parts.size()), 3);
  table->setObjectName(QStringLiteral("parts"));
  table->setAccessibleName(AboutDialog::tr("Third-party parts"));
  table->setHorizontalHeaderLabels(
      {AboutDialog::tr("Component"), AboutDialog::tr("Licence"), AboutDialog::tr("What it is for")});
  for (int row = 0; row < table->rowCount(); ++row) {
    const ThirdPartyPart& part = parts[static_cast<std::size_t>(row)];
    int column = 0;
    for (const QString& cell : {QString::fromLatin1(part.name), QString::fromLatin1(part.licence),
                                QCoreApplication::translate("About", part.purpose)}) {
      table->setItem(row, column++, new QTableWidgetItem(cell));
    }
  }
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setAlternatingRowColors(true);
  table->setShowGrid(false);
  table->setTabKeyNavigation(false);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(24);
  table->horizontalHeader()->setHighlightSections(false);
  table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table->resizeColumnsToContents();
  table->horizontalHeader()->setStretchLastSection(true);
  return table;
}

}  // namespace

std::span<const ThirdPartyPart> third_party_parts() {
  return kParts;
}

AboutDialog::AboutDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("About Tidemark"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(kSpaceGroups, kSpaceGroups, kSpaceGroups, kSpaceGroups);
  layout->setSpacing(kSpaceGroups);
  layout->addLayout(heading());
  layout->addWidget(warning());
  layout->addWidget(paragraph(
      tr("Segments medical volumes by steering a level-set surface while it evolves. The method is that of "
         "A. E. Lefohn, J. M. Kniss, C. D. Hansen and R. T. Whitaker, “A Streaming Narrow-Band Algorithm: "
         "Interactive Computation and Visualization of Level Sets”, IEEE Transactions on Visualization and "
         "Computer Graphics 10(4), pages 422–433, 2004.")));
  layout->addWidget(paragraph(
      tr("Licensed under the <a href=\"https://www.apache.org/licenses/LICENSE-2.0\">Apache License 2.0</a>, "
         "without warranty of any kind. It runs with these parts of others:")));
  layout->addWidget(parts_table(), 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(buttons);
  resize(560, 620);
}

}  // namespace tidemark::ui
