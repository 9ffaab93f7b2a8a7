// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_help.h"

#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

namespace episcope {

QString parameter_help(const ParameterDescription& description) {
  const QString domain = domain_text(description);
  QStringList facts;
  if (!domain.isEmpty()) facts << ParameterHelp::tr("Range %1").arg(with_minus(domain));
  facts << ParameterHelp::tr("Default %1").arg(value_text(description, description.default_value));
  return QString("<p><b>%1</b></p><p>%2</p><p>%3<br/><code>--%4</code></p>")
      .arg(schema_text(description.label).toHtmlEscaped(),
           schema_text(description.help).toHtmlEscaped(), facts.join(" · ").toHtmlEscaped(),
           QString::fromStdString(description.key).replace('_', '-').toHtmlEscaped());
}

namespace {

constexpr int kTextWidth = 300;
constexpr QSize kPictureSize(300, 96);
constexpr int kSamples = 120;

/// What is drawn: the place, the colors, and the value, as a number and as a part of its domain.
struct Canvas {
  QPainter& painter;
  QRectF place;
  QColor quiet;
  QColor strong;
  double value = 0;
  double part = 0;  ///< 0 at the least value, 1 at the largest.

  /// A point of the unit square; y points up.
  [[nodiscard]] QPointF at(double x, double y) const {
    return {place.left() + x * place.width(), place.bottom() - y * place.height()};
  }
  void line(const QColor& color, const std::function<double(double)>& y) const {
    QPainterPath path(at(0, y(0)));
    for (int i = 1; i <= kSamples; ++i) {
      const double x = static_cast<double>(i) / kSamples;
      path.lineTo(at(x, y(x)));
    }
    painter.setPen(QPen(color, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
  }
};

// An epipolar plane image: lines of all slopes of the range are looked for.
void draw_slopes(const Canvas& canvas, Interval range) {
  constexpr double kViews = 8;
  constexpr double kWidth_px = 40;
  const auto end = [&](double disparity, double row) {
    return canvas.at(0.5 + disparity * kViews * (row - 0.5) / kWidth_px, row);
  };
  QColor fan = canvas.strong;
  fan.setAlpha(60);
  canvas.painter.setPen(Qt::NoPen);
  canvas.painter.setBrush(fan);
  for (const double row : {0.0, 1.0}) {
    canvas.painter.drawPolygon(
        QPolygonF{{canvas.at(0.5, 0.5), end(range.min, row), end(range.max, row)}});
  }
  for (int i = 0; i <= kViews; ++i) {
    canvas.painter.setPen(QPen(canvas.quiet, 1));
    canvas.painter.drawLine(canvas.at(0, i / kViews), canvas.at(1, i / kViews));
  }
  canvas.painter.setPen(QPen(canvas.strong, 2));
  for (const double disparity : {range.min, range.max}) {
    canvas.painter.drawLine(end(disparity, 0), end(disparity, 1));
  }
}

// A Gaussian window over a row of pixels.
void draw_window(const Canvas& canvas) {
  constexpr int kReach_px = 8;
  const double sigma = std::max(canvas.value, 0.05);
  const auto weight = [&](double px) { return std::exp(-px * px / (2 * sigma * sigma)); };
  const double step = 1.0 / (2 * kReach_px + 1);
  QColor bar = canvas.strong;
  bar.setAlpha(90);
  for (int px = -kReach_px; px <= kReach_px; ++px) {
    const double left = (px + kReach_px) * step;
    canvas.painter.setPen(QPen(canvas.quiet, 1));
    canvas.painter.setBrush(bar);
    canvas.painter.drawRect(QRectF(canvas.at(left, 0.9 * weight(px)), canvas.at(left + step, 0)));
  }
  canvas.line(canvas.strong, [&](double x) { return 0.9 * weight((x - 0.5) / step); });
}

// Disparities along a row: two surfaces under noise, and what smoothing of that strength leaves.
void draw_smoothing(const Canvas& canvas) {
  std::array<double, kSamples + 1> noisy{};
  for (int i = 0; i <= kSamples; ++i) {
    const double noise = 0.07 * std::sin(2.7 * i) + 0.05 * std::sin(7.9 * i + 1);
    noisy[i] = (i < kSamples / 2 ? 0.3 : 0.65) + 0.1 * std::sin(0.05 * i) + noise;
  }
  // A mean of neighbors of similar value: what is unlike stays a jump.
  const int reach = static_cast<int>(std::lround(canvas.part * 14));
  const auto smooth = [&](int at) {
    double sum = 0;
    double weights = 0;
    for (int i = std::max(at - reach, 0); i <= std::min(at + reach, kSamples); ++i) {
      const bool is_same_side = (i < kSamples / 2) == (at < kSamples / 2);
      const double weight = is_same_side ? 1 : 0.02 + 0.2 * canvas.part * canvas.part;
      sum += weight * noisy[i];
      weights += weight;
    }
    return sum / weights;
  };
  const auto index = [](double x) { return static_cast<int>(std::lround(x * kSamples)); };
  canvas.line(canvas.quiet, [&](double x) { return noisy[index(x)]; });
  canvas.line(canvas.strong, [&](double x) { return smooth(index(x)); });
}

// The weight of smoothing over the contrast of the view.
void draw_falloff(const Canvas& canvas) {
  canvas.line(canvas.quiet, [](double) { return 0.9; });
  canvas.line(canvas.strong, [&](double x) { return 0.9 * std::exp(-canvas.value * x); });
}

// A cost that grows with the difference, and no more from some difference on.
void draw_cap(const Canvas& canvas) {
  const double cap = 0.12 + 0.76 * canvas.part;
  const auto difference = [](double x) { return std::abs(2 * x - 1); };
  canvas.line(canvas.quiet, [&](double x) { return 0.9 * difference(x); });
  canvas.line(canvas.strong, [&](double x) { return 0.9 * std::min(difference(x), cap); });
}

// Weight over confidence.
void draw_power(const Canvas& canvas) {
  canvas.line(canvas.quiet, [](double x) { return 0.9 * x; });
  canvas.line(canvas.strong, [&](double x) { return 0.9 * std::pow(x, canvas.value); });
}

// The disparities tested, as marks along the range.
void draw_labels(const Canvas& canvas) {
  const int count = std::clamp(static_cast<int>(canvas.value), 2, 100);
  canvas.painter.setPen(QPen(canvas.quiet, 2));
  canvas.painter.drawLine(canvas.at(0, 0.5), canvas.at(1, 0.5));
  canvas.painter.setPen(QPen(canvas.strong, 1));
  for (int i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) / (count - 1);
    canvas.painter.drawLine(canvas.at(x, 0.25), canvas.at(x, 0.75));
  }
}

// The energy falls, quickly first: where this number of iterations ends.
void draw_descent(const Canvas& canvas) {
  const auto energy = [](double x) { return 0.12 + 0.78 * std::exp(-6 * x); };
  const double end = std::clamp(canvas.part, 0.02, 1.0);
  canvas.line(canvas.quiet, energy);
  canvas.line(canvas.strong, [&](double x) { return energy(x * end); });
  canvas.painter.setPen(QPen(canvas.strong, 1, Qt::DashLine));
  canvas.painter.drawLine(canvas.at(end, 0), canvas.at(end, 1));
}

using Draw = void (*)(const Canvas&);

struct Picture {
  std::string_view key;
  Draw draw;
  const char* caption;
};

constexpr std::string_view kRange = "range";
constexpr const char* kSlopes =
    QT_TRANSLATE_NOOP("episcope::ParameterHelp",
                      "An EPI, a row for each view: points move along lines of these slopes.");
constexpr const char* kWindow = QT_TRANSLATE_NOOP(
    "episcope::ParameterHelp", "The weight of each neighbor; a bar is a pixel, or a view.");
constexpr const char* kSmoothing =
    QT_TRANSLATE_NOOP("episcope::ParameterHelp",
                      "Disparity along a row of pixels: grey as measured, blue as smoothed.");
constexpr const char* kFalloff = QT_TRANSLATE_NOOP(
    "episcope::ParameterHelp", "How strongly neighbors are smoothed, from equal to unlike colors.");
constexpr const char* kCap =
    QT_TRANSLATE_NOOP("episcope::ParameterHelp",
                      "The cost of a difference, 0 in the middle: blue grows no more at the cap.");
constexpr const char* kPower = QT_TRANSLATE_NOOP(
    "episcope::ParameterHelp", "The weight of an estimate, from no to full confidence.");
constexpr const char* kLabels = QT_TRANSLATE_NOOP(
    "episcope::ParameterHelp", "The disparities that are tested, over the whole range.");
constexpr const char* kDescent = QT_TRANSLATE_NOOP(
    "episcope::ParameterHelp", "What is left to improve; the iterations end at the dashed line.");

constexpr std::array kPictures{
    Picture{"inner_scale", draw_window, kWindow},
    Picture{"outer_scale", draw_window, kWindow},
    Picture{"view_scale", draw_window, kWindow},
    Picture{"cross_scale", draw_window, kWindow},
    Picture{"double_inner_scale", draw_window, kWindow},
    Picture{"double_outer_scale", draw_window, kWindow},
    Picture{"lambda", draw_smoothing, kSmoothing},
    Picture{"smoothness", draw_smoothing, kSmoothing},
    Picture{"layer_smoothness", draw_smoothing, kSmoothing},
    Picture{"settling", draw_smoothing, kSmoothing},
    Picture{"tgv", draw_smoothing, kSmoothing},
    Picture{"edge_strength", draw_falloff, kFalloff},
    Picture{"epsilon", draw_cap, kCap},
    Picture{"truncation", draw_cap, kCap},
    Picture{"jump", draw_cap, kCap},
    Picture{"weight_power", draw_power, kPower},
    Picture{"fusion_power", draw_power, kPower},
    Picture{"labels", draw_labels, kLabels},
    Picture{"max_iterations", draw_descent, kDescent},
    Picture{"tgv_iterations", draw_descent, kDescent},
    Picture{"cycles", draw_descent, kDescent},
    Picture{"passes", draw_descent, kDescent},
};

const Picture* picture_of(const std::string& key) {
  const auto* const found = std::ranges::find(kPictures, key, &Picture::key);
  return found == kPictures.end() ? nullptr : found;
}

double number_of(const ParameterValue& value) {
  if (const auto* whole = std::get_if<int>(&value)) return *whole;
  const auto* real = std::get_if<double>(&value);
  return real ? *real : 0;
}

// In powers where a slider moves in powers.
double part_of(const ParameterDescription& description, double value) {
  const double length = description.max - description.min;
  if (length <= 0) return 0;
  const double part = std::clamp((value - description.min) / length, 0.0, 1.0);
  constexpr double kPowers = 1000;
  return description.logarithmic ? std::log1p(kPowers * part) / std::log1p(kPowers) : part;
}

class PictureLabel : public QWidget {
 public:
  PictureLabel(ParameterDescription description, ParameterValue value, QWidget* parent)
      : QWidget(parent), description_(std::move(description)), value_(std::move(value)) {
    setObjectName("parameterHelp.picture");
    setFixedSize(kPictureSize);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    draw_parameter(painter, rect(), description_, value_);
  }

