// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <thread>

namespace episcope::io {

/// Flushes an open file to the disk soon after each write, on a thread of its own, so that the
/// writer never waits for a disk. The file must outlive it.
class BackgroundFlush {
 public:
  /// Whether what is in the file by now, and its name, are on the disk.
  enum class Start { Flushed, Unflushed };

  BackgroundFlush(int descriptor, std::filesystem::path path, Start start);
  /// Flushes.
  ~BackgroundFlush();
  BackgroundFlush(const BackgroundFlush&) = delete;
  BackgroundFlush& operator=(const BackgroundFlush&) = delete;

  /// Something was written.
  void request();
  /// Waits until all that was written is on the disk, or a flush failed.
  void wait();
  /// `errno` of a flush that failed; 0 = none did.
  [[nodiscard]] int error() const;

 private:
  void run(const std::stop_token& stop);

  const int descriptor_;
  const std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t written_ = 0;  ///< Counts requests,
  std::uint64_t flushed_ = 0;  ///< and those fulfilled.
  bool is_named_;              ///< Whether the name is on the disk.
  int error_ = 0;
  std::jthread thread_;
};

}  // namespace episcope::io
