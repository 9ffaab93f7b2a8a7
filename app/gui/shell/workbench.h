// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QObject;
class QWidget;

namespace episcope {

class Cancels;
class Commands;
class DocumentController;
class Frame;
class JobCancel;
class Jobs;
class LabelChoice;
class LeaveGuards;
class Messages;
class Overlay;
class ResultOpener;
class SceneOpener;
class SceneSwitcher;
class Session;
class ViewerArea;

/// What features work with: the places of the window and the services they share. All of it
/// outlives them.
struct Workbench {
  QWidget& window;  ///< Parent of dialogs.
  QObject& owner;   ///< Of the controllers of features.
  Session& session;
  Jobs& jobs;
  Messages& messages;
  JobCancel& job_cancel;
  Commands& commands;
  Cancels& cancels;
  LeaveGuards& guards;
  Frame& frame;
  ViewerArea& viewer_area;
  Overlay& overlay;
  DocumentController& document;
  LabelChoice& labels;
  SceneSwitcher& scenes;
  SceneOpener& opener;
  ResultOpener& results;
};

/// One row of the table of features: a feature hands the window its widgets, tabs, commands and
/// controllers. Features do not know each other; what they share is the workbench.
struct Feature {
  const char* id;
  void (*add)(const Workbench&);
};

}  // namespace episcope
