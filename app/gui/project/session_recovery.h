// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/jobs.h"
#include "app/session/project/workspace.h"

#include <QObject>

#include <vector>

namespace episcope {

class Autosave;
class MessageBar;

/// Offers the scenes and results of a session that ended unexpectedly, with what was painted on
/// them, in a bar that blocks nothing.
class SessionRecovery : public QObject {
  Q_OBJECT

 public:
  SessionRecovery(const Workbench& bench, Autosave& autosave);

  /// Looks for workspaces in the background and offers the latest.
  void look();

 private:
  void offerNext();
  void recover(const LeftWorkspace& left);
  void takeOver(const LeftWorkspace& left);

  Workbench bench_;
  Autosave& autosave_;
  MessageBar* bar_;
  std::vector<LeftWorkspace> left_;  // the one to be offered next comes last
  LatestJob job_;
};

}  // namespace episcope
