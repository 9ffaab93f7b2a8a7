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

bool JobCancel::cancel() {
  const auto job = jobs_.newest(session_.generation());
  if (!job) return false;
  if (job->seconds < worth_asking_s_) {
    jobs_.cancel(job->id);
  } else if (asked_ == job->id && messages_.isShown(question_)) {
    end(job->id);
  } else if (!job->is_cancelling) {
    ask(*job);
  }
  return true;
}

void JobCancel::ask(const Jobs::Running& job) {
  asked_ = job.id;
  question_ = tr("%1 is at %2 %. Cancel again to end it.")
                  .arg(job.title)
                  .arg(std::lround(100 * job.fraction));
  messages_.offer(question_, tr("Cancel it"), [this, id = job.id] { end(id); });
}

void JobCancel::end(quint64 id) {
  const auto job = jobs_.find(id);
  if (!job) return;
  jobs_.cancel(id);
  messages_.hint(
      tr("%1 was cancelled at %2 %.").arg(job->title).arg(std::lround(100 * job->fraction)));
}

}  // namespace episcope

#include "moc_job_cancel.cpp"
