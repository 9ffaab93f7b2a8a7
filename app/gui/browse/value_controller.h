// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"

#include <QObject>
#include <QStringList>

#include <optional>

namespace episcope {

/// The samples of a pixel, one text a channel, as they are stored.
[[nodiscard]] QStringList sample_texts(const LightField& light_field, ViewIndex view,
                                       PixelIndex pixel);

/// Reads out what is known of the pixel under the cursor (of the cross-hair while the cursor is
/// elsewhere), and prints values into large pixels.
class ValueController : public QObject {
  Q_OBJECT

 public:
  ValueController(Session& session, const OverlayController& overlay, const Panels& panels,
                  QObject* parent);

 private:
  void show();
  [[nodiscard]] QStringList pixelText(PixelIndex pixel) const;

  Session& session_;
  const OverlayController& overlay_;
  Panels panels_;
  std::optional<PixelIndex> cursor_;
};

}  // namespace episcope
