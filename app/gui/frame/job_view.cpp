// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/job_view.h"

#include "app/gui/frame/frame.h"
#include "app/gui/frame/job_cancel.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "widgets/controls/job_panel.h"

namespace episcope {

void show_jobs(Jobs& jobs, JobCancel& cancel, Frame& frame, Messages& messages) {
  auto* panel = new JobPanel(&frame);
  frame.addUnderTabs(panel);
  QObject::connect(&jobs, &Jobs::added, panel, &JobPanel::addJob);
  QObject::connect(&jobs, &Jobs::endsEarly, panel, &JobPanel::setIterative);
  QObject::connect(&jobs, &Jobs::progressed, panel, &JobPanel::setProgress);
  QObject::connect(&jobs, &Jobs::cancelling, panel, &JobPanel::setCancelling);
  QObject::connect(&jobs, &Jobs::finishing, panel, &JobPanel::setFinishing);
  QObject::connect(&jobs, &Jobs::removed, panel, &JobPanel::removeJob);
  QObject::connect(panel, &JobPanel::cancelRequested, &cancel,
                   [&cancel](quint64 id) { cancel.cancel({id}); });
  QObject::connect(panel, &JobPanel::finishRequested, &jobs, &Jobs::finishEarly);
  QObject::connect(&jobs, &Jobs::failed, &messages, &Messages::fail);
}

}  // namespace episcope
