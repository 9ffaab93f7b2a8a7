// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/byte_stream.h"
#include "annotation/document/edit.h"

namespace episcope {

/// An edit as bytes, about six for each run: for the journal. The rectangles are left out, since
/// the runs give them.
void write_edit(const Edit& edit, ByteWriter& out);

/// Throws InvalidInput for bytes that `write_edit` cannot have written.
[[nodiscard]] Edit read_edit(ByteReader& in);

}  // namespace episcope
