// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/panes.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/picture.h"
#include "app/session/session.h"
#include "widgets/cloud/cloud_look.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/tool_button.h"

#include <QCoreApplication>
#include <QLocale>
#include <QObject>
#include <QSettings>
#include <QString>
#include <QToolButton>

#include <algorithm>
#include <optional>
#include <utility>

namespace episcope {
namespace {

/// What a user chose of the 3D view, kept from run to run.
struct CloudSettings {
  CloudChoice choice;
  CloudLook look;  ///< Stretch and cuts belong to a scene and are not kept.
  bool is_large = false;
};

// A number of an enumeration, at most `last`; 0 for what another version may have written.
template <typename Value>
Value read_value(const QSettings& settings, const char* key, Value last) {
  const int number = settings.value(key).toInt();
  return number >= 0 && number <= static_cast<int>(last) ? static_cast<Value>(number) : Value{};
}

double read_number(const QSettings& settings, const char* key, double plain, double least,
                   double most) {
  return std::clamp(settings.value(key, plain).toDouble(), least, most);
}

CloudSettings read_cloud_settings() {
  const QSettings settings;
  const CloudSettings plain;
  CloudSettings read;
  read.choice.coloring = read_value(settings, "cloud/coloring", CloudColoring::Source);
  read.choice.companion = read_value(settings, "cloud/companion", CloudCompanion::Other);
  read.choice.is_beside = settings.value("cloud/beside").toBool();
  read.choice.is_surface = settings.value("cloud/surface").toBool();
  read.choice.jump_px = read_number(settings, "cloud/jump", plain.choice.jump_px, 0.01, 5);
  read.look.point_size = read_number(settings, "cloud/size", plain.look.point_size, 1, 10);
  read.look.is_shaded = settings.value("cloud/shaded").toBool();
  read.is_large = settings.value("cloud/large").toBool();
  return read;
}

void write_cloud_settings(const CloudSettings& written) {
  QSettings settings;
  settings.setValue("cloud/coloring", static_cast<int>(written.choice.coloring));
  settings.setValue("cloud/companion", static_cast<int>(written.choice.companion));
  settings.setValue("cloud/beside", written.choice.is_beside);
  settings.setValue("cloud/surface", written.choice.is_surface);
  settings.setValue("cloud/jump", written.choice.jump_px);
  settings.setValue("cloud/size", written.look.point_size);
  settings.setValue("cloud/shaded", written.look.is_shaded);
  settings.setValue("cloud/large", written.is_large);
}

using render::Quantity;

struct CloudRequestsText {
  Q_DECLARE_TR_FUNCTIONS(episcope::CloudRequests)
};

bool is_of_map(CloudColoring coloring) {
  return coloring == CloudColoring::Disparity || coloring == CloudColoring::Error ||
         coloring == CloudColoring::Labels;
}

// Labels learnt from strokes, else the true labels.
Quantity labels_of(const Overlay& overlay) {
  return overlay.isAvailable(Quantity::Segmentation) ? Quantity::Segmentation
                                                     : Quantity::TrueLabels;
}

Quantity quantity_of(CloudColoring coloring, const Overlay& overlay) {
  return coloring == CloudColoring::Error    ? Quantity::SignedError
         : coloring == CloudColoring::Labels ? labels_of(overlay)
                                             : Quantity::Disparity;
}

PointCloudColoring space_coloring(CloudColoring coloring) {
  if (is_of_map(coloring)) return PointCloudColoring::Map;
  return coloring == CloudColoring::Distance ? PointCloudColoring::Distance
         : coloring == CloudColoring::Source ? PointCloudColoring::Source
                                             : PointCloudColoring::View;
}

std::shared_ptr<const DisparityField> field_of(const EstimatePtr& estimate) {
  return {estimate, &estimate->field};
}

}  // namespace

/// Turns a choice of the 3D view into a request to the session in its current state. Shows the
/// current result, or the ground truth if there is none.
class CloudRequests {
 public:
  explicit CloudRequests(const Workbench& bench) : bench_(bench) {}

