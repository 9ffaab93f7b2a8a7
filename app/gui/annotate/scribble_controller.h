// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/core/disparity_field.h"
#include "engine/core/indices.h"

#include <QImage>
#include <QObject>

#include <memory>

namespace episcope {

class AnnotationBar;
class ViewCanvas;

/// Shows scribbles on the view and marks painted views. On request carries them to all views by a
/// disparity map, in the background, as a separate layer that follows every edit.
class ScribbleController : public QObject {
  Q_OBJECT

 public:
  ScribbleController(const Workbench& bench, AnnotationBar* bar);

  void setCarried(bool is_carried);
  [[nodiscard]] bool isCarried() const { return is_carried_; }
  /// Carried labels; empty wherever something is painted, null if nothing is carried. May lag
  /// behind the document.
  [[nodiscard]] const std::shared_ptr<const ScribbleLayer>& carried() const { return carried_; }
  [[nodiscard]] bool isCarrying() const { return is_carrying_; }

 private:
  void addCommand();
  void update(Parts parts);
  void show();
  void showRect(ViewIndex view, const PixelRect& rect);
  void showChange(const DocumentChange& change);
  [[nodiscard]] QImage picture(const PixelRect& rect) const;
  void carry();
  void dropCarried();
  /// Disparity used to carry scribbles, which keeps its scene or estimate alive; null if there is
  /// none.
  [[nodiscard]] std::shared_ptr<const DisparityField> field() const;

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  ViewCanvas* canvas_;
  AnnotationBar* bar_;
  bool is_carried_ = false;
  bool is_carrying_ = false;
  std::shared_ptr<const ScribbleLayer> carried_;
  std::shared_ptr<const DisparityField> carried_by_;
  LatestJob carry_job_;
};

}  // namespace episcope
