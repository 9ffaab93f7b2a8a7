// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/session/picture.h"
#include "app/session/quantity_map.h"
#include "app/session/session.h"
#include "engine/core/estimate.h"
#include "engine/core/jobs.h"
#include "engine/core/light_field.h"

#include <QImage>
#include <QObject>
#include <QString>
#include <QStringList>

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <optional>

namespace episcope {

/// Provides the overlay with maps that the session does not hold.
class MapProvider {
 public:
  virtual ~MapProvider() = default;

  /// Whether the quantity can be shown in the current view now.
  [[nodiscard]] virtual bool has_map(render::Quantity quantity) const = 0;
  /// Whether a map may come later, so that the quantity stays chosen until then.
  [[nodiscard]] virtual bool awaits_map(render::Quantity quantity) const = 0;
  /// Title of the map; empty to use the name of the quantity.
  [[nodiscard]] virtual QString title(render::Quantity) const { return {}; }
  /// Source of a map; none if there is no such map.
  [[nodiscard]] virtual std::optional<MapSource> map_source(render::Quantity quantity,
                                                            ViewIndex view) const = 0;
};

/// Colored pictures of maps, made in the background one at a time. Keeps the most recent ones,
/// since flips and wipes alternate between two.
class OverlayPictures {
 public:
  struct Entry {
    MapSource source;
    render::Shading shading;
    QuantityMapPtr map;
    QImage picture;
  };

  /// Calls `made` on the thread of `post` when a picture is finished or failed.
  OverlayPictures(JobRunner::Post post, std::function<void()> made);

  /// Null if it is not made.
  [[nodiscard]] const Entry* find(const MapSource& source, const render::Shading& shading);
  /// The map alone, which may exist before its picture; null if it does not.
  [[nodiscard]] QuantityMapPtr find_map(const MapSource& source) const;
  /// Begins a picture, unless one is being made; `made` tells when to ask again.
  void begin(const MapSource& source, const render::Shading& shading);
  /// Forgets all pictures, including the one being made.
  void clear();

 private:
  void keep(Entry entry);

  std::function<void()> made_;
  std::list<Entry> entries_;
  bool is_making_ = false;
  std::uint64_t generation_ = 0;
  JobRunner runner_;
};

/// Draws a quantity over the view, with opacity and range; flips to the other result on request.
/// Pictures are made in the background; the previous one stays until they are ready.
class Overlay : public QObject {
  Q_OBJECT

 public:
  Overlay(Session& session, ViewerArea& viewer_area, QObject* parent);

  /// Sets the provider of maps of a subject, which must outlive this; null removes it.
  void setProvider(render::Subject subject, const MapProvider* provider);
  /// A provider's maps, or their availability, changed.
  void updateProvided();

  /// Ignored if the quantity is unavailable.
  void setQuantity(render::Quantity quantity);
  /// Shows disparity, unless a quantity of results is shown already.
  void showResults();
  void selectNextQuantity();
  [[nodiscard]] render::Quantity quantity() const { return quantity_; }
  /// As `quantity`, but Quantity::Difference while that is shown instead.
  [[nodiscard]] render::Quantity chosenQuantity() const;
  /// Whether a quantity can be shown now.
  [[nodiscard]] bool isAvailable(render::Quantity quantity) const;

  /// Shows shown − compared instead of the quantity.
  void setDifference(bool shows_difference);
  [[nodiscard]] bool showsDifference() const { return shows_difference_; }
  /// Shows the other result (or the truth, or no overlay) instead of the shown one.
  void setFlipped(bool is_flipped);
  [[nodiscard]] bool isFlipped() const { return is_flipped_; }

