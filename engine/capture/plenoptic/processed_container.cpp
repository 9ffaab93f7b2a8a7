// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/processed_container.h"

#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/quiet_decoding.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace episcope::capture {
namespace {

namespace fs = std::filesystem;
using Table = nlohmann::json;

constexpr int kDeepest = 32;  // levels of a table; cameras use 7

bool is_jpeg(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 3 && bytes[0] == 0xFF && bytes[1] == 0xD8;
}

bool is_png(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 8 && std::memcmp(bytes.data(), "\x89PNG", 4) == 0;
}

/// Whether a map can be written by this name.
bool is_file_name(const std::string& name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c); });
}

std::optional<double> number_of(const Table& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return {};
  return found->get<double>();
}

/// Finds all that a table refers to, wherever it stands: generations of cameras nest it otherwise.
class TableWalk {
 public:
  TableWalk(const LfpContainer& container, ProcessedContainer& found)
      : container_(container), found_(found) {}

  /// `name` and `owner` of the member that `json` is.
  void visit(const Table& json, const std::string& name, const Table& owner, int depth = 0) {
    if (depth > kDeepest || !json.is_structured()) return;
    if (json.is_object()) take(json, name, owner);
    for (const auto& [key, value] : json.items()) {
      visit(value, json.is_object() ? key : name, json.is_object() ? json : owner, depth + 1);
    }
  }

 private:
  void take(const Table& object, const std::string& name, const Table& owner) {
    if (const auto lambda = number_of(object, "defaultLambda")) found_.shown_lambda = lambda;
    const auto reference = object.find("imageRef");
    if (reference == object.end() || !reference->is_string()) return;
    const LfpSection* section = container_.find(reference->get<std::string>());
    if (!section) return;
    if (is_jpeg(section->data) || is_png(section->data)) {
      found_.pictures.push_back({number_of(object, "lambda"), section->data});
      return;
    }
    const bool is_new = std::ranges::none_of(
        found_.maps, [&](const ProcessedMap& map) { return map.name == name; });
    if (!is_new || !is_file_name(name)) return;
    const Table& sized = object.contains("width") ? object : owner;
    const double width = number_of(sized, "width").value_or(0);
    const double height = number_of(sized, "height").value_or(0);
    const auto bytes = static_cast<double>(section->data.size());
    if (width < 1 || height < 1 || width * height * sizeof(float) != bytes) return;
    Image<float> values(static_cast<int>(height), static_cast<int>(width));
    std::memcpy(values.data(), section->data.data(), section->data.size());
    found_.maps.push_back({name, std::move(values)});
  }

  const LfpContainer& container_;
  ProcessedContainer& found_;
};

std::pair<float, float> range_of(const Image<float>& values) {
  float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return least <= most ? std::pair(least, most) : std::pair(0.0F, 0.0F);
}

const ProcessedPicture* shown_picture(const ProcessedContainer& container) {
  if (container.pictures.empty()) return nullptr;
  const double wanted = container.shown_lambda.value_or(0);
  return &*std::ranges::min_element(container.pictures, {}, [&](const ProcessedPicture& picture) {
    return picture.lambda ? std::abs(*picture.lambda - wanted) : std::numeric_limits<double>::max();
  });
}

LightField::Samples decoded_picture(const fs::path& path,
                                    const std::vector<std::uint8_t>& encoded) {
  const io::QuietDecoding quiet;
  cv::Mat bgr;
  try {
    bgr = cv::imdecode(encoded, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    bgr.release();
  }
  if (bgr.empty()) throw IoError(path, "a picture in this container is damaged; copy it again");
  ViewStack<std::uint8_t> samples({1, 1}, bgr.rows, bgr.cols, 3);
  std::uint8_t* out = samples.data();
  for (int y = 0; y < bgr.rows; ++y) {
    const std::uint8_t* row = bgr.ptr(y);
    for (int x = 0; x < bgr.cols; ++x, row += 3, out += 3) std::reverse_copy(row, row + 3, out);
  }
  return samples;
}

LightField::Samples as_gray(const Image<float>& values) {
  const auto [least, most] = range_of(values);
  const float range = most > least ? most - least : 1;
  ViewStack<float> samples({1, 1}, values.height(), values.width(), 1);
  std::ranges::transform(values, samples.data(), [least = least, range](float value) {
    return std::isfinite(value) ? (value - least) / range : 0;
  });
  return samples;
}

}  // namespace

