// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/camera.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/rectify.h"
#include "engine/capture/solve_pose.h"
#include "engine/capture/view_surface.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace episcope {

/// A photograph of the calibration pattern.
struct CalibratedPhotograph {
  std::string name;       ///< Of the file, without its folder.
  double rms = 0;         ///< Reprojection error in px, if it was used.
  std::string problem{};  ///< Why it was left out; empty = used.
  friend bool operator==(const CalibratedPhotograph&, const CalibratedPhotograph&) = default;
};

/// A lens and where it comes from.
struct CaptureLens {
  capture::LensCamera camera;
  std::string file{};  ///< The lens was read from; empty = it was calibrated.
  std::vector<CalibratedPhotograph> photographs{};
  friend bool operator==(const CaptureLens&, const CaptureLens&) = default;
};

/// How well the rows of a rectified light field are aligned.
struct RowAlignment {
  capture::RowErrors before;
  capture::RowErrors after;
  friend bool operator==(const RowAlignment&, const RowAlignment&) = default;
};

/// An object before the cameras.
struct CaptureObject {
  std::string name;    ///< No other has it.
  std::string mesh{};  ///< File; empty = none was opened.
  std::vector<capture::PointPair> pairs{};
  /// Computed from the pairs; none if that is impossible or was not done yet.
  std::optional<capture::SolvedPose> pose{};

  /// Compares what the user did; the pose follows from it.
  friend bool operator==(const CaptureObject& a, const CaptureObject& b) {
    return a.name == b.name && a.mesh == b.mesh && a.pairs == b.pairs;
  }
};

/// The user's work between photographs and ground truth, for one light field.
struct CaptureWork {
  std::optional<CaptureLens> lens{};
  capture::Pattern pattern{};          ///< Of the next calibration.
  capture::RectifyOptions rectify{};   ///< Of the next rectification, or as it was made.
  std::optional<RowAlignment> rows{};  ///< Of a light field that was rectified.
  std::vector<CaptureObject> objects{};
  int current = 0;  ///< The object that is worked on.

  [[nodiscard]] bool empty() const { return *this == CaptureWork(); }
  /// The current object; null = there are none.
  [[nodiscard]] const CaptureObject* object() const;
  friend bool operator==(const CaptureWork&, const CaptureWork&) = default;
};

[[nodiscard]] CaptureLens lens_of(const capture::Calibration& calibration);

/// Computes the pose of every object with at least 4 pairs. Returns why the current object has
/// none; empty if it has one or too few pairs. There are no poses if `camera` has no pinhole.
std::string solve_poses(CaptureWork& work, const CameraGrid& camera);

/// What a project file holds of CaptureWork, as JSON: the lens with its photographs, settings,
/// rows, and objects with pairs and poses. Files are named relative to the folder of `project`
/// where that is possible.
[[nodiscard]] std::string capture_to_json(const CaptureWork& work,
                                          const std::filesystem::path& project);

/// Reads it back; also the form of earlier versions, which had one object and no lens. Throws
/// nlohmann's exception or InvalidInput for what is no such JSON.
[[nodiscard]] CaptureWork capture_from_json(const std::string& json,
                                            const std::filesystem::path& project);

/// A mesh and its pose before the cameras.
struct PosedMesh {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  capture::RigidPose pose;
};

/// The disparity of meshes in the center view, as a result to be drawn and compared. Throws what
/// capture::visible_depth does.
[[nodiscard]] Estimate mesh_estimate(std::span<const PosedMesh> meshes, const Scene& scene,
                                     const Progress& progress);

/// The scene with the depth of meshes in all views as its ground truth, and as labels which mesh is
/// seen, from 1 on. Throws as `mesh_estimate`.
[[nodiscard]] Scene with_mesh_truth(std::span<const PosedMesh> meshes, const Scene& scene,
                                    const Progress& progress,
                                    const capture::DepthOptions& options = {});

/// Photographs of a gantry and where the light field made of them goes.
struct RectifyTask {
  Scene photographs;
  CaptureWork work;              ///< With lens and settings; pairs in the center photograph.
  std::filesystem::path output;  ///< Light field to write.
};

struct RectifiedFile {
  capture::Rectified rectified;
  /// Work on the new light field: pairs in its center view, how well rows are aligned, no poses.
  CaptureWork work;
};

/// Rectifies photographs and writes the light field. Precondition: there is a lens. Throws what
/// capture::rectify and io::write_archive do.
[[nodiscard]] RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress);

/// One step of the user: the work before and after it.
struct CaptureEdit {
  CaptureWork before;
  CaptureWork after;
  [[nodiscard]] std::size_t byte_size() const;
};

/// The work of a user on one light field: lens, settings, objects with their meshes and pairs.
/// Every change is undoable; a change to the same is no step. Pairs and meshes belong to the
/// current object, which is made if there is none.
class CaptureDocument {
 public:
  /// Starts from work that was kept, with nothing to undo.
  explicit CaptureDocument(CaptureWork work = {});

  [[nodiscard]] const CaptureWork& work() const { return work_; }
  /// Pairs of the current object; empty if there is no object.
  [[nodiscard]] const std::vector<capture::PointPair>& pairs() const;
  [[nodiscard]] const History<CaptureEdit>& history() const { return history_; }

  void set_lens(CaptureLens lens, const capture::Pattern& pattern);
  void set_rectify(const capture::RectifyOptions& options);

  /// Adds an object with this mesh, named after its file, and chooses it.
  void add_object(const std::string& mesh);
  void remove_object();
  /// Ignored if the name is empty or taken.
  void rename_object(const std::string& name);
  /// Not a step. Ignored for a number without an object.
  void choose(int object);
  void set_mesh(const std::string& file);

  /// Names that are empty or taken get a number.
  void add_pairs(std::vector<capture::PointPair> pairs);
  /// `places`: ascending. Locked pairs stay.
  void remove_pairs(const std::vector<int>& places);
  void lock_pair(int place, bool is_locked);
  /// Ignored if the name is empty, taken, or holds what a CSV file cannot.
  void rename_pair(int place, const std::string& name);

  /// Computes the poses anew (solve_poses); not a step.
  std::string solve(const CameraGrid& camera) { return solve_poses(work_, camera); }

  /// Ignored if there is nothing to undo or redo.
  void undo();
  void redo();

 private:
  void edit(const std::function<void(CaptureWork&)>& change);
  void edit_object(const std::function<void(CaptureObject&)>& change);

  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
  CaptureWork work_;
  History<CaptureEdit> history_{kMaxBytes};
};

}  // namespace episcope
