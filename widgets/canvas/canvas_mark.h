// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>
#include <QString>

#include <optional>

namespace episcope {

/// A named point on a picture. Places are in image coordinates (canvas_transform.h).
struct CanvasMark {
  QPointF at;
  /// Where it should be: a line leads there.
  std::optional<QPointF> wanted{};
  QString name{};
  bool is_emphasised = false;
  friend bool operator==(const CanvasMark&, const CanvasMark&) = default;
};

}  // namespace episcope
