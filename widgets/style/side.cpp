// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/side.h"

#include "widgets/style/painted_icon_engine.h"

#include <QPainter>

#include <algorithm>

namespace episcope {
namespace {

class SideIconEngine : public PaintedIconEngine {
 public:
  explicit SideIconEngine(Side side) : side_(side) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode, QIcon::State) override {
    draw_side(*painter, rect, side_);
  }
  [[nodiscard]] QIconEngine* clone() const override { return new SideIconEngine(side_); }

 protected:
  [[nodiscard]] QString look(QIcon::Mode) const override { return "side " + side_letter(side_); }

 private:
  Side side_;
};

}  // namespace

QString side_letter(Side side) {
  return side == Side::None ? QString() : QString(side == Side::A ? "A" : "B");
}

QColor side_color(Side side) {
  return side == Side::B ? QColor(0xb4, 0x53, 0x09) : QColor(0x1d, 0x64, 0xb4);
}

QIcon side_icon(Side side) {
  return side == Side::None ? QIcon() : QIcon(new SideIconEngine(side));
}

void draw_side(QPainter& painter, const QRectF& badge, Side side) {
  if (side == Side::None) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(side_color(side));
  painter.drawRoundedRect(badge, 3, 3);
  QFont font = painter.font();
  font.setBold(true);
  font.setPixelSize(static_cast<int>(std::max(8.0, badge.height() * 0.72)));
  painter.setFont(font);
  painter.setPen(Qt::white);
  painter.drawText(badge, Qt::AlignCenter, side_letter(side));
  painter.restore();
}

}  // namespace episcope
