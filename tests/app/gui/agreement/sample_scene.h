// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/scene.h"
#include "tests/app/gui/window_fixture.h"

#include <QMetaType>
#include <QString>
#include <QStringList>

#include <vector>

namespace episcope {

/// A small light field on which window and command line are held against each other.
struct SampleScene {
  const char* name;
  const char* builtin;
  GridShape grid{5, 5};
  /// With region masks, which the archive form has no place for.
  bool is_benchmark_form = false;
  bool has_camera = true;
  enum class Truth { AllViews, CenterView, WithHoles, None } truth = Truth::AllViews;
  double focus_px = 0;   ///< Focus plane that it is read at.
  bool is_drawn = true;  ///< Whether its pictures tell more than those of the others.
};

/// Every kind: one and two layers, labels, masks, one view, 3×3 views, parts of the truth.
[[nodiscard]] const std::vector<SampleScene>& sample_scenes();

/// The sample scene and two results of it in the window.
class AgreementFixture : public WindowFixture {
 public:
  explicit AgreementFixture(const SampleScene& sample);

  [[nodiscard]] Session& session() { return window.bench().session; }
  /// What opens the light field, and the options that it was read with, as on the command line.
  [[nodiscard]] QStringList input();
  /// All views, with everything that a result can have; shown.
  [[nodiscard]] const EstimateEntry& first() { return session().estimates().at(0); }
  /// The center view in one layer.
  [[nodiscard]] const EstimateEntry& second() { return session().estimates().at(1); }
  /// The result file that the window exports.
  [[nodiscard]] QString exported(const EstimateEntry& entry);
  /// Waits until a file that was asked for is there, and nothing runs.
  [[nodiscard]] bool waitForFile(const QString& file);

 private:
  void addResults();
};

}  // namespace episcope

Q_DECLARE_METATYPE(const episcope::SampleScene*)
