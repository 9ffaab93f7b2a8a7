// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/byte_stream.h"
#include "annotation/document/edit.h"

namespace episcope {

/// Encodes an edit for the journal, about six bytes per run. The rectangles are omitted, since they
/// follow from the runs.
void write_edit(const Edit& edit, ByteWriter& out);

/// Throws InvalidInput for bytes that `write_edit` cannot have written.
[[nodiscard]] Edit read_edit(ByteReader& in);

}  // namespace episcope
