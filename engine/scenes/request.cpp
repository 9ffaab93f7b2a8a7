// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/request.h"

#include "engine/core/error.h"
#include "engine/core/parameter/parameter.h"
#include "engine/core/text/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace episcope::scenes {
namespace {

constexpr const char* kKeys =
    "seed=N, kind=NAME, size=256 or 320x240, grid=9x9, noise=SIGMA, channels=3 or 1";

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw InvalidInput(fmt::format("cannot read the built-in scene '{}': {}", text, reason));
}

// A whole text as a number that is not negative.
template <class T>
bool read_number(std::string_view text, T& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && number >= 0;
}

// "256x192"; one number alone stands for both.
bool read_pair(std::string_view text, int& first, int& second) {
  const auto cross = text.find('x');
  if (cross == text.npos) {
    if (!read_number(text, first)) return false;
    second = first;
    return true;
  }
  return read_number(text.substr(0, cross), first) && read_number(text.substr(cross + 1), second);
}

bool read_value(const std::string& key, const std::string& value, RenderOptions& options) {
  if (key == "seed") return read_number(value, options.seed);
  if (key == "noise") return read_number(value, options.noise_sigma);
  if (key == "channels") return read_number(value, options.channels);
  if (key == "size") return read_pair(value, options.width, options.height);
  return read_pair(value, options.grid.v, options.grid.u);
}

void read_kind(const std::string& text, const BuiltinRequest& request, const std::string& value,
               RenderOptions& options) {
  if (request.scene != kRandomScene) {
    refuse(text, fmt::format("only the scene '{}' has a kind", kRandomScene));
  }
  const auto kind = random_kind_of(value);
  if (!kind) {
    const std::vector<std::string>& names = random_kind_names();
    refuse(text, no_such_name("kind", value, names) + " (there are " + joined(names, ", ") + ")");
  }
  options.kind = *kind;
}

void read_option(const std::string& text, const std::string& option, BuiltinRequest& request) {
  const auto equals = option.find('=');
  const std::string key = option.substr(0, equals);
  const std::string value = equals == option.npos ? std::string() : option.substr(equals + 1);
  if (key == "kind") return read_kind(text, request, value, request.options);
  const std::vector<std::string> keys = {"seed", "size", "grid", "noise", "channels"};
  if (std::ranges::find(keys, key) == keys.end()) {
    refuse(text,
           fmt::format("'{}' is not known; after '?' there may be, joined by '&': {}", key, kKeys));
  }
  if (!read_value(key, value, request.options)) {
    refuse(text, fmt::format("'{}' is no {}; write {}", value, key, kKeys));
  }
}

}  // namespace

void read_options(const std::string& text, BuiltinRequest& request) {
  const auto question = text.find('?');
  if (question == text.npos) return;
  std::string rest = text.substr(question + 1);
  while (true) {
    const auto end = rest.find('&');
    read_option(text, rest.substr(0, end), request);
    if (end == rest.npos) return;
    rest.erase(0, end + 1);
  }
}

BuiltinRequest read_request(const std::string& text) {
  BuiltinRequest request;
  request.scene = text.substr(0, text.find('?'));
  require_builtin(request.scene);
  read_options(text, request);
  return request;
}

}  // namespace episcope::scenes
