// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/session/picture/map_choice.h"
#include "app/session/picture/picture.h"
#include "app/session/session.h"
#include "engine/core/parallel/job_runner.h"

#include <QImage>
#include <QObject>

#include <list>
#include <map>
#include <optional>

namespace episcope {

/// Draws a quantity over the view: which one, how opaque, in which range; flips to the other result
/// while asked to. Pictures are made in the background: what was drawn stays until they are there.
class OverlayController : public QObject {
  Q_OBJECT

 public:
  OverlayController(Session& session, const Panels& panels, QObject* parent);

  void setQuantity(render::Quantity quantity);
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
  [[nodiscard]] render::Shading shadingOf(const MapChoice& choice) const;
  /// Picture of a choice in the current view, null if there is none; nothing while it is being
  /// made: `drawn` tells when to ask again.
  [[nodiscard]] std::optional<QImage> pictureOf(const MapChoice& choice);

  /// Range of what is drawn; none = the quantity's own one.
  void setRange(std::optional<Interval> range);
  void useOwnRange();
  /// Whether `map` is what was chosen last, and not what stays until that is there.
  [[nodiscard]] bool isUpToDate() const { return is_up_to_date_; }
  /// What is drawn; null without a map.
  [[nodiscard]] const QuantityMapPtr& map() const { return map_; }

  /// While suspended, something else than the session is on the canvas.
  void setSuspended(bool is_suspended);

  /// Value of the overlay at a pixel of the current view.
  [[nodiscard]] std::optional<double> valueAt(PixelIndex pixel) const;
  /// Colours of a quantity as they are drawn now.
  [[nodiscard]] render::Shading shadingOf(render::Quantity quantity) const;
  /// The picture over the view; null if there is none.
  [[nodiscard]] const QImage& picture() const { return picture_; }

 signals:
  /// Quantity, difference, or what is available changed.
  void choiceChanged();
  /// What is over the view, or its colours, changed.
  void drawn();

 private:
  void update(Parts parts);
  struct Shaded {
    MapSource source;
    render::Shading shading;
    QuantityMapPtr map;
    QImage picture;
  };
  [[nodiscard]] const Shaded* find(const MapSource& source, const render::Shading& shading);
  [[nodiscard]] QuantityMapPtr knownMap(const MapSource& source) const;
  void beginShading(const MapSource& source, const render::Shading& shading);
  void finishShading(Shaded shaded);
  void showAvailable();
  void draw();
  void drawMap(const MapChoice& choice);
  void showCaption(const MapChoice& choice) const;

  Session& session_;
  Panels panels_;
  render::Quantity quantity_ = render::Quantity::View;
  bool shows_difference_ = false;
  bool is_flipped_ = false;
  bool is_suspended_ = false;
  bool is_up_to_date_ = true;
  std::size_t known_estimates_ = 0;
  std::map<render::Quantity, Interval> edited_ranges_;  // all disparities under one
  std::list<Shaded> shaded_;  // the newest used comes first: flips and wipes go to and fro
  bool is_shading_ = false;
  QuantityMapPtr map_;
  QImage picture_;
  JobRunner runner_;
};

}  // namespace episcope
