// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/session/space/space_scene.h"
#include "widgets/cloud/cloud_choice.h"
#include "widgets/cloud/cloud_controls.h"

#include <QString>

#include <optional>

namespace episcope {

struct EstimateEntry;

/// Turns what a user chose of the 3D view into what is to be made of the session, as things are
/// now. What is seen is the shown result; without one, the ground truth.
class CloudRequests {
 public:
  explicit CloudRequests(const Workbench& bench) : bench_(bench) {}

  /// Why nothing can be seen, as a sentence; empty if something can.
  [[nodiscard]] QString obstacle() const;
  /// What can be chosen. Precondition: there is no obstacle.
  [[nodiscard]] CloudOffers offers() const;
  /// Nothing if a map of it is not there yet: its evaluation tells when it is. What cannot be had
  /// is left out. Precondition: there is no obstacle.
  [[nodiscard]] std::optional<SpaceRequest> request(const CloudChoice& choice) const;
  /// What distances are measured to: "ground truth" or a result.
  [[nodiscard]] QString referenceName(const CloudChoice& choice) const;
  /// What is drawn: "EPI_L", or "EPI_L and ground truth".
  [[nodiscard]] QString title(const CloudChoice& choice) const;
  /// Whose colours a legend explains; none for those of views, labels and sources.
  [[nodiscard]] QString legend(const CloudChoice& choice) const;

 private:
  /// What is shown, if it has a map of this view; the truth stands in for it.
  [[nodiscard]] const EstimateEntry* result() const;
  [[nodiscard]] CloudChoice possible(CloudChoice choice) const;
  [[nodiscard]] std::shared_ptr<const DisparityField> truth() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> other() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> reference(CloudCompanion companion) const;
  /// What is drawn beside the companion.
  [[nodiscard]] std::shared_ptr<const DisparityField> main() const;
  [[nodiscard]] render::Quantity quantity(CloudColoring coloring) const;
  [[nodiscard]] std::optional<MapSource> map(CloudColoring coloring, int estimate) const;
  /// Whether all are there.
  [[nodiscard]] bool addMaps(const CloudChoice& choice, SpaceRequest& request) const;
  [[nodiscard]] QString otherName() const;

  Workbench bench_;
};

}  // namespace episcope
