// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/quiet_decoding.h"

#include <opencv2/core/utils/logger.hpp>

#include <iostream>
#include <streambuf>

namespace episcope::io {
namespace {

thread_local int quiet_depth = 0;

/// Passes on what threads write that are not quiet.
class HearingBuffer : public std::streambuf {
 public:
  explicit HearingBuffer(std::streambuf* to) : to_(to) {}

 protected:
  int_type overflow(int_type c) override {
    if (quiet_depth > 0 || traits_type::eq_int_type(c, traits_type::eof())) {
      return traits_type::not_eof(c);
    }
    return to_->sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    return quiet_depth > 0 ? count : to_->sputn(text, count);
  }
  int sync() override { return to_->pubsync(); }

 private:
  std::streambuf* to_;
};

/// Before `main`, while no other thread writes; never destroyed, since std::cerr outlives all.
[[maybe_unused]] const std::streambuf* const kBefore =
    std::cerr.rdbuf(new HearingBuffer(std::cerr.rdbuf()));

}  // namespace

QuietDecoding::QuietDecoding() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  ++quiet_depth;
}

QuietDecoding::~QuietDecoding() {
  --quiet_depth;
}

}  // namespace episcope::io