  /// Sentence that tells why there is nothing to show; empty if there is.
  [[nodiscard]] QString obstacle() const {
    const Session& session = bench_.session;
    if (!session.scene()) return open_a_light_field();
    if (result() || truth()) return {};
    const EstimateEntry* shown = session.side_a();
    if (!shown) return CloudRequestsText::tr("Run a method: its disparity appears here in 3D.");
    return CloudRequestsText::tr("%1 has no map of this view. Go to the center view (Home).")
        .arg(QString::fromStdString(shown->name));
  }

  /// Available choices. Precondition: there is no obstacle.
  [[nodiscard]] CloudOffers offers() const {
    const Session& session = bench_.session;
    CloudOffers offers;
    offers.has_truth = result() && truth();
    offers.has_error = result() && session.has_truth(session.view());
    offers.has_labels = bench_.overlay.isAvailable(Quantity::Segmentation) ||
                        bench_.overlay.isAvailable(Quantity::TrueLabels);
    offers.has_distance =
        result() && session.light_field()->info().camera.is_known() && (truth() || other());
    offers.other = otherName();
    return offers;
  }

  /// Request for the choice; none until its maps exist, which their evaluation announces. Leaves
  /// out what is unavailable. Precondition: there is no obstacle.
  [[nodiscard]] std::optional<PointCloudRequest> request(const CloudChoice& wanted) const {
    const CloudChoice choice = possible(wanted);
    Session& session = bench_.session;
    PointCloudRequest request;
    request.light_field = session.light_field();
    request.view = session.view();
    request.is_beside = choice.is_beside;
    request.coloring = space_coloring(choice.coloring);
    request.tone = session.place().tone;
    if (choice.is_surface) request.jump_px = choice.jump_px;
    if (choice.coloring == CloudColoring::Distance) request.reference = reference(choice.companion);
    request.sources.push_back({main()});
    if (choice.companion == CloudCompanion::Truth) request.sources.push_back({truth()});
    if (choice.companion == CloudCompanion::Other) request.sources.push_back({other()});
    if (!is_of_map(choice.coloring)) return request;
    request.shading = bench_.overlay.shadingOf(quantity(choice.coloring));
    return addMaps(choice, request) ? std::optional(request) : std::nullopt;
  }

  /// Reference of distances: "ground truth" or a result.
  [[nodiscard]] QString referenceName(const CloudChoice& choice) const {
    return reference(possible(choice).companion) == truth()
               ? CloudRequestsText::tr("the ground truth")
               : otherName();
  }

  /// Name of the drawn clouds: "EPI_L", or "EPI_L and ground truth".
  [[nodiscard]] QString title(const CloudChoice& choice) const {
    const QString shown =
        result() ? QString::fromStdString(result()->name) : CloudRequestsText::tr("Ground truth");
    switch (possible(choice).companion) {
      case CloudCompanion::Truth:
        return CloudRequestsText::tr("%1 and the ground truth").arg(shown);
      case CloudCompanion::Other:
        return CloudRequestsText::tr("%1 and %2").arg(shown, otherName());
      case CloudCompanion::None:
        break;
    }
    return shown;
  }

  /// Quantity whose colors need a legend; none for colors of views, labels and sources.
  [[nodiscard]] QString legend(const CloudChoice& choice) const {
    switch (possible(choice).coloring) {
      case CloudColoring::Disparity:
      case CloudColoring::Error: {
        const Quantity shown = quantity(choice.coloring);
        return CloudRequestsText::tr("%1 [%2]").arg(quantity_label(shown), quantity_unit(shown));
      }
      case CloudColoring::Distance:
        return CloudRequestsText::tr("distance");
      default:
        return {};
    }
  }

 private:
  /// The shown result if it has a map of this view; the truth replaces it otherwise.
  [[nodiscard]] const EstimateEntry* result() const {
    const EstimateEntry* shown = bench_.session.side_a();
    return shown && shown->estimate->contains(bench_.session.view()) ? shown : nullptr;
  }

  [[nodiscard]] CloudChoice possible(CloudChoice choice) const {
    const CloudOffers offered = offers();
    const bool lacks_colors = (choice.coloring == CloudColoring::Error && !offered.has_error) ||
                              (choice.coloring == CloudColoring::Labels && !offered.has_labels) ||
                              (choice.coloring == CloudColoring::Distance && !offered.has_distance);
    if (lacks_colors) choice.coloring = CloudColoring::Image;
    const bool lacks_companion =
        (choice.companion == CloudCompanion::Truth && !offered.has_truth) ||
        (choice.companion == CloudCompanion::Other && offered.other.isEmpty());
    if (lacks_companion) choice.companion = CloudCompanion::None;
    return choice;
  }

