// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::io {

/// While one lives, what its thread writes to std::cerr is dropped: OpenCV tells there, besides
/// throwing or returning no picture, why it could not decode one. Other threads are heard.
class QuietDecoding {
 public:
  QuietDecoding();
  ~QuietDecoding();
  QuietDecoding(const QuietDecoding&) = delete;
  QuietDecoding& operator=(const QuietDecoding&) = delete;
};

}  // namespace episcope::io