 private:
  ParameterDescription description_;
  ParameterValue value_;
};

}  // namespace

QString parameter_caption(const std::string& key) {
  const Picture* picture = picture_of(key);
  if (!picture && key != kRange) return {};
  return ParameterHelp::tr(picture ? picture->caption : kSlopes);
}

void draw_parameter(QPainter& painter, const QRectF& place, const ParameterDescription& description,
                    const ParameterValue& value) {
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(place, theme::kCanvas);
  painter.setClipRect(place);
  const double number = number_of(value);
  const QColor quiet = theme::blend(theme::kCanvas, theme::kCanvasMuted, 0.6);
  const Canvas canvas{painter, place.adjusted(8, 8, -8, -8), quiet, theme::kEstimate,
                      number,  part_of(description, number)};
  if (const auto* range = std::get_if<IntervalOrAuto>(&value); range && description.key == kRange) {
    draw_slopes(canvas, range->value_or(Interval{-1, 1}));
  } else if (const Picture* picture = picture_of(description.key)) {
    picture->draw(canvas);
  }
}

ParameterHelp::ParameterHelp(const ParameterDescription& description, const ParameterValue& value,
                             QWidget* parent)
    : QFrame(parent, Qt::Popup) {
  setObjectName("parameterHelp");
  setFrameShape(QFrame::StyledPanel);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(theme::kMargin, theme::kMargin, theme::kMargin, theme::kMargin);
  const auto add = [this, layout](const QString& words) {
    auto* label = new QLabel(words, this);
    label->setWordWrap(true);
    label->setFixedWidth(kTextWidth);
    layout->addWidget(label);
    return label;
  };
  QLabel* text = add(parameter_help(description));
  text->setObjectName("parameterHelp.text");
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  const QString caption = parameter_caption(description.key);
  if (caption.isEmpty()) return;
  layout->addWidget(new PictureLabel(description, value, this));
  theme::mute(add(caption));
}

void ParameterHelp::showAt(const QPoint& corner) {
  adjustSize();
  const QRect room = screen()->availableGeometry();
  const int left = std::clamp(corner.x() - width(), room.left(), room.right() - width());
  const int top = std::clamp(corner.y(), room.top(), room.bottom() - height());
  move(left, top);
  show();
}

}  // namespace episcope

#include "moc_parameter_help.cpp"
