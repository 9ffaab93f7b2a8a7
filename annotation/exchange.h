// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document.h"
#include "engine/core/scene.h"

namespace episcope {

/// The painted views and the labels of a document, for writing to files.
[[nodiscard]] Scribbles scribbles_of(const AnnotationDocument& document);
/// Painted views alone, without names and colors.
[[nodiscard]] Scribbles scribbles_of(const ScribbleLayer& layer);

/// A document with the scribbles of a file. Painted ids without a name get a default name and a
/// color of the palette. Throws InvalidInput for ids above 255 or below 0, bad names, or views
/// that do not fit.
[[nodiscard]] AnnotationDocument document_from(
    const Scribbles& scribbles, GridShape grid, int height, int width,
    std::size_t history_bytes = AnnotationDocument::kHistoryBytes);

/// Merges the scribbles of a file into a document, as one edit: adds labels whose ids it does not
/// have, and pixels where nothing is painted. Returns whether that changed anything. Throws
/// InvalidInput as `document_from`, changing nothing.
bool import_scribbles(AnnotationDocument& document, const Scribbles& scribbles,
                      EditKind kind = EditKind::Import);

}  // namespace episcope