  [[nodiscard]] std::shared_ptr<const DisparityField> truth() const {
    const GroundTruthPtr& truth = bench_.session.scene()->truth;
    if (!truth || !truth->field.contains(bench_.session.view())) return nullptr;
    return {truth, &truth->field};
  }

  [[nodiscard]] std::shared_ptr<const DisparityField> other() const {
    const EstimateEntry* entry = bench_.session.side_b();
    if (!entry || !entry->estimate || !entry->estimate->contains(bench_.session.view())) {
      return nullptr;
    }
    return field_of(entry->estimate);
  }

  // Distances refer to the companion, else to the truth, else to the other result.
  [[nodiscard]] std::shared_ptr<const DisparityField> reference(CloudCompanion companion) const {
    if (companion == CloudCompanion::Other && other()) return other();
    return truth() ? truth() : other();
  }

  /// Source that is drawn beside the companion.
  [[nodiscard]] std::shared_ptr<const DisparityField> main() const {
    return result() ? field_of(result()->estimate) : truth();
  }

  // The truth has its own colors.
  [[nodiscard]] render::Quantity quantity(CloudColoring coloring) const {
    const Quantity quantity = quantity_of(coloring, bench_.overlay);
    return quantity == Quantity::Disparity && !result() ? Quantity::Truth : quantity;
  }

  [[nodiscard]] std::optional<MapSource> map(CloudColoring coloring, int estimate) const {
    const Quantity quantity = quantity_of(coloring, bench_.overlay);
    const bool is_of_result = coloring != CloudColoring::Labels;
    return bench_.overlay.sourceOf({quantity, is_of_result ? estimate : 0, 0});
  }

  /// Returns whether all maps exist.
  [[nodiscard]] bool addMaps(const CloudChoice& choice, PointCloudRequest& request) const {
    const auto truth_map = bench_.overlay.sourceOf({Quantity::Truth, 0, 0});
    const bool is_truth = quantity(choice.coloring) == Quantity::Truth;
    request.sources[0].map =
        is_truth ? truth_map : map(choice.coloring, result() ? result()->id : 0);
    if (!request.sources[0].map) return false;
    if (request.sources.size() < 2) return true;
    if (choice.companion == CloudCompanion::Other || choice.coloring == CloudColoring::Labels) {
      const EstimateEntry* other = bench_.session.side_b();
      request.sources[1].map = map(choice.coloring, other ? other->id : 0);
      return request.sources[1].map.has_value();
    }
    // The truth has no error.
    if (choice.coloring == CloudColoring::Disparity) request.sources[1].map = truth_map;
    return true;
  }

  [[nodiscard]] QString otherName() const {
    return other() ? QString::fromStdString(bench_.session.side_b()->name) : QString();
  }

  Workbench bench_;
};

/// The 3D view. Creates it when first shown, updates its clouds while it is visible, and drops
/// outdated clouds while it is not. Links its points to the cross-hair, and moves it in place of
/// the view and back.
class CloudController : public QObject {
  Q_OBJECT

