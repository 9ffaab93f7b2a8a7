// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/scene/viewer_area.h"
#include "app/session/map_choice.h"
#include "app/session/picture.h"
#include "app/session/session.h"
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

/// Gives the overlay the maps of a subject that the session does not hold.
class MapProvider {
 public:
  virtual ~MapProvider() = default;

  /// Whether a quantity can be shown now, in the current view.
  [[nodiscard]] virtual bool has_map(render::Quantity quantity) const = 0;
  /// Whether there may be maps of it later, so that what is shown stays chosen until then.
  [[nodiscard]] virtual bool awaits_map(render::Quantity quantity) const = 0;
  /// What the map shows, in words; empty where the name of the quantity says it.
  [[nodiscard]] virtual QString title(render::Quantity) const { return {}; }
  /// What the map of a view is made from; nothing if there is no such map.
  [[nodiscard]] virtual std::optional<MapSource> map_source(render::Quantity quantity,
                                                            ViewIndex view) const = 0;
};

/// Pictures of maps in their colours, made in the background one at a time. The most recently used
/// are kept, since flips and wipes alternate between two.
class OverlayPictures {
 public:
  struct Entry {
    MapSource source;
    render::Shading shading;
    QuantityMapPtr map;
    QImage picture;
  };

  /// `made` is called on the thread of `post` when a picture that was begun is there, or failed.
  OverlayPictures(JobRunner::Post post, std::function<void()> made);

  /// Null if it is not there.
  [[nodiscard]] const Entry* find(const MapSource& source, const render::Shading& shading);
  /// The map alone, which may be there before its picture; null if it is not.
  [[nodiscard]] QuantityMapPtr find_map(const MapSource& source) const;
  /// Begins to make a picture, unless one is being made: then `made` tells when to ask again.
  void begin(const MapSource& source, const render::Shading& shading);
  /// Forgets all; what is being made is not kept.
  void clear();

 private:
  void keep(Entry entry);

  std::function<void()> made_;
  std::list<Entry> entries_;
  bool is_making_ = false;
  std::uint64_t generation_ = 0;
  JobRunner runner_;
};

/// Draws a quantity over the view: which one, how opaque, in which range; flips to the other result
/// on request. Pictures are made in the background: what was drawn stays until they are ready.
class Overlay : public QObject {
  Q_OBJECT

 public:
  Overlay(Session& session, ViewerArea& viewer_area, QObject* parent);

  /// Whose maps are drawn for quantities of this subject; it must outlive this. Null takes it away.
  void setProvider(render::Subject subject, const MapProvider* provider);
  /// The maps of a provider changed, or which of them there are.
  void updateProvided();

  /// Ignored if it is not available.
  void setQuantity(render::Quantity quantity);
  /// Disparity, unless what is shown is of results already.
  void showResults();
  void selectNextQuantity();
  [[nodiscard]] render::Quantity quantity() const { return quantity_; }
  /// Whether a quantity can be shown now.
  [[nodiscard]] bool isAvailable(render::Quantity quantity) const;

  /// Shows shown − compared instead of the quantity.
  void setDifference(bool shows_difference);
  [[nodiscard]] bool showsDifference() const { return shows_difference_; }
  /// Shows the other result (or the truth, or no overlay) instead of the shown one.
  void setFlipped(bool is_flipped);
  [[nodiscard]] bool isFlipped() const { return is_flipped_; }

  /// What is drawn: A, the difference, or B while flipped.
  [[nodiscard]] MapChoice choice() const;
  /// The quantity of the shown result.
  [[nodiscard]] MapChoice choiceA() const;
  /// The same of what it is compared with: the other result, else the truth, else the view alone.
  [[nodiscard]] MapChoice choiceB() const;
  /// "error of EPI_L", "truth"; "view" without an overlay.
  [[nodiscard]] QString describe(const MapChoice& choice) const;
  /// The same of B; says so where B is the truth, which has no error to show.
  [[nodiscard]] QString describeB() const;
  /// Colours as they are drawn now, edited ranges included.
  [[nodiscard]] render::Shading shadingOf(render::Quantity quantity) const;
  /// What the map of a choice in the current view is made from; nothing if there is none, or not
  /// yet.
  [[nodiscard]] std::optional<MapSource> sourceOf(const MapChoice& choice) const;
  /// Picture of a choice in the current view, null if there is none; nothing while it is being
  /// made: `drawn` tells when to ask again.
  [[nodiscard]] std::optional<QImage> pictureOf(const MapChoice& choice);

  /// Range of what is drawn; none = the quantity's own one.
  void setRange(std::optional<Interval> range);
  /// Whether `map` is what was chosen last, and not what stays until that is there.
  [[nodiscard]] bool isUpToDate() const { return is_up_to_date_; }
  /// What is drawn; null without a map.
  [[nodiscard]] const QuantityMapPtr& map() const { return map_; }
  /// Value of the overlay at a pixel of the current view.
  [[nodiscard]] std::optional<double> valueAt(PixelIndex pixel) const;
  /// The picture over the view; null if there is none.
  [[nodiscard]] const QImage& picture() const { return picture_; }

 signals:
  /// Quantity, difference, or what is available changed.
  void choiceChanged();
  /// What is over the view, or its colours, changed.
  void drawn();

 private:
  void leaveWhatIsGone();
  [[nodiscard]] bool isTruthWithoutError(const MapChoice& choice) const;
  [[nodiscard]] bool isAwaited(render::Quantity quantity) const;
  void connectStage();
  void update(Parts parts);
  void beginScene();
  void showAvailable();
  void draw();
  void drawMap(const MapChoice& choice);
  void showScale(const MapChoice& choice) const;
  void showCaption(const MapChoice& choice) const;

  Session& session_;
  ViewerArea& viewer_area_;
  std::map<render::Subject, const MapProvider*> providers_;
  render::Quantity quantity_ = render::Quantity::View;
  bool shows_difference_ = false;
  bool is_flipped_ = false;
  bool is_up_to_date_ = true;
  std::size_t known_estimates_ = 0;
  std::uint64_t scene_ = 0;                             // that is drawn
  std::map<render::Quantity, Interval> edited_ranges_;  // all disparities under one
  QuantityMapPtr map_;
  QImage picture_;
  OverlayPictures pictures_;
};

/// Whether a quantity shows a result or its error.
[[nodiscard]] bool is_of_result(render::Quantity quantity);

/// The samples of a pixel as they are stored, one text a channel.
[[nodiscard]] QStringList sample_texts(const LightField& light_field, ViewIndex view,
                                       PixelIndex pixel);

}  // namespace episcope
