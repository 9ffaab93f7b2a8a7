// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/stage/map_provider.h"
#include "app/gui/stage/overlay_pictures.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"

#include <QImage>
#include <QObject>

#include <map>
#include <optional>

namespace episcope {

/// Draws a quantity over the view: which one, how opaque, in which range; flips to the other result
/// on request. Pictures are made in the background: what was drawn stays until they are ready.
class Overlay : public QObject {
  Q_OBJECT

 public:
  Overlay(Session& session, Stage& stage, QObject* parent);

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
  Stage& stage_;
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

}  // namespace episcope
