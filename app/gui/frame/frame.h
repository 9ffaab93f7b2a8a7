// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QTabWidget;
class QToolBar;
class QWidget;

namespace episcope {

class AnnotationBar;
class BrushPanel;
class ColorBar;
class CompareBar;
class EpiPane;
class InfoPanel;
class JobPanel;
class LabelPalette;
class MessageBar;
class MethodPanel;
class MetricTable;
class OverlayBar;
class ResultList;
class SegmentPanel;
class StatisticsPanel;
class TileWall;
class ValueBar;
class ViewCanvas;
class ViewGrid;

/// The widgets of the main window, owned by their Qt parents. Controllers are given these.
struct Panels {
  QToolBar* tool_bar = nullptr;
  OverlayBar* overlay_bar = nullptr;
  QWidget* viewer = nullptr;  ///< Holds canvas, EPIs, legend and view grid.
  ViewCanvas* canvas = nullptr;
  TileWall* wall = nullptr;  ///< In the place of canvas and vertical EPI; hidden at first.
  EpiPane* horizontal_epi = nullptr;
  EpiPane* vertical_epi = nullptr;
  ColorBar* color_bar = nullptr;
  ViewGrid* view_grid = nullptr;
  InfoPanel* info = nullptr;
  QTabWidget* tabs = nullptr;
  MethodPanel* method = nullptr;
  ResultList* results = nullptr;
  CompareBar* compare = nullptr;
  StatisticsPanel* statistics = nullptr;
  MetricTable* metrics = nullptr;
  QWidget* annotate_tab = nullptr;
  BrushPanel* brush = nullptr;
  LabelPalette* labels = nullptr;
  SegmentPanel* segment = nullptr;
  AnnotationBar* annotation = nullptr;
  QWidget* cloud_tab = nullptr;  ///< Empty until it is shown first.
  JobPanel* jobs = nullptr;
  MessageBar* recovery = nullptr;  ///< What a crash left; other messages do not push it aside.
  MessageBar* messages = nullptr;
  ValueBar* values = nullptr;
};

/// Makes all panels and arranges them inside `window`.
[[nodiscard]] Panels make_panels(QWidget* window);

}  // namespace episcope
