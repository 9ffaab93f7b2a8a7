// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/frame.h"
#include "app/session/session.h"
#include "widgets/canvas/tools/stroke_tool.h"

#include <QObject>

#include <cstdint>
#include <functional>

namespace episcope {

/// Painting on the view: browse or annotate, the tool in hand, sizes, the current label, strokes
/// and fills.
class AnnotateController : public QObject {
  Q_OBJECT

 public:
  /// The segmentation of a view, `[y][x]`; empty if there is none.
  using Segmentation = std::function<ImageView<const std::int32_t>(ViewIndex)>;

  AnnotateController(Session& session, DocumentController& document, const Panels& panels,
                     QObject* parent);
  ~AnnotateController() override;

  /// While annotating, the mouse paints; the tab is shown. Without a light field nothing happens.
  void setAnnotating(bool is_annotating);
  [[nodiscard]] bool isAnnotating() const { return is_annotating_; }
  /// While suspended, something else than the session is on the canvas.
  void setSuspended(bool is_suspended);

  /// Takes a tool in hand, and begins to annotate.
  void setTool(AnnotationTool tool);
  [[nodiscard]] AnnotationTool tool() const { return tool_->tool(); }
  /// Makes the brush, or the eraser if that is in hand, larger or smaller.
  void stepSize(double steps);
  void setProtectsOthers(bool protects);
  [[nodiscard]] bool protectsOthers() const { return protects_others_; }

  /// The current label; 0 without labels.
  [[nodiscard]] int label() const { return label_; }
  void chooseLabel(int id);
  void chooseNextLabel();
  /// Back to the label before this one.
  void swapLabels();
  void addLabel();
  void renameLabel();
  /// Asks first if something is painted with it.
  void removeLabel(int id);
  void recolorLabel(int id);

  /// What fills may be bounded by; an empty function for none.
  void setSegmentation(Segmentation segmentation);
  /// Takes the stroke back that is under way; false if there is none.
  bool cancelStroke();

 signals:
  void modeChanged();
  void toolChanged();
  void labelChanged();
  void hint(const QString& sentence);

 private:
  void connectTool();
  void connectPanel();
  void connectPalette();
  void update(Parts parts);
  void showMode();
  [[nodiscard]] QString labelHint() const;
  void showLabels();
  void showTab();
  [[nodiscard]] bool isTabShown() const;
  /// Strokes are seen with the tab that they are edited in: over errors they would hide some.
  void showScribbles();
  [[nodiscard]] PaintStyle styleOf(const StrokeStart& start) const;
  bool requireLabel();
  void fill(const StrokeStart& start);
  void pick(QPointF image);
  void removeNow(int id);
  [[nodiscard]] bool isPainted(int id) const;
  void goTo(const DocumentChange& change);

  Session& session_;
  DocumentController& document_;
  Panels panels_;
  BrushTool* tool_;
  Segmentation segmentation_;
  int label_ = 0;
  int former_label_ = 0;
  bool protects_others_ = false;
  bool is_annotating_ = false;
  bool is_suspended_ = false;
};

}  // namespace episcope
