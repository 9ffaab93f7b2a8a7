// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

class Frame;
class JobCancel;
class Jobs;
class Messages;

/// Shows the jobs under the tabs, with their buttons, and tells the user of those that failed.
void show_jobs(Jobs& jobs, JobCancel& cancel, Frame& frame, Messages& messages);

}  // namespace episcope
