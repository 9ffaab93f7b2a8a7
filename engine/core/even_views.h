// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace episcope {

/// A reading option: differences of brightness between views are left to the method.
inline constexpr const char* kKeepBrightness = "no-equalize";

/// A light field whose views have equal brightness, and how much they differed.
struct EvenLightField {
  LightField light_field;
  std::string note;  ///< For an estimate.
};

/// Equalizes the views of a light field on first use and keeps the result. Most methods compare
/// views or follow lines through them, and take a gain for structure. Thread-safe.
class EvenViews {
 public:
  /// A copy of the light field without the gains of its views (measure_view_gains). Null if no
  /// gain is notable, or if it was read with kKeepBrightness. Other callers wait; if it throws,
  /// nothing is kept. Measuring reads light fields on disk as a whole; the copy goes to disk if it
  /// does not fit into memory. Another light field replaces what is kept. Throws Cancelled, IoError
  /// if there is no room on the disk.
  [[nodiscard]] std::shared_ptr<const EvenLightField> of(const LightField& light_field,
                                                         const Progress& progress);
  /// Bytes of memory of the copy that is kept.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::mutex lock_;
  std::uint64_t measured_ = 0;  // LightField::identity; 0 = none
  std::shared_ptr<const EvenLightField> even_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace episcope
