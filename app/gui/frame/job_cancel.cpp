// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/job_cancel.h"

#include "app/gui/frame/messages.h"
#include "app/session/session.h"

#include <cmath>

namespace episcope {

JobCancel::JobCancel(const Session& session, Jobs& jobs, Messages& messages, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), messages_(messages) {
  connect(&jobs_, &Jobs::removed, this, [this](quint64 id) {
    if (id == asked_) messages_.retract(question_);
  });
}

bool JobCancel::cancelNewest() {
  const auto job = jobs_.newest(session_.generation());
  if (job) cancel({job->id});
  return job.has_value();
}

void JobCancel::cancel(const std::vector<quint64>& ids) {
  const auto longest = longestOf(ids);
  if (!longest) return;
  if (longest->seconds < worth_asking_s_) {
    for (const quint64 id : ids) jobs_.cancel(id);
  } else if (asked_ == longest->id && messages_.isShown(question_)) {
    end(ids, *longest);
  } else {
    ask(ids, *longest);
  }
}

// Of those that are not being cancelled.
std::optional<Jobs::Running> JobCancel::longestOf(const std::vector<quint64>& ids) const {
  std::optional<Jobs::Running> longest;
  for (const quint64 id : ids) {
    const auto job = jobs_.find(id);
    if (!job || job->is_cancelling) continue;
    if (!longest || job->seconds > longest->seconds) longest = job;
  }
  return longest;
}

void JobCancel::ask(const std::vector<quint64>& ids, const Jobs::Running& longest) {
  asked_ = longest.id;
  question_ = tr("%1 is at %2 %. Cancel again to end it.")
                  .arg(longest.title)
                  .arg(std::lround(100 * longest.fraction));
  messages_.offer(question_, tr("Cancel it"), [this, ids] {
    if (const auto job = longestOf(ids)) end(ids, *job);
  });
}

void JobCancel::end(const std::vector<quint64>& ids, const Jobs::Running& longest) {
  for (const quint64 id : ids) jobs_.cancel(id);
  messages_.hint(
      tr("%1 was cancelled at %2 %.").arg(longest.title).arg(std::lround(100 * longest.fraction)));
}

}  // namespace episcope

#include "moc_job_cancel.cpp"