std::string ProcessedContainer::text() const {
  std::string text;
  if (!pictures.empty()) {
    text = pictures.size() == 1 ? "a picture" : fmt::format("{} pictures", pictures.size());
    const auto first = pictures.front().lambda;
    const auto last = std::ranges::find_if(pictures.rbegin(), pictures.rend(),
                                           [](const auto& each) { return bool(each.lambda); });
    if (first) text += fmt::format(" in focus at λ {:g} … {:g}", *first, *last->lambda);
  }
  for (const ProcessedMap& map : maps) {
    const auto [least, most] = range_of(map.values);
    text += fmt::format("{}{} of {}×{} px from {:.3g} to {:.3g}", text.empty() ? "" : ", ",
                        map.name, map.values.width(), map.values.height(), least, most);
  }
  return text;
}

std::optional<ProcessedContainer> read_processed(const fs::path& path) {
  const LfpContainer container = read_lfp(path);
  ProcessedContainer found{path, {}, {}, {}};
  try {
    if (holds_raw(container)) return {};
    const auto table = std::ranges::find(container.sections, true, &LfpSection::is_table);
    const auto json = io::parse_json<Table>(table->text());
    TableWalk(container, found).visit(json, {}, json);
  } catch (const Table::exception&) {
    throw IoError(path, "the table of this container is no JSON");
  } catch (const InvalidInput& error) {
    throw IoError(path, error.what());
  }
  if (found.pictures.empty() && found.maps.empty()) {
    throw IoError(path,
                  "this container holds neither a raw picture nor processed ones; choose the raw "
                  "one, as the camera wrote it");
  }
  std::partition(found.maps.begin(), found.maps.end(),
                 [](const auto& map) { return map.name == "depthMap"; });
  std::ranges::stable_sort(found.pictures, {}, [](const ProcessedPicture& picture) {
    return picture.lambda.value_or(std::numeric_limits<double>::max());
  });
  return found;
}

Scene scene_of(const ProcessedContainer& container) {
  const ProcessedPicture* picture = shown_picture(container);
  LightFieldInfo info;
  info.name = container.path.stem().string();
  info.source = container.path.string();
  Scene scene;
  scene.light_field =
      std::make_shared<const LightField>(picture ? decoded_picture(container.path, picture->encoded)
                                                 : as_gray(container.maps.front().values),
                                         std::move(info));
  scene.truth = std::make_shared<const GroundTruth>();
  scene.convention.format = "processed container of a Lytro camera";
  scene.convention.order = "canonical order";
  scene.convention.order_check = finding_text("order.single_view");
  scene.convention.warnings.push_back(
      fmt::format(finding_text("plenoptic.processed"), container.text()));
  return scene;
}

std::vector<std::string> write_processed(const fs::path& folder,
                                         const ProcessedContainer& container,
                                         const Progress& progress) {
  io::AtomicFolder target(folder);
  std::vector<std::string> files;
  const auto place = [&](const std::string& name) {
    files.push_back((folder / name).string());
    return target.temporary() / name;
  };
  for (std::size_t k = 0; k < container.pictures.size(); ++k) {
    progress.check();
    const auto& [lambda, encoded] = container.pictures[k];
    const std::string focus = lambda ? fmt::format("_lambda_{:g}", *lambda) : std::string();
    io::write_atomically(
        place(fmt::format("picture_{:02}{}{}", k, focus, is_png(encoded) ? ".png" : ".jpg")),
        encoded);
  }
  for (const ProcessedMap& map : container.maps) {
    io::write_pfm(place(map.name + ".pfm"), map.values.view());
  }
  target.commit();
  return files;
}

}  // namespace episcope::capture
