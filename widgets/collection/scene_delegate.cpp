// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/collection/scene_delegate.h"

#include "widgets/collection/scene_list.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QPainter>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kLines = 3;
constexpr int kPadding = 6;
constexpr double kThumbnailAspect = 4.0 / 3;
constexpr int kMarkWidth = 3;

int line_height(const QStyleOptionViewItem& option) {
  return option.fontMetrics.height() + 2;
}

QRect thumbnail_place(const QStyleOptionViewItem& option) {
  const int height = kLines * line_height(option);
  return {option.rect.left() + kPadding, option.rect.top() + kPadding,
          static_cast<int>(height * kThumbnailAspect), height};
}

void paint_thumbnail(QPainter* painter, const QRect& place, const QImage& image) {
  painter->fillRect(place, theme::kCanvas);
  if (image.isNull()) return;
  const qreal ratio = painter->device()->devicePixelRatioF();
  QImage scaled = image.scaled(place.size() * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  scaled.setDevicePixelRatio(ratio);
  QRect target({}, scaled.deviceIndependentSize().toSize());
  target.moveCenter(place.center());
  painter->drawImage(target.topLeft(), scaled);
}

struct Line {
  QString text;
  QColor color;
  bool is_bold = false;
};

std::vector<Line> lines_of(const QStyleOptionViewItem& option, const QModelIndex& index) {
  const bool is_selected = option.state.testFlag(QStyle::State_Selected);
  const QPalette& palette = option.palette;
  const QColor text = palette.color(is_selected ? QPalette::HighlightedText : QPalette::Text);
  const QColor quiet = is_selected ? text : theme::muted_text(palette);
  const QString problem = index.data(SceneList::kProblem).toString();
  const QString shape = index.data(SceneList::kShape).toString();
  QString form = index.data(SceneList::kForm).toString();
  if (!shape.isEmpty()) form += QStringLiteral(" · ") + shape;
  const QString parts = index.data(SceneList::kParts).toStringList().join(QStringLiteral(" · "));
  const bool is_bad = !problem.isEmpty();
  return {{index.data(Qt::DisplayRole).toString(), text, true},
          {form, quiet},
          {is_bad ? problem : parts, is_bad && !is_selected ? theme::error_text(palette) : quiet}};
}

}  // namespace

QSize SceneDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
  return {10 * kPadding, kLines * line_height(option) + 2 * kPadding};
}

void SceneDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const {
  painter->save();
  const QStyle* style = option.widget ? option.widget->style() : QApplication::style();
  style->drawPrimitive(QStyle::PE_PanelItemViewItem, &option, painter, option.widget);
  if (index.data(SceneList::kIsOpen).toBool()) {
    painter->fillRect(QRect(option.rect.topLeft(), QSize(kMarkWidth, option.rect.height())),
                      option.palette.color(QPalette::Highlight));
  }
  const QRect picture = thumbnail_place(option);
  paint_thumbnail(painter, picture, index.data(Qt::DecorationRole).value<QImage>());
  const int left = picture.right() + 1 + 2 * kPadding;
  const int width = std::max(0, option.rect.right() - kPadding - left);
  int top = picture.top();
  for (const Line& line : lines_of(option, index)) {
    QFont font = option.font;
    font.setBold(line.is_bold);
    painter->setFont(font);
    painter->setPen(line.color);
    const QRect place(left, top, width, line_height(option));
    painter->drawText(place, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                      QFontMetrics(font).elidedText(line.text, Qt::ElideRight, width));
    top += line_height(option);
  }
  painter->restore();
}

}  // namespace episcope

#include "moc_scene_delegate.cpp"
