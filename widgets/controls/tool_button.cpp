// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/tool_button.h"

#include "widgets/controls/theme.h"

#include <QAction>
#include <QEvent>
#include <QFile>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QPixmapCache>
#include <QSvgRenderer>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

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

QToolButton* make_action_button(QAction* action, const QString& object_name, QWidget* parent) {
  auto* button = named(object_name, new QToolButton(parent));
  button->setDefaultAction(action);
  button->setIconSize({16, 16});
  button->setFocusPolicy(Qt::NoFocus);
  return button;
}

void follow_tip(QWidget* widget, const QAction* action) {
  const auto follow = [widget, action] { widget->setToolTip(action->toolTip()); };
  QObject::connect(action, &QAction::changed, widget, follow);
  follow();
}

namespace {

template <class Layout>
Layout* fill(Layout* layout, std::initializer_list<LayoutPart> parts, const LayoutLook& look) {
  layout->setContentsMargins(look.margins);
  layout->setSpacing(look.spacing);
  for (const LayoutPart& part : parts) {
    if (part.widget) {
      layout->addWidget(part.widget, part.share);
    } else if (part.layout) {
      layout->addLayout(part.layout, part.share);
    } else {
      layout->addStretch(part.share);
    }
  }
  return layout;
}

}  // namespace

QVBoxLayout* make_column(QWidget* place, std::initializer_list<LayoutPart> parts,
                         const LayoutLook& look) {
  return fill(new QVBoxLayout(place), parts, look);
}

QHBoxLayout* make_row(QWidget* place, std::initializer_list<LayoutPart> parts,
                      const LayoutLook& look) {
  return fill(new QHBoxLayout(place), parts, look);
}

QHBoxLayout* make_row(std::initializer_list<LayoutPart> parts, const LayoutLook& look) {
  return make_row(nullptr, parts, look);
}

void lay_out_list(QWidget* panel, QLabel* hint, QWidget* list,
                  std::initializer_list<QToolButton*> buttons) {
  hint->setAlignment(Qt::AlignCenter);
  hint->setWordWrap(true);
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (auto* button : buttons) row->addWidget(button);
  row->addStretch(1);
  make_column(panel, {{hint, 1}, {list, 1}, row}, {.spacing = 4});
}

FittingSplitter::FittingSplitter(int least_rest, QWidget* parent)
    : QSplitter(Qt::Vertical, parent), least_rest_(least_rest) {
  setChildrenCollapsible(false);
  connect(this, &QSplitter::splitterMoved, this, [this] { is_dragged_ = true; });
}

bool FittingSplitter::event(QEvent* event) {
  const bool is_handled = QSplitter::event(event);
  if (event->type() == QEvent::LayoutRequest) fit();
  return is_handled;
}

void FittingSplitter::resizeEvent(QResizeEvent* event) {
  QSplitter::resizeEvent(event);
  fit();
}

void FittingSplitter::fit() {
  if (is_dragged_ || count() != 2) return;
  const int room = height() - handleWidth();
  const int wanted = std::min(widget(0)->sizeHint().height(), room - least_rest_);
  setSizes({wanted, room - wanted});
}

namespace {

constexpr int kAsideGap = 14;
constexpr int kAsidePadding = 4;

}  // namespace

AsideDelegate::AsideDelegate(Place place, QObject* parent)
    : QStyledItemDelegate(parent), place_(place) {}

int AsideDelegate::begin(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  if (place_ == Place::End) {
    return QStyledItemDelegate::sizeHint(option, index).width() + kAsideGap;
  }
  int widest = 0;
  for (int row = 0; row < index.model()->rowCount(index.parent()); ++row) {
    const QModelIndex each = index.siblingAtRow(row);
    widest = std::max(widest, QStyledItemDelegate::sizeHint(option, each).width());
  }
  return widest + kAsideGap;
}

void AsideDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const {
  QStyledItemDelegate::paint(painter, option, index);
  const QRect rect = option.rect.adjusted(begin(option, index), 0, -kAsidePadding, 0);
  const bool is_selected = option.state.testFlag(QStyle::State_Selected);
  painter->save();
  painter->setFont(option.font);
  painter->setPen(is_selected ? option.palette.color(QPalette::HighlightedText)
                              : theme::muted_text(option.palette));
  const QString text = option.fontMetrics.elidedText(index.data(kAsideRole).toString(),
                                                     Qt::ElideRight, rect.width());
  const auto side = place_ == Place::End ? Qt::AlignRight : Qt::AlignLeft;
  painter->drawText(rect, Qt::AlignVCenter | side | Qt::TextSingleLine, text);
  painter->restore();
}

void AsideDelegate::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
  QStyledItemDelegate::initStyleOption(option, index);
  if (place_ == Place::Column) return;
  const int aside = option->fontMetrics.horizontalAdvance(index.data(kAsideRole).toString());
  const int room = option->rect.width() - aside - kAsideGap - 4 * kAsidePadding;
  option->text = option->fontMetrics.elidedText(option->text, option->textElideMode, room);
}

QSize AsideDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QSize size = QStyledItemDelegate::sizeHint(option, index);
  if (place_ == Place::End) return {0, size.height()};  // no wider than the list
  const int aside = option.fontMetrics.horizontalAdvance(index.data(kAsideRole).toString());
  return {begin(option, index) + aside + kAsidePadding, size.height()};
}

}  // namespace episcope

#include "moc_tool_button.cpp"
