// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/value_controller.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"
#include "engine/render/shade.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/panels/value_bar.h"

#include <QDialog>
#include <QSettings>

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

QColor color_at(const LightField& light_field, ViewIndex view, PixelIndex pixel) {
  float normalized[3] = {};
  light_field.read_row(view, pixel.y, pixel.x, pixel.x + 1, normalized);
  if (light_field.channels() == 1) normalized[1] = normalized[2] = normalized[0];
  const auto bounded = [](float value) { return std::clamp(value, 0.0F, 1.0F); };
  return QColor::fromRgbF(bounded(normalized[0]), bounded(normalized[1]), bounded(normalized[2]));
}

// The line has room for a few results: A and B come first.
std::vector<const EstimateEntry*> shown_first(const Session& session) {
  std::vector<const EstimateEntry*> entries;
  for (const EstimateEntry& entry : session.estimates()) entries.push_back(&entry);
  if (const EstimateEntry* live = session.live()) entries.push_back(live);
  const auto rank = [&session](const EstimateEntry* entry) {
    return entry == session.side_a() ? 0 : entry == session.side_b() ? 1 : 2;
  };
  std::stable_sort(
      entries.begin(), entries.end(),
      [&rank](const EstimateEntry* a, const EstimateEntry* b) { return rank(a) < rank(b); });
  return entries;
}

}  // namespace

namespace {

/// `unnamed`: of a label without a name, %1 is its id.
QString name_in(const std::vector<LabelInfo>& infos, int id, const QString& unnamed) {
  const auto found = std::ranges::find(infos, id, &LabelInfo::id);
  return found == infos.end() || found->name.empty() ? unnamed.arg(id) : label_name(*found);
}

}  // namespace

/// Shows the values of the pixel under the cursor, or at the cross-hair while the cursor is
/// elsewhere; prints values into large pixels; counts running jobs.
class ValueController : public QObject {
  Q_OBJECT

 public:
  explicit ValueController(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        session_(bench.session),
        bar_(new ValueBar(&bench.frame)) {
    bench.frame.addLine(Line::Values, bar_);
    ViewCanvas* canvas = bench.viewer_area.canvas();
    connect(canvas, &ViewCanvas::cursorMoved, this, [this](std::optional<PixelIndex> pixel) {
      cursor_ = pixel;
      show();
    });
    canvas->setPixelText([this](int y, int x) { return pixelText({y, x}); });
    connect(&bench.overlay, &Overlay::drawn, this, &ValueController::show);
    connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &ValueController::show);
    connect(&bench.jobs, &Jobs::added, this, &ValueController::showStatus);
    connect(&bench.jobs, &Jobs::removed, this, &ValueController::showStatus);
    showStatus();
    session_.on_changed([this](Parts parts) {
      if (parts.has(Part::Scene)) cursor_.reset();
      show();
    });
  }

 private:
  void show() {
    const LightFieldPtr light_field = session_.light_field();
    const PixelIndex pixel = cursor_.value_or(session_.cross_hair());
    const bool is_inside =
        light_field && pixel.y < light_field->height() && pixel.x < light_field->width();
    if (!is_inside || bench_.viewer_area.isPreviewing()) {
      bar_->setReading(std::nullopt);
      return;
    }
    const ViewIndex view = session_.view();
    PixelReading reading;
    reading.pixel = pixel;
    reading.samples = sample_texts(*light_field, view, pixel).join(' ');
    reading.color = color_at(*light_field, view, pixel);
    reading.labels = labelsAt(pixel);
    const GroundTruth& truth = *session_.scene()->truth;
    const DisparityPair of_truth = disparities_at(truth, view, pixel);
    reading.has_truth = truth.field.contains(view) || truth.foreground.contains(view);
    reading.truth_px = of_truth.front;
    reading.background_truth_px = of_truth.behind;
    for (const EstimateEntry* entry : shown_first(session_)) {
      if (!entry->estimate->contains(view)) continue;
      const DisparityPair found = disparities_at(*entry->estimate, view, pixel);
      reading.estimates.push_back({QString::fromStdString(entry->name), found.front, found.behind});
    }
    bar_->setReading(reading);
  }

  void showStatus() {
    const int count = bench_.jobs.count();
    bar_->setStatus(count == 0   ? tr("ready")
                    : count == 1 ? tr("1 job running")
                                 : tr("%1 jobs running").arg(count));
  }

  [[nodiscard]] QStringList pixelText(PixelIndex pixel) const {
    const LightFieldPtr light_field = session_.light_field();
    if (!light_field || pixel.y >= light_field->height() || pixel.x >= light_field->width()) {
      return {};
    }
    if (!bench_.overlay.picture().isNull()) {
      const auto value = bench_.overlay.valueAt(pixel);
      if (value) return {number_text(*value)};
    }
    return sample_texts(*light_field, session_.view(), pixel);
  }

