// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/tool_button.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"

#include <QAction>
#include <QFile>
#include <QGuiApplication>
#include <QPainter>
#include <QPixmap>
#include <QPixmapCache>
#include <QSvgRenderer>
#include <QToolButton>

// Resources of a static library register themselves only when asked to, outside of any namespace.
static void register_resources() {
  Q_INIT_RESOURCE(episcope);
}

namespace episcope {

namespace {

/// Draws an SVG whose `currentColor` is the palette's text color at the time of drawing.
class TintedSvgEngine : public PaintedIconEngine {
 public:
  TintedSvgEngine(QString path, QByteArray svg) : path_(std::move(path)), svg_(std::move(svg)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    QByteArray tinted = svg_;
    QSvgRenderer renderer(tinted.replace("currentColor", color(mode).name().toLatin1()));
    renderer.render(painter, rect);
  }
  [[nodiscard]] QIconEngine* clone() const override { return new TintedSvgEngine(path_, svg_); }

 protected:
  [[nodiscard]] QString look(QIcon::Mode mode) const override { return path_ + color(mode).name(); }

 private:
  static QColor color(QIcon::Mode mode) {
    const QPalette palette = QGuiApplication::palette();
    if (mode == QIcon::Disabled) return palette.color(QPalette::Disabled, QPalette::ButtonText);
    if (mode == QIcon::Selected) return palette.color(QPalette::HighlightedText);
    return palette.color(QPalette::ButtonText);
  }

  QString path_;
  QByteArray svg_;
};

QIcon drawn_icon(const QString& path) {
  register_resources();
  QFile file(":/episcope/" + path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QIcon(new TintedSvgEngine(path, file.readAll()));
}

}  // namespace

QIcon themed_icon(const QString& name) {
  return drawn_icon("icons/" + name + ".svg");
}

QIcon program_icon() {
  return drawn_icon("episcope.svg");
}

QPixmap PaintedIconEngine::pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) {
  const QString key =
      QStringLiteral("episcope icon %1x%2 ").arg(size.width()).arg(size.height()) + look(mode);
  QPixmap pixmap;
  if (QPixmapCache::find(key, &pixmap)) return pixmap;
  pixmap = QPixmap(size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  paint(&painter, {{0, 0}, size}, mode, state);
  painter.end();
  QPixmapCache::insert(key, pixmap);
  return pixmap;
}

QIcon swatch(const Rgb& rgb, const QPalette& palette) {
  QPixmap pixmap(2 * kSwatchSize, 2 * kSwatchSize);
  pixmap.setDevicePixelRatio(2);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme::blend(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.5));
  painter.setBrush(QColor(rgb[0], rgb[1], rgb[2]));
  painter.drawRoundedRect(QRectF(1.5, 1.5, kSwatchSize - 3, kSwatchSize - 3), 3, 3);
  painter.end();
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected);
  return icon;
}

QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent) {
  auto* button = named(text.name, new QToolButton(parent));
  button->setIcon(themed_icon(text.icon));
  button->setIconSize({14, 14});
  button->setToolTip(text.tip);
  if (text.text.isEmpty()) {
    button->setAccessibleName(text.tip);
  } else {
    button->setText(text.text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  return button;
}

QToolButton* make_action_button(QAction* action, QWidget* parent) {
  auto* button = named("button." + action->objectName(), new QToolButton(parent));
  button->setDefaultAction(action);
  button->setIconSize({16, 16});
  button->setFocusPolicy(Qt::NoFocus);
  return button;
}

void add_action_button(QBoxLayout* row, QAction* action) {
  row->insertWidget(row->count() - 1, make_action_button(action, row->parentWidget()));
}

void follow_tip(QWidget* widget, const QAction* action) {
  const auto follow = [widget, action] { widget->setToolTip(action->toolTip()); };
  QObject::connect(action, &QAction::changed, widget, follow);
  follow();
}

}  // namespace episcope
