// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/history.h"
#include "app/session/capture_work.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace episcope {

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
  /// Removes the current object.
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
