// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// The coarse parts of a session that change together.
enum class Part : unsigned {
  Scene = 1,         ///< Light field, truth, labels, convention.
  Estimates = 2,     ///< The list of estimates.
  Shown = 4,         ///< Which estimate is shown.
  Evaluations = 8,   ///< An evaluation that was asked for is there.
  View = 16,         ///< The current view.
  CrossHair = 32,    ///< The current pixel.
  Focus = 64,        ///< The focus plane.
  TrueLabels = 128,  ///< The labels that segmentations are compared with.
  Scenes = 256,      ///< The list of open scenes, or what is in memory of those set aside.
  Display = 512,     ///< What is drawn over the view, and its colour ranges.
  Tone = 1024,       ///< How views are brightened.
  Labels = 2048,     ///< The segmentation that is kept.
  LabelLook = 4096,  ///< Which labels are hidden or locked, and how labels are drawn.
  Measured = 8192,   ///< The disparities measured by hand that are kept.
  Capture = 16384,   ///< The mesh and the pairs picked on it.
  Live = 32768,      ///< The estimate that is made while parameters are tried.
  Judged = 65536,    ///< The part of the view that metrics are of.
};

/// A set of parts.
class Parts {
 public:
  Parts() = default;
  Parts(Part part) : bits_(static_cast<unsigned>(part)) {}

  [[nodiscard]] bool empty() const { return bits_ == 0; }
  [[nodiscard]] bool has(Part part) const { return (bits_ & static_cast<unsigned>(part)) != 0; }
  [[nodiscard]] bool has_any(Parts parts) const { return (bits_ & parts.bits_) != 0; }
  Parts& operator|=(Parts other) {
    bits_ |= other.bits_;
    return *this;
  }
  friend Parts operator|(Parts a, Parts b) { return a |= b; }
  friend bool operator==(const Parts&, const Parts&) = default;

 private:
  unsigned bits_ = 0;
};

inline Parts operator|(Part a, Part b) {
  return Parts(a) | Parts(b);
}

}  // namespace episcope
