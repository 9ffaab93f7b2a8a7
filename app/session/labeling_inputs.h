// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/label_review.h"
#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/labeler.h"
#include "engine/labeling/ray_labeling.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// The disparity of a segmentation: it carries positions along the rays, and labels are judged by
/// it if the parameters say so.
struct LabelingDisparity {
  std::shared_ptr<const DisparityField> field;
  std::string origin;    ///< "truth", "net", or the file it was read from.
  EstimatePtr estimate;  ///< What `field` is part of; null for the truth.

  /// How sure the estimate is of each pixel; null if that is not known, as for the truth.
  [[nodiscard]] std::shared_ptr<const ViewStack<float>> confidence() const;
};

/// The disparity of an estimate, which must not be null.
[[nodiscard]] LabelingDisparity disparity_of(EstimatePtr estimate, const std::string& origin);

/// The method that estimates disparity for labels where none is given.
inline constexpr const char* kLabelingEstimator = "net";
/// Estimates it: of all views, those but the first as that one shows them. Throws InvalidInput,
/// Cancelled, and what the method throws.
[[nodiscard]] EstimatePtr estimate_for_labels(const Scene& scene, Device device,
                                              const Progress& progress);

/// Finds the disparity that the set of features needs: the truth for FeatureSet::ImageTruth, else
/// the result in `result_file`, brought to the focus plane of the scene, else an estimate of all
/// views by kLabelingEstimator on `device`. Throws InvalidInput if the scene has no true disparity
/// of all views or the result does not fit or covers fewer views; IoError, Cancelled.
[[nodiscard]] LabelingDisparity find_labeling_disparity(const Scene& scene,
                                                        const LabelerParameters& parameters,
                                                        const std::filesystem::path& result_file,
                                                        const Progress& progress,
                                                        Device device = Device::Auto);

/// Whether EDGE_WEIGHTS lie beside the light field.
[[nodiscard]] bool has_edge_probabilities(const Scene& scene);
/// EDGE_WEIGHTS that lie beside the light field; null if there are none. Throws IoError, Cancelled.
[[nodiscard]] std::shared_ptr<const ViewStack<float>> find_edge_probabilities(
    const Scene& scene, const Progress& progress);

/// A labeler with all that is known of a scene: the disparity, how sure that is, and edges beside
/// the light field. Throws IoError, Cancelled.
[[nodiscard]] Labeler labeler_of(const Scene& scene, const LabelingDisparity& disparity,
                                 const Progress& progress, Device device = Device::Auto);
/// judge_labeling by the true labels of the scene.
[[nodiscard]] LabelingScores judge_labeling(const Labeling& labeling, const Scene& scene,
                                            const LabelingDisparity& disparity,
                                            const Progress& progress);

/// Label probabilities of all views from a file of the archive. Its layers are the labels of
/// `painted` if there are as many, else 1, 2, …. Throws IoError; InvalidInput, naming the file, if
/// it covers one view only; Cancelled.
[[nodiscard]] LabelProbabilities read_all_probabilities(const std::filesystem::path& path,
                                                        const Scene& scene,
                                                        const Scribbles& painted,
                                                        const Progress& progress);

/// Writes the inputs of labels into a folder, in the archive's form: edge probabilities
/// (edge_weights.h5) and label probabilities by features of the image, with `estimate`, and with
/// the true disparity if the scene has it for all views. Returns their names. Throws InvalidInput
/// as the labeler, IoError, Cancelled.
std::vector<std::string> write_label_archive(const std::filesystem::path& folder,
                                             const Scene& scene, const Scribbles& painted,
                                             const LabelerParameters& parameters,
                                             const LabelingDisparity& estimate,
                                             const Progress& progress);

}  // namespace episcope
