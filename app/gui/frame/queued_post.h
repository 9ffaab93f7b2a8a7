// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/job_runner.h"

class QObject;

namespace episcope {

/// Posts closures through the event loop of the thread of `context`, from any thread; dropped when
/// `context` is destroyed. Whoever posts must have ended before `context` is.
[[nodiscard]] JobRunner::Post queued_post(QObject* context);

}  // namespace episcope