  /// Drawn choice: A, the difference, or B while flipped.
  [[nodiscard]] MapChoice choice() const;
  /// A: the quantity of the shown result.
  [[nodiscard]] MapChoice choiceA() const;
  /// B: the quantity of the other result, else of the truth, else the view alone.
  [[nodiscard]] MapChoice choiceB() const;
  /// "error of EPI_L", "truth"; "view" without an overlay.
  [[nodiscard]] QString describe(const MapChoice& choice) const;
  /// What B is; the truth also where only the view can be shown for it.
  [[nodiscard]] QString nameB() const;
  /// Description of B; says so where B is the truth, which has no error to show.
  [[nodiscard]] QString describeB() const;
  /// Current colors, with edited ranges.
  [[nodiscard]] render::Shading shadingOf(render::Quantity quantity) const;
  /// How a quantity lies over the view. Each of the two kinds of maps keeps its opacity: errors and
  /// differences begin opaque, so that their colors are those of the legend.
  [[nodiscard]] OverlayLook lookOf(render::Quantity quantity) const;
  /// Sets whether the view keeps its colors under maps.
  void setViewColored(bool is_colored);
  [[nodiscard]] bool isViewColored() const { return is_view_colored_; }
  /// Source of a choice's map in the current view; none if there is none, or not yet.
  [[nodiscard]] std::optional<MapSource> sourceOf(const MapChoice& choice) const;
  /// Picture of a choice in the current view, null if there is none. None while it is being made;
  /// `drawn` tells when to ask again.
  [[nodiscard]] std::optional<QImage> pictureOf(const MapChoice& choice);

  /// Sets the range of the colors; none = the quantity's own range.
  void setRange(std::optional<Interval> range);
  /// Whether `map` shows the last choice, instead of the previous map.
  [[nodiscard]] bool isUpToDate() const { return is_up_to_date_; }
  /// Drawn map; null without one.
  [[nodiscard]] const QuantityMapPtr& map() const { return map_; }
  /// Value of the overlay at a pixel of the current view.
  [[nodiscard]] std::optional<double> valueAt(PixelIndex pixel) const;
  /// The picture over the view; null if there is none.
  [[nodiscard]] const QImage& picture() const { return picture_; }

 signals:
  /// Quantity, difference or availability changed.
  void choiceChanged();
  /// The picture over the view, or its colors, changed.
  void drawn();

 private:
  void leaveWhatIsGone();
  [[nodiscard]] bool isTruthWithoutError(const MapChoice& choice) const;
  [[nodiscard]] bool isAwaited(render::Quantity quantity) const;
  void connectStage();
  void choose(render::Quantity quantity);
  void setOpacity(double opacity);
  void showLook();
  void update(Parts parts);
  void beginScene();
  void showAvailable();
  void draw();
  void drawMap(const MapChoice& choice);
  void showScale(const MapChoice& choice) const;
  void showClasses(render::Quantity quantity) const;
  void showCaption(const MapChoice& choice) const;

  Session& session_;
  ViewerArea& viewer_area_;
  std::map<render::Subject, const MapProvider*> providers_;
  render::Quantity quantity_ = render::Quantity::View;
  bool shows_difference_ = false;
  bool is_flipped_ = false;
  bool is_up_to_date_ = true;
  bool is_view_colored_ = false;
  double opacity_ = 1;
  double error_opacity_ = 1;
  std::size_t known_estimates_ = 0;
  std::uint64_t scene_ = 0;                             // that is drawn
  std::map<render::Quantity, Interval> edited_ranges_;  // all disparities under one
  QuantityMapPtr map_;
  QImage picture_;
  OverlayPictures pictures_;
};

/// Command of the menu of maps that shows a quantity, without keys.
[[nodiscard]] Command map_command(Overlay& overlay, render::Quantity quantity, const QString& id);

/// Whether a quantity shows a result or its error.
[[nodiscard]] bool is_of_result(render::Quantity quantity);

/// Stored samples of a pixel, one text per channel.
[[nodiscard]] QStringList sample_texts(const LightField& light_field, ViewIndex view,
                                       PixelIndex pixel);

/// Says that a result belongs to another light field; empty if it does not.
[[nodiscard]] QString foreign_text(const EstimateEntry& entry);

/// A parameter of an estimate as forms name it: "Inner scale 1.2 px".
[[nodiscard]] QString named_value(const Estimate& estimate, const std::string& key,
                                  const ParameterValue& value);
/// What distinguishes a run of a method: whether it ended early, and its changed parameters but
/// those that are `shared`; "defaults" without any. Empty if its parameters are not known.
[[nodiscard]] QString parameter_text(const Estimate& estimate, const ParameterSet& shared = {});

}  // namespace episcope
