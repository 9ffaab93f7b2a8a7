// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/core/light_field/scene.h"

#include <string>
#include <string_view>

namespace episcope {

/// Takes in bytes, values and images; `text` is 16 hexadecimal digits that change with them.
class Fingerprint {
 public:
  void add(std::string_view bytes) { hash_.add(bytes); }
  template <class T>
  void add_value(const T& value) {
    add({reinterpret_cast<const char*>(&value), sizeof value});
  }
  template <class T>
  void add_image(ImageView<const T> image) {
    add_value(image.height);
    add_value(image.width);
    for (int y = 0; y < image.height; ++y) {
      const std::size_t count = static_cast<std::size_t>(image.width) * image.channels;
      add({reinterpret_cast<const char*>(image.row(y)), count * sizeof(T)});
    }
  }
  [[nodiscard]] std::string text() const { return hash_digits(hash_.value()); }

 private:
  Fnv1a hash_;
};

/// 16 hexadecimal digits that change with anything of a scene that a judged run depends on: the
/// samples, camera and promised range of the light field, truth and region masks of its centre
/// view. Linear in the samples.
[[nodiscard]] std::string scene_fingerprint(const Scene& scene);

/// 16 hexadecimal digits of a text (FNV-1a).
[[nodiscard]] std::string text_fingerprint(const std::string& text);

}  // namespace episcope
