// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <span>

class QMenu;

namespace episcope {

class Autosave;
class LabelPalette;
class LabelReviewPanel;
class MethodPanel;
class MetricTable;
class RegionController;
class SegmentController;
class SegmentPanel;

/// Row of the table of features. A feature adds its widgets, tabs, commands and controllers to the
/// window. Features share only the workbench.
struct Feature {
  const char* id;
  void (*add)(const Workbench&);
};

/// Every feature of the window, in the order in which they add widgets and commands.
[[nodiscard]] std::span<const Feature> features();

/// Features, and parts of them, whose classes are known to their own source alone.
void add_views(const Workbench& bench);
void add_focus(const Workbench& bench);
void add_values(const Workbench& bench);
void add_cloud(const Workbench& bench);
void add_recovery(const Workbench& bench);
void add_label_look(const Workbench& bench, LabelPalette* palette);
void add_label_strip(const Workbench& bench, LabelReviewPanel* panel);
/// What segments, smooths, shows and exports labels, in the menus and on the panel.
void add_segment_commands(const Workbench& bench, SegmentController& segments, SegmentPanel& panel);
void add_metrics(const Workbench& bench, MetricTable* table, const RegionController& region);
void add_error_plots(const Workbench& bench, const RegionController& region);
void add_method_range(const Workbench& bench, MethodPanel& panel);
void add_sweeps(const Workbench& bench, MethodPanel& panel);
void add_session_recovery(const Workbench& bench, Autosave& autosave);
void add_collection(const Workbench& bench);
void add_project(const Workbench& bench);
/// `recent` lists recent inputs and outlives the window.
void add_start_strip(const Workbench& bench, QMenu* recent);

}  // namespace episcope
