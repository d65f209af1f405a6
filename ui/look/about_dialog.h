// The dialog About: the program, its intended use and its parts.
#pragma once

#include <QDialog>
#include <span>

namespace tidemark::ui {

// A part of others that runs with Tidemark. docs/third-party.md says more about each.
struct ThirdPartyPart {
  const char* name;
  const char* licence;  // SPDX
  const char* purpose;
};
std::span<const ThirdPartyPart> third_party_parts();

class AboutDialog : public QDialog {
  Q_OBJECT
 public:
  explicit AboutDialog(QWidget* parent = nullptr);
};

}  // namespace tidemark::ui