 public:
  CloudController(const Workbench& bench, QWidget* tab)
      : QObject(&bench.owner),
        bench_(bench),
        session_(bench.session),
        requests_(bench),
        tab_(tab),
        job_(this) {
    connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
      if (id == "cloud") makePanel();
    });
    connect(&bench.frame, &Frame::started, this, [this] {
      if (read_cloud_settings().is_large) setLarge(true);
    });
    connect(&bench.frame, &Frame::layoutReset, this, [this] { setLarge(false); });
    connect(&bench.viewer_area, &ViewerArea::guestDismissed, this, [this] { setLarge(false); });
    connect(&bench.overlay, &Overlay::drawn, this, [this] {
      // Color ranges and labels may have changed.
      if (panel_ && panel_->controls().choice().coloring != CloudColoring::Image) refresh();
    });
    session_.on_changed([this](Parts parts) { hear(parts); });
  }

  /// Shows the 3D view in place of the view, or in its tab.
  void setLarge(bool is_large) {
    if (is_large == is_large_) return;
    makePanel();
    is_large_ = is_large;
    if (is_large) {
      panel_->lendDisplay(tr("The 3D view is shown in place of the view."));
      bench_.viewer_area.setGuest(&panel_->display());
    } else {
      bench_.viewer_area.releaseGuest();
      panel_->takeDisplayBack();
    }
    remember();
    bench_.commands.refresh();
  }

  [[nodiscard]] bool isLarge() const { return is_large_; }
  /// Asks for a file and writes the shown clouds.
  void askToExport() const {
    const std::string& scene = session_.light_field()->info().name;
    ask_where_to_save(bench_,
                      {.name = "export_cloud",
                       .title = tr("Save the 3D view"),
                       .filter = tr("Point cloud or surface (*.ply)"),
                       .proposal = QString::fromStdString(scene + ".ply")},
                      [this, parts = parts_](const QString& path) {
                        if (!has_suffix(path, {"ply"}, bench_.messages)) return;
                        write_in_background(bench_.jobs, bench_.messages, path,
                                            [parts, file = path.toStdString()](const Progress&) {
                                              save_point_clouds(file, *parts);
                                            });
                      });
  }

  [[nodiscard]] bool hasScene() const { return parts_ && !parts_->empty(); }

 private:
  /// Outcome of a request.
  struct Made {
    CloudPartsPtr parts;
    std::optional<CloudDistance> distance;
    std::optional<render::Shading> shading;
  };

  void hear(Parts parts) {
    if (!panel_) return;
    if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Live | Part::View |
                      Part::Evaluations | Part::Tone)) {
      refresh();
    }
    if (parts.has(Part::CrossHair) && isOnScreen() && panel_->isAvailable()) {
      panel_->display().view()->setMarkedPixel(session_.cross_hair());
    }
  }

  void makePanel() {
    if (panel_) return;
    panel_ = new PointCloudPanel(tab_);
    const CloudSettings settings = read_cloud_settings();
    panel_->controls().setChoice(settings.choice);
    panel_->controls().setLook(settings.look);
    for (const char* id : {"cloud.large", "cloud.window"}) {
      panel_->addButton(make_action_button(bench_.commands.find(id), panel_));
    }
    make_column(tab_, {panel_});
    connectPanel();
    if (isOnScreen()) update();
  }

  void connectPanel() {
    CloudDisplay& display = panel_->display();
    connect(&display, &CloudDisplay::shown, this, [this] {
      if (is_stale_) update();
    });
    connect(&display, &CloudDisplay::pixelPicked, this,
            [this](PixelIndex pixel) { session_.set_cross_hair(pixel); });
    connect(&panel_->controls(), &CloudControls::choiceChanged, this, [this] {
      remember();
      refresh();
    });
    connect(&panel_->controls(), &CloudControls::lookChanged, this, &CloudController::remember);
    if (panel_->isAvailable()) display.view()->setLook(panel_->controls().look());
  }

  void remember() const {
    if (!panel_) return;
    write_cloud_settings({panel_->controls().choice(), panel_->controls().look(), is_large_});
  }

  // Outdated clouds are dropped while they are not visible.
  void refresh() {
    is_stale_ = true;
    if (isOnScreen()) {
      update();
    } else {
      job_.drop();
      if (hasScene()) showHint({});
    }
  }

  void update() {
    if (!panel_->isAvailable()) return;
    is_stale_ = false;
    if (const QString hint = requests_.obstacle(); !hint.isEmpty()) {
      job_.drop();
      showHint(hint);
      return;
    }
    panel_->controls().setOffers(requests_.offers());
    const auto request = requests_.request(panel_->controls().choice());
    if (request) start(*request);  // else its evaluation tells when it is there
  }

  void showHint(const QString& hint) {
    parts_ = std::make_shared<const CloudParts>();
    panel_->display().setParts(parts_, hint);
    panel_->controls().setSummary({});
    if (panel_->isAvailable()) panel_->display().view()->setLegend({});
    bench_.commands.refresh();
  }

  void start(const PointCloudRequest& request) {
    if (request.reference) panel_->controls().setSummary(tr("Measuring distances …"));
    job_.start<std::shared_ptr<const Made>>(
        [request](const Progress& progress) {
          PointClouds scene = make_point_clouds(request, progress);
          return std::make_shared<const Made>(
              Made{std::make_shared<const CloudParts>(std::move(scene.parts)),
                   std::move(scene.distance), std::move(scene.shading)});
        },
        [this](const std::shared_ptr<const Made>& made) { show(*made); });
  }

  void show(const Made& made) {
    const CloudChoice choice = panel_->controls().choice();
    parts_ = made.parts;
    panel_->display().setParts(parts_, tr("This result has no valid pixels in this view."));
    PointCloudView& view = *panel_->display().view();
    if (made.shading) {
      view.setLegend(requests_.legend(choice), *made.shading);
    } else {
      view.setLegend({});
    }
    view.setMarkedPixel(session_.cross_hair());
    panel_->controls().setSummary(summary(made));
    bench_.commands.refresh();
  }

  [[nodiscard]] bool isOnScreen() const { return panel_ && panel_->display().isVisible(); }
  [[nodiscard]] QString summary(const Made& made) const {
    const CloudChoice choice = panel_->controls().choice();
    std::size_t points = 0;
    for (const CloudPart& part : *made.parts) points += part.all.positions.size();
    QString text =
        tr("%1: %2 points")
            .arg(requests_.title(choice), QLocale::c().toString(static_cast<quint64>(points)));
    if (choice.coloring == CloudColoring::Source && made.parts->size() > 1) {
      text += tr(", in orange and blue");
    }
    if (!made.distance) return text;
    return text +
           tr(". From its points to the nearest of %1, in units of the scene: mean %2, median "
              "%3, 95 % below %4")
               .arg(requests_.referenceName(choice), number_text(made.distance->mean, 4),
                    number_text(made.distance->median, 4),
                    number_text(made.distance->percentile95, 4));
  }

  Workbench bench_;
  Session& session_;
  CloudRequests requests_;
  QWidget* tab_;
  PointCloudPanel* panel_ = nullptr;
  CloudPartsPtr parts_;
  bool is_large_ = false;
  bool is_stale_ = true;
  LatestJob job_;
};

