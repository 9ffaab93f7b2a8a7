// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/frame.h"
#include "app/session/session.h"

#include <QObject>

#include <memory>

namespace episcope {

/// Shows scribbles: on the view, and which views are painted in the grid. Where wanted, carries
/// them to all views by a disparity map, in the background, as a layer of its own that follows
/// every edit.
class ScribbleController : public QObject {
  Q_OBJECT

 public:
  ScribbleController(Session& session, DocumentController& document, const Panels& panels,
                     QObject* parent);

  void setCarried(bool is_carried);
  [[nodiscard]] bool isCarried() const { return is_carried_; }
  /// What was carried, bare wherever something is painted; null without. It may be older than the
  /// document.
  [[nodiscard]] const std::shared_ptr<const ScribbleLayer>& carried() const { return carried_; }
  [[nodiscard]] bool isCarrying() const { return is_carrying_; }
  /// While suspended, something else than the session is on the canvas.
  void setSuspended(bool is_suspended);

 signals:
  void carriedChanged();
  void hint(const QString& sentence);

 private:
  void update(Parts parts);
  void show();
  void showRect(ViewIndex view, const PixelRect& rect);
  void showChange(const DocumentChange& change);
  void markViews();
  [[nodiscard]] QImage picture(const PixelRect& rect) const;
  void carry();
  void dropCarried();
  /// What to carry by: keeps the scene or the estimate alive. Null if there is none.
  [[nodiscard]] std::shared_ptr<const DisparityField> field() const;

  Session& session_;
  DocumentController& document_;
  Panels panels_;
  bool is_carried_ = false;
  bool is_carrying_ = false;
  bool is_suspended_ = false;
  std::shared_ptr<const ScribbleLayer> carried_;
  std::shared_ptr<const DisparityField> carried_by_;
  LatestJob carry_job_;
};

}  // namespace episcope
