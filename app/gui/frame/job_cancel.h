// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/jobs.h"

#include <QObject>
#include <QString>

#include <optional>
#include <vector>

namespace episcope {

class Messages;
class Session;

/// How the user ends jobs, by the cancel key or by a button. One that took long already is asked
/// for in a message, and ended if that is wanted again while the message is seen.
class JobCancel : public QObject {
  Q_OBJECT

 public:
  JobCancel(const Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Ends the newest job of the light field that is shown, or of none. Returns whether there was
  /// such a job.
  bool cancelNewest();
  /// Ends all of them, or asks for the one among them that has run longest.
  void cancel(const std::vector<quint64>& ids);
  /// Jobs that ran for less time are ended at once: 10 s unless set.
  void setWorthAsking(double seconds) { worth_asking_s_ = seconds; }

 private:
  [[nodiscard]] std::optional<Jobs::Running> longestOf(const std::vector<quint64>& ids) const;
  void ask(const std::vector<quint64>& ids, const Jobs::Running& longest);
  void end(const std::vector<quint64>& ids, const Jobs::Running& longest);

  const Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  double worth_asking_s_ = 10;
  quint64 asked_ = 0;  // job that was asked for last,
  QString question_;   // by this sentence
};

}  // namespace episcope