namespace {

void add_cloud_commands(const Workbench& bench, CloudController* cloud) {
  bench.commands.add(
      {.menu = Menu::Panes},
      {{.id = "cloud.large",
        .text = CloudController::tr("3D in place of the view"),
        .tip = CloudController::tr(
            "Shows the 3D view in place of the current view, or moves it back into its tab"),
        .icon = "cube",
        .keys = {Qt::Key_F4},
        .run = [cloud] { cloud->setLarge(!cloud->isLarge()); },
        .checked = [cloud] { return cloud->isLarge(); }},
       {.id = "cloud.window",
        .text = CloudController::tr("3D in its own window"),
        .tip = CloudController::tr(
            "Detaches the 3D view and its controls into their own window, or docks them again"),
        .icon = "sides",
        .keys = {CloudController::tr("Shift+F4")},
        .run =
            [&frame = bench.frame, cloud] {
              cloud->setLarge(false);
              frame.showTab("cloud");
              frame.panes().toggle("tab.cloud");
            },
        .checked = [&frame = bench.frame] { return frame.panes().isTorn("tab.cloud"); }}});
  bench.commands.add({.id = "cloud.export",
                      .menu = Menu::Export,
                      .text = CloudController::tr("3D view…"),
                      .tip = CloudController::tr("Writes the points or surfaces that the 3D view "
                                                 "shows, in their colors, as PLY"),
                      .icon = "export",
                      .keys = {CloudController::tr("Ctrl+Alt+E")},
                      .run = [cloud] { cloud->askToExport(); },
                      .section = section::kPictures,
                      .enabled = [cloud] { return cloud->hasScene(); }});
}

}  // namespace

// The 3D view.
void add_cloud(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "cloud",
                      .title = CloudController::tr("3D"),
                      .command_text = CloudController::tr("3D tab"),
                      .command_tip = CloudController::tr("Shows the result in 3D, as points or as "
                                                         "a surface"),
                      .icon = "cube",
                      .widget = tab});
  add_cloud_commands(bench, new CloudController(bench, tab));
}

}  // namespace episcope

#include "cloud_controller.moc"
