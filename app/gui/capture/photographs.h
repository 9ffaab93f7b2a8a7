// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/capture_work.h"
#include "app/session/load_scene.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/parameter.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/cloud/cloud_look.h"
#include "widgets/panels/capture_panel.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace episcope {

class CaptureDocuments;

/// Calibrates a camera from photographs of a pattern, and rectifies open photographs into a light
/// field with aligned rows and columns.
class Photographs : public QObject {
  Q_OBJECT

 public:
  Photographs(const Workbench& bench, CaptureDocuments& documents, QObject* parent);

  /// Shows its state in these steps and obeys them.
  void attach(PhotographSteps* steps);

  void calibrate(const QStringList& photographs, const capture::Pattern& pattern);
  /// Loads mesh, picks and step of the demo's gantry, and calibrates.
  void beginGantry(const GantryFolder& demo);
  void openCamera(const QString& path);
  void saveCamera(const QString& path);
  /// Writes the rectified light field and opens it; the work continues there.
  void rectify(const QString& path);
  /// Writes photographs of a gantry and a pattern, and a mesh, into a new folder in `folder`;
  /// calibrates, and opens the photographs.
  void makeDemo(const QString& folder, const capture::DemoOptions& options = {});

 private:
  void askForPattern();
  void askForRectified();
  void take(const capture::Calibration& calibration, const capture::Pattern& pattern,
            std::uint64_t scene);
  void show();
  [[nodiscard]] bool canRectify() const;

  Workbench bench_;
  CaptureDocuments& documents_;
  PhotographSteps* steps_ = nullptr;
};

/// Values that are asked for in a dialog that blocks nothing.
struct FormQuestion {
  QString name;  ///< Of the dialog, as an object.
  QString title;
  QString accept;  ///< Text of the button that goes on.
  std::vector<ParameterDescription> parameters;
  ParameterSet values{};  ///< To begin with, in place of defaults.
};

/// Calls `answer` with all values if the user confirms.
void ask_for_values(QWidget* window, const FormQuestion& question,
                    std::function<void(const ParameterSet&)> answer);

class Messages;

/// Documents of the Capture tab, one for each open light field, kept with it in the session. A new
/// light field inherits the lens of the previous one; work prepared before any was open goes to the
/// first.
class CaptureDocuments : public QObject {
  Q_OBJECT

 public:
  CaptureDocuments(const Workbench& bench, QObject* parent);

  /// Document of the shown light field, with poses.
  [[nodiscard]] const CaptureDocument& now() const { return documents_.at(scene_); }
  /// Why the current object has no pose although it has enough pairs; empty if it has.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Meshes of all open light fields.
  [[nodiscard]] std::set<std::string> meshes() const;

  void change(const std::function<void(CaptureDocument&)>& change);
  /// Changes the document of the light field that was shown when `Session::generation` was `scene`.
  /// Work begun without a light field goes to the one opened next. Returns false, and does nothing,
  /// if it was closed.
  [[nodiscard]] bool changeOf(std::uint64_t scene,
                              const std::function<void(CaptureDocument&)>& change);
  /// Sets the initial work of the shown light field, which cannot be undone.
  void begin(CaptureWork work);
  /// Follows newly opened light fields at once, instead of when the session announces them.
  void follow();

 signals:
  /// The shown document changed, or another document is shown.
  void changed();

 private:
  /// Links work begun without a light field to the light field opened next.
  struct Heir {
    std::uint64_t none = 0;
    std::uint64_t next = 0;
  };

  [[nodiscard]] CaptureWork firstWork() const;
  void settle();

  Workbench bench_;
  std::map<std::uint64_t, CaptureDocument> documents_;  // by OpenScene::id
  std::uint64_t scene_ = 0;
  bool shows_none_ = true;
  Heir heir_;
  QString problem_;
};

/// Whether a new light field can be written to the path: its name ends in .h5 and no file exists.
/// Tells the user if not.
[[nodiscard]] bool is_new_light_field(const QString& path, Messages& messages);

/// Mesh for the 3D view, coarser while it moves. Linear.
[[nodiscard]] CloudPartsPtr mesh_parts(const capture::TriangleMesh& mesh);

/// Mesh point in the coordinates of the 3D view.
[[nodiscard]] std::array<double, 3> in_mesh_view(const capture::Point3& point);

[[nodiscard]] std::vector<CaptureRow> pair_rows(const std::vector<capture::PointPair>& pairs,
                                                const std::optional<capture::SolvedPose>& pose);

/// Pairs as marks in view and mesh.
struct PairMarks {
  std::vector<CanvasMark> on_view;  ///< With where the pose puts each, if there is one.
  std::vector<CloudMark> on_mesh;
};

/// Emphasizes the pair at place `is_emphasised`; `pose` may be null.
[[nodiscard]] PairMarks pair_marks(const std::vector<capture::PointPair>& pairs,
                                   const capture::RigidPose* pose,
                                   const std::optional<Pinhole>& pinhole,
                                   const std::function<bool(int)>& is_emphasised);

}  // namespace episcope
