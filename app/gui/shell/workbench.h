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

/// What features work with: the places of the window and shared services. All of it outlives them.
struct Workbench {
  QWidget& window;  ///< Parent of dialogs.
  QObject& owner;   ///< Parent of controllers.
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

}  // namespace episcope
