// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/movie/movie_file.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/atomic_folder.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/movie/movie_encoder.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

constexpr double kSlowest = 0.1, kFastest = 120;

void check(const std::filesystem::path& path, const MovieShape& shape) {
  if (!is_movie_path(path)) {
    throw InvalidInput(path.string() +
                       " names no movie; use .mp4, .webm or .gif, or a folder for PNG images");
  }
  if (shape.height < 1 || shape.width < 1) {
    throw InvalidInput(
        fmt::format("a movie of {}×{} px cannot be written", shape.width, shape.height));
  }
  if (!(shape.rate >= kSlowest && shape.rate <= kFastest)) {
    throw InvalidInput(fmt::format("a movie has {} to {} pictures per second, not {}", kSlowest,
                                   kFastest, shape.rate));
  }
}

// Over white.
void make_opaque(ImageView<const std::uint8_t> picture, Image<std::uint8_t>& out) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int opacity = picture.at(y, x, 3);
      for (int c = 0; c < 3; ++c) {
        const int mixed = picture.at(y, x, c) * opacity + 255 * (255 - opacity);
        out.at(y, x, c) = static_cast<std::uint8_t>((mixed + 127) / 255);
      }
      out.at(y, x, 3) = 255;
    }
  }
}

}  // namespace

/// Where pictures go.
class MovieFile::Sink {
 public:
  virtual ~Sink() = default;
  virtual void add(ImageView<const std::uint8_t> picture) = 0;
  virtual void commit() = 0;
};

class MovieFile::Encoded : public Sink {
 public:
  Encoded(const std::filesystem::path& path, const MovieShape& shape)
      : file_(path), encoder_(file_.temporary(), path, shape) {}
  void add(ImageView<const std::uint8_t> picture) override { encoder_.add(picture); }
  void commit() override {
    encoder_.finish();
    file_.commit();
  }

 private:
  AtomicFile file_;
  MovieEncoder encoder_;
};

class MovieFile::Numbered : public Sink {
 public:
  explicit Numbered(const std::filesystem::path& path) : folder_(path) {}
  void add(ImageView<const std::uint8_t> picture) override {
    write_png(folder_.temporary() / fmt::format("frame_{:04}.png", number_++), picture);
  }
  void commit() override { folder_.commit(); }

 private:
  AtomicFolder folder_;
  int number_ = 0;
};

bool is_movie_path(const std::filesystem::path& path) {
  return suffix_of(path).empty() || is_encoded_form(path);
}

std::unique_ptr<MovieFile::Sink> MovieFile::sink_for(const std::filesystem::path& path,
                                                     const MovieShape& shape) {
  check(path, shape);
  if (suffix_of(path).empty()) return std::make_unique<Numbered>(path);
  return std::make_unique<Encoded>(path, shape);
}

MovieFile::MovieFile(const std::filesystem::path& path, const MovieShape& shape)
    : shape_(shape), opaque_(shape.height, shape.width, 4), sink_(sink_for(path, shape)) {}

MovieFile::~MovieFile() = default;

void MovieFile::add(ImageView<const std::uint8_t> picture) {
  if (picture.height != shape_.height || picture.width != shape_.width || picture.channels != 4) {
    throw InvalidInput(fmt::format("a picture of {}×{} px does not belong to a movie of {}×{} px",
                                   picture.width, picture.height, shape_.width, shape_.height));
  }
  make_opaque(picture, opaque_);
  sink_->add(opaque_.view());
  ++count_;
}

void MovieFile::commit() {
  if (count_ == 0) throw InvalidInput("a movie needs at least one picture");
  sink_->commit();
}

}  // namespace episcope::io
