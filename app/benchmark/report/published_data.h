// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// The text of resources/vmv2013.json, compiled in: its source is made when the build is
/// configured.
extern const char* const kPublishedData;

}  // namespace episcope
