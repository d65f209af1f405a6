// Pages as a map of small squares: a slice of V_P, or G_P (paper, figures 5 and 7).
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

namespace tidemark::ui {

class PageMap : public QWidget {
  Q_OBJECT
 public:
  enum class Page : char { outside, inside, resident, unused };
  struct Content {
    int columns = 0;
    std::vector<Page> pages;  // x fastest
    int chosen = -1;          // of them
  };

  explicit PageMap(const QString& name, QWidget* parent = nullptr);

  void show_content(Content content);
  [[nodiscard]] const Content& content() const { return content_; }

  [[nodiscard]] QSize sizeHint() const override { return {120, kHeight}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {80, kHeight}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  static constexpr int kHeight = 92;

  QString name_;
  Content content_;
};

}  // namespace tidemark::ui
