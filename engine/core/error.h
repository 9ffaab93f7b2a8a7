// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace episcope {

/// Base class of every failure reported to the user. The message is a sentence with the numbers in
/// it: what failed, with which values, what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A documented precondition is violated: a shape, a range, a name, a parameter.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// Reading or writing failed. The message begins with the path.
class IoError : public Error {
 public:
  IoError(const std::filesystem::path& path, const std::string& reason)
      : Error(path.string() + ": " + reason), path_(path) {}

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The message without the path.
  [[nodiscard]] std::string sentence() const;

 private:
  std::filesystem::path path_;
};

/// Something that this build or machine does not provide: CUDA, a method, a format.
class Unavailable : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop. Not an `Error`, so that no handler of errors swallows it.
class Cancelled {};

/// What users read wherever memory runs out.
inline constexpr const char* kNotEnoughMemory =
    "not enough memory; close other programs or use smaller data";
/// What users read of an exception that is no std::exception.
inline constexpr const char* kUnknownFailure = "an unknown error occurred";

/// A failure in words for the user: `kNotEnoughMemory` for std::bad_alloc, else the message of the
/// exception, else `kUnknownFailure`.
[[nodiscard]] std::string failure_text(const std::exception_ptr& failure);

}  // namespace episcope