  [[nodiscard]] QStringList labelsAt(PixelIndex pixel) const {
    const AnnotationDocument* document = bench_.document.document();
    if (!document) return {};
    const ViewIndex view = session_.view();
    const std::vector<LabelInfo>& infos = document->labels().labels();
    QStringList texts;
    if (const int painted = document->scribbles().label_at(view, pixel)) {
      texts << tr("painted %1").arg(name_in(infos, painted, tr("label %1")));
    }
    if (const auto source = bench_.overlay.sourceOf({render::Quantity::Segmentation})) {
      const Labeling& labeling = *source->labeling;
      const int id = labeling.labels.view(view).at(pixel.y, pixel.x);
      if (id > 0) texts << tr("segment %1").arg(name_in(infos, id, tr("label %1")));
      const auto& ids = labeling.probabilities.ids;
      const auto layer = std::ranges::find(ids, id);
      if (labeling.probabilities.contains(view) && layer != ids.end()) {
        const int code = labeling.probabilities.view(view).view().at(
            pixel.y, static_cast<int>(layer - ids.begin()), pixel.x);
        texts.back() += QString(" (%1 %)").arg(qRound(100 * code / 255.0));
      }
    }
    const TrueLabelsPtr& truth = session_.true_labels();
    if (!texts.isEmpty() && truth && truth->contains(view)) {
      const int id = truth->view(view).at(pixel.y, pixel.x);
      if (id > 0) texts << tr("true label %1").arg(name_in(session_.true_label_infos(), id, "%1"));
    }
    return texts;
  }

  Workbench bench_;
  Session& session_;
  ValueBar* bar_;
  std::optional<PixelIndex> cursor_;
};

namespace {

// A list of "black exposure gamma path", the newest first.
constexpr const char* kTonesKey = "tones";
constexpr int kMostTones = 50;
constexpr int kPathPart = 3;

}  // namespace

/// Brightness of displayed views, per scene; offers to brighten dark ones.
class ToneController : public QObject {
  Q_OBJECT

 public:
  explicit ToneController(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        dialog_(named("tone", new QDialog(&bench.window))),
        panel_(new TonePanel(dialog_)),
        job_(this) {
    dialog_->setWindowTitle(tr("Brightness"));
    auto* layout = make_column(dialog_, {panel_}, {.margins = kStyleMargins});
    layout->setSizeConstraint(QLayout::SetFixedSize);
    addCommands();
    connect(panel_, &TonePanel::toneEdited, this,
            [this](const render::Tone& tone) { bench_.session.set_tone(tone); });
    connect(panel_, &TonePanel::automaticRequested, this, &ToneController::brighten);
    bench.session.on_changed([this](Parts parts) { update(parts); });
  }

 private:
  void addCommands() {
    const auto has_scene = [this] { return bench_.session.scene() != nullptr; };
    bench_.commands.add(
        {.menu = Menu::View, .section = section::kZoom, .enabled = has_scene},
        {{.id = "view.tone",
          .text = tr("Brightness…"),
          .tip = tr("Exposure, gamma and black point of the views, for display only"),
          .keys = {tr("Shift+B")},
          .run = [this] { dialog_->show(); }},
         {.id = "view.auto_tone",
          .text = tr("Automatic brightness"),
          .tip = tr("Brightens dark views, or shows them unchanged"),
          .keys = {tr("Shift+A")},
          .run =
              [this] {
                if (bench_.session.place().tone.is_plain()) {
                  brighten();
                } else {
                  bench_.session.set_tone({});
                }
              },
          .checked = [this] { return !bench_.session.place().tone.is_plain(); }}});
  }

  void update(Parts parts) {
    if (parts.has(Part::Tone)) panel_->setTone(bench_.session.place().tone);
    if (parts.has(Part::Scene)) {
      look();
    } else if (parts.has(Part::Tone)) {
      remember();
    }
  }

  void brighten() {
    if (!bench_.session.scene()) return;
    job_.start<render::Tone>(
        [light_field = bench_.session.light_field(), view = bench_.session.view()](
            const Progress&) { return render::automatic_tone(*light_field, view); },
        [this, scene = bench_.session.generation()](const render::Tone& tone) {
          if (scene == bench_.session.generation()) bench_.session.set_tone(tone);
        });
  }

  void look() {
    job_.drop();
    if (!bench_.session.scene() || !bench_.session.place().tone.is_plain()) return;
    if (const auto tone = remembered()) return bench_.session.set_tone(*tone);
    job_.start<bool>(
        [light_field = bench_.session.light_field()](const Progress&) {
          return render::is_dark(*light_field, light_field->center());
        },
        [this](bool is_dark) {
          if (!is_dark) return;
          bench_.messages.offer(tr("The views are dark."), tr("Brighten"), [this] { brighten(); });
          bench_.messages.endWithLightField();
        });
  }

  /// Keeps the brightness for the next time that the light field is opened.
  void remember() const {
    const QString path = QString::fromStdString(bench_.session.input());
    if (path.isEmpty()) return;
    QStringList tones = QSettings().value(kTonesKey).toStringList();
    tones.removeIf([&](const QString& each) { return each.section(' ', kPathPart) == path; });
    const render::Tone& tone = bench_.session.place().tone;
    if (!tone.is_plain()) {
      tones.prepend(QStringList{QString::number(tone.black, 'g', 17),
                                QString::number(tone.exposure, 'g', 17),
                                QString::number(tone.gamma, 'g', 17), path}
                        .join(' '));
    }
    QSettings().setValue(kTonesKey, tones.mid(0, kMostTones));
  }

  [[nodiscard]] std::optional<render::Tone> remembered() const {
    const QString path = QString::fromStdString(bench_.session.input());
    for (const QString& each : QSettings().value(kTonesKey).toStringList()) {
      if (each.section(' ', kPathPart) != path) continue;
      const auto number = [&each](int part) { return each.section(' ', part, part).toDouble(); };
      return render::Tone{number(0), number(1), number(2)};
    }
    return std::nullopt;
  }

  Workbench bench_;
  QDialog* dialog_;
  TonePanel* panel_;
  LatestJob job_;
};

void add_values(const Workbench& bench) {
  new ToneController(bench);
  new ValueController(bench);
}

}  // namespace episcope

#include "value_controller.moc"
