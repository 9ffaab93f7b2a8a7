// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/jobs.h"

#include <QObject>
#include <QString>

namespace episcope {

class Messages;
class Session;

/// What the cancel key does to jobs: it ends the newest one of the light field that is shown, or of
/// none. A job that took long already is asked for in a message, and ended if the key is pressed
/// again while that is seen.
class JobCancel : public QObject {
  Q_OBJECT

 public:
  JobCancel(const Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Returns whether there was such a job.
  bool cancel();
  /// Jobs that ran for less time are ended at once: 10 s unless set.
  void setWorthAsking(double seconds) { worth_asking_s_ = seconds; }

 private:
  void ask(const Jobs::Running& job);
  void end(quint64 id);

  const Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  double worth_asking_s_ = 10;
  quint64 asked_ = 0;  // job that was asked for last,
  QString question_;   // by this sentence
};

}  // namespace episcope
