// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// The commit that was built, as `git describe --always --dirty` tells it; "unknown" where the
/// sources are no git checkout.
extern const char* const kCommit;

}  // namespace episcope
