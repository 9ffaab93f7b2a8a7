// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/benchmark_truth.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

/// `gt_disp_highres.pfm` and `mask_<name>_highres.png` of a scene folder of the 2016 benchmark,
/// which are looked up now and read when they are asked for.
struct HighResFiles {
  std::filesystem::path disparity;
  std::vector<std::filesystem::path> masks;  ///< Sorted.
};

namespace fs = std::filesystem;

constexpr const char* kDisparity = "gt_disp_highres.pfm";
constexpr const char* kHighResMaskSuffix = "_highres.png";
/// Largest size of a map of one scene; maps of the benchmark take 100 MiB.
constexpr std::uintmax_t kGrantedMiB = 512;

template <class T>
void require_size(const fs::path& path, const Image<T>& map, int height, int width) {
  if (map.height() == height && map.width() == width) return;
  throw IoError(path, fmt::format("this map has {}×{} px, but {} times the size of the views is "
                                  "{}×{} px; replace or remove it",
                                  map.width(), map.height(), kHighResScale, width, height));
}

class TruthInFiles : public HighResTruth {
 public:
  TruthInFiles(const HighResFiles& files, int height, int width)
      : disparity_(files.disparity),
        height_(height * kHighResScale),
        width_(width * kHighResScale) {
    for (const fs::path& path : files.masks)
      masks_.emplace(region_of(path, kHighResMaskSuffix), path);
  }

  [[nodiscard]] Image<float> read_disparity() const override {
    require_memory();
    Image<float> map = read_pfm_map(disparity_);
    require_size(disparity_, map, height_, width_);
    return map;
  }

  [[nodiscard]] std::vector<std::string> regions() const override {
    std::vector<std::string> names;
    for (const auto& [name, path] : masks_) names.push_back(name);
    return names;
  }

  [[nodiscard]] Image<std::uint8_t> read_region(const std::string& name) const override {
    require_memory();
    const fs::path& path = masks_.at(name);
    AnyImage decoded = decode_image(path);
    auto* mask = std::get_if<Image<std::uint8_t>>(&decoded);
    if (!mask) {
      throw IoError(path, "this mask has " + describe_image(decoded) +
                              ", but 8 bit are expected; replace or remove it");
    }
    require_size(path, *mask, height_, width_);
    return first_channel(std::move(*mask));
  }

  [[nodiscard]] std::string identity() const override {
    std::string text = identity_of(disparity_);
    for (const auto& [name, path] : masks_) text += identity_of(path);
    return text;
  }

 private:
  void require_memory() const {
    const std::uintmax_t bytes = std::uintmax_t{sizeof(float)} * height_ * width_;
    constexpr std::uintmax_t mib = 1 << 20;
    if (bytes <= kGrantedMiB * mib) return;
    throw IoError(disparity_, fmt::format("{}×{} px take {} MiB, more than the {} that are granted "
                                          "to the high resolution; use a smaller light field",
                                          width_, height_, bytes / mib, kGrantedMiB));
  }

  [[nodiscard]] static Image<std::uint8_t> first_channel(Image<std::uint8_t> mask) {
    if (mask.channels() == 1) return mask;
    Image<std::uint8_t> first(mask.height(), mask.width());
    for (std::size_t i = 0; i < first.size(); ++i) {
      first.data()[i] = mask.data()[i * static_cast<std::size_t>(mask.channels())];
    }
    return first;
  }

  [[nodiscard]] static std::string identity_of(const fs::path& path) {
    std::error_code ignored;
    const auto written = fs::last_write_time(path, ignored).time_since_epoch().count();
    return fmt::format("{} {} {}\n", path.filename().string(), fs::file_size(path, ignored),
                       written);
  }

  fs::path disparity_;
  std::map<std::string, fs::path> masks_;  ///< By the name of the region.
  int height_;
  int width_;
};

/// `disparity` is empty if it is not there. Throws filesystem_error.
HighResFiles find_high_res_files(const fs::path& folder) {
  HighResFiles files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.filename() == kDisparity) files.disparity = path;
    if (!region_of(path, kHighResMaskSuffix).empty()) files.masks.push_back(path);
  }
  std::sort(files.masks.begin(), files.masks.end());
  return files;
}

/// Truth of views of this size; null without a disparity map.
HighResTruthPtr high_res_truth(const HighResFiles& files, int height, int width) {
  if (files.disparity.empty()) return nullptr;
  return std::make_shared<const TruthInFiles>(files, height, width);
}

/// Files of one kind, each read or left out.
class Files {
 public:
  /// Keeps the error where `act` throws IoError.
  void read(const fs::path& file, const std::function<void()>& act) {
    try {
      act();
      outcome_.read.push_back(file);
    } catch (const IoError& error) {
      outcome_.failed.push_back(file);
      if (outcome_.first_error.empty()) outcome_.first_error = error.what();
    }
  }
  [[nodiscard]] bool has_read_any() const { return !outcome_.read.empty(); }
  void tell(const std::string& kind, const SidecarNotes& notes) const {
    outcome_.tell(kind, notes);
  }
  /// Of maps that are the ground truth.
  void tell_truth(const std::string& kind, const SidecarNotes& notes) const {
    notes.report.truth_files = outcome_.read;
    tell(kind, notes);
  }

 private:
  SetOutcome outcome_;
};

/// Copies a map into a view of the field; values that are not finite become invalid.
void store(const Image<float>& map, ViewIndex view, DisparityField& field) {
  const auto disparity = field.disparity.view(view);
  const auto valid = field.valid.view(view);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const float d = map.at(y, x);
      valid.at(y, x) = std::isfinite(d) ? 1 : 0;
      disparity.at(y, x) = std::isfinite(d) ? d : 0;
    }
  }
}

Image<float> read_map(const fs::path& path, const SidecarViews& views) {
  Image<float> map = read_pfm_map(path);
  require_view_size(path, map.height(), map.width(), views);
  return map;
}

/// Depth of the benchmark is in meters or in millimeters, told apart by the focus distance.
void depth_to_disparity(const CameraGrid& camera, Image<float>& map) {
  double nearest_difference[2] = {0, 0};
  for (const float depth : map) {
    if (!std::isfinite(depth) || depth <= 0) continue;
    nearest_difference[0] += std::abs(std::log(depth / *camera.cam_distance));
    nearest_difference[1] += std::abs(std::log(1000 * depth / *camera.cam_distance));
  }
  const double unit_mm = nearest_difference[1] < nearest_difference[0] ? 1000 : 1;
  for (float& value : map) {
    value = static_cast<float>(camera.disparity_from_depth(unit_mm * value));
  }
}

/// Files are numbered as in the whole grid.
std::string disparity_file_of(ViewIndex view, const ViewFiles& views) {
  const ViewIndex at = views.in_whole(view);
  return disparity_file_name(at.v * views.whole_grid().u + at.u);
}

/// Of every view, or of the center view alone where that is all that is asked for.
DisparityField read_of_all_views(const fs::path& folder, const SidecarViews& views,
                                 const SidecarNotes& notes, const Progress& progress) {
  const GridShape grid = views.grid();
  const bool all = views.map_views == MapViews::All;
  const GridShape part = all ? grid : GridShape{1, 1};
  const ViewIndex first = all ? ViewIndex{} : grid.center();
  DisparityField field = DisparityField::unknown(part, views.height(), views.width(), first);
  Files files;
  for (int i = 0; i < part.count(); ++i) {
    progress.check();
    const ViewIndex view = part.view_at(i, first);
    const fs::path file = folder / disparity_file_of(view, views.files);
    files.read(file, [&] { store(read_map(file, views), view, field); });
    progress.report((i + 1.0) / part.count());
  }
  files.tell_truth("disparity maps", notes);
  return files.has_read_any() ? std::move(field) : DisparityField();
}

/// Of the center view; `convert` makes disparity of what is stored.
DisparityField read_of_center(const fs::path& file, const std::string& kind,
                              const SidecarViews& views, const SidecarNotes& notes,
                              const std::function<void(Image<float>&)>& convert) {
  const ViewIndex center = *views.files.whole_center();
  DisparityField field = DisparityField::unknown({1, 1}, views.height(), views.width(), center);
  Files files;
  files.read(file, [&] {
    Image<float> map = read_map(file, views);
    convert(map);
    store(map, center, field);
  });
  files.tell_truth(kind, notes);
  return files.has_read_any() ? std::move(field) : DisparityField();
}

/// Of the map in high resolution the value in the middle of each pixel of the center view.
DisparityField read_reduced(const HighResFiles& high_res, const SidecarViews& views,
                            const SidecarNotes& notes) {
  const ViewIndex center = *views.files.whole_center();
  DisparityField field = DisparityField::unknown({1, 1}, views.height(), views.width(), center);
  Files files;
  files.read(high_res.disparity, [&] {
    const Image<float> map =
        high_res_truth(high_res, views.height(), views.width())->read_disparity();
    Image<float> reduced(views.height(), views.width());
    for (int y = 0; y < reduced.height(); ++y) {
      for (int x = 0; x < reduced.width(); ++x) {
        reduced.at(y, x) =
            map.at(kHighResScale * y + kHighResScale / 2, kHighResScale * x + kHighResScale / 2);
      }
    }
    store(reduced, center, field);
  });
  files.tell_truth("disparity maps in high resolution", notes);
  return files.has_read_any() ? std::move(field) : DisparityField();
}

/// Truth of the center of the whole grid, which must be one of the views.
DisparityField read_stored_center(const fs::path& folder, const SidecarViews& views,
                                  const SidecarNotes& notes) {
  const fs::path disparity = folder / kCenterDisparity;
  if (is_there(disparity)) {
    notes.report.units = "disparity as stored in gt_disp_lowres.pfm";
    DisparityField field = read_of_center(disparity, "disparity maps of the center view", views,
                                          notes, [](Image<float>&) {});
    if (!field.empty()) return field;
  }
  const fs::path depth = folder / kCenterDepth;
  if (is_there(depth) && views.camera.is_known() && views.camera.cam_distance) {
    notes.report.units = "disparity from gt_depth_lowres.pfm and the camera of parameters.cfg";
    DisparityField field =
        read_of_center(depth, "depth maps of the center view", views, notes,
                       [&](Image<float>& map) { depth_to_disparity(views.camera, map); });
    if (!field.empty()) return field;
  }
  const HighResFiles high_res = find_high_res_files(folder);
  if (!high_res.disparity.empty()) {
    notes.report.units = "disparity as stored in gt_disp_highres.pfm, in the middle of each pixel";
    DisparityField field = read_reduced(high_res, views, notes);
    if (!field.empty()) return field;
  }
  return {};
}

DisparityField read_stored(const fs::path& folder, const SidecarViews& views,
                           const SidecarNotes& notes, const Progress& progress) {
  bool has_all = true;
  for (int i = 0; i < views.grid().count() && has_all; ++i) {
    has_all = is_there(folder / disparity_file_of(views.grid().view_at(i), views.files));
  }
  if (has_all) {
    notes.report.units = "disparity as stored in gt_disp_lowres_Cam*.pfm";
    DisparityField field = read_of_all_views(folder, views, notes, progress);
    if (!field.empty()) return field;
  }
  if (views.files.whole_center()) {
    DisparityField field = read_stored_center(folder, views, notes);
    if (!field.empty()) return field;
  }
  notes.report.units = "no truth in this folder";
  return {};
}

/// Disparity that other programs wrote: turned, with values that stand for unknown, or of another
/// sign than that of the benchmark, which views show by what hides what.
void correct_values(const LightField::Samples& samples, DisparityField& field,
                    ConventionReport& report) {
  if (field.empty()) return;
  const ViewIndex at = told_view(field, grid_of(samples));
  const std::string undone = put_truth_upright(samples, field).undone;
  if (!undone.empty()) report.warnings.push_back(turned_back_text(undone));
  drop_unknown_values(samples, at, 1, {field, "The disparity"}, report);
  const Explanation explanation = explain_views(samples, at, field.view(at), 1);
  if (!explanation.is_good()) return;
  const OcclusionOrder side = find_occlusion_order(samples, at, field.view(at), 1, explanation);
  if (!side.is_decided() || side.larger_is_nearer()) return;
  std::transform(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                 field.disparity.data(), std::negate<>());
  report.units += ", negative = nearer";
  report.units_check = fmt::format(finding_text("sign.smaller_hide"), hiding_text(side));
}

void read_regions(const fs::path& folder, const SidecarViews& views, const SidecarNotes& notes,
                  GroundTruth& truth) {
  std::set<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.insert(entry.path());
  Files files;
  for (const fs::path& path : paths) {
    const std::string region = region_of(path, kMaskSuffix);
    if (region.empty()) continue;
    files.read(path, [&] {
      const Image<std::int32_t> numbers = decode_numbers(path);
      require_view_size(path, numbers.height(), numbers.width(), views);
      Image<std::uint8_t> mask(views.height(), views.width());
      const std::int32_t largest = is_numbered_region(region) ? 255 : 1;
      std::transform(numbers.begin(), numbers.end(), mask.begin(), [largest](std::int32_t value) {
        return static_cast<std::uint8_t>(std::clamp(value, 0, largest));
      });
      truth.regions.emplace(region, std::move(mask));
    });
  }
  files.tell("region masks", notes);
}

void find_high_res(const fs::path& folder, const SidecarViews& views, const SidecarNotes& notes,
                   GroundTruth& truth) {
  const HighResFiles files = find_high_res_files(folder);
  truth.high_res = high_res_truth(files, views.height(), views.width());
  if (!truth.high_res) return;
  notes.account.use(files.disparity, "disparity map of the center view in high resolution");
  notes.account.use(files.masks, "region masks in high resolution");
}

void read_object_ids(const fs::path& folder, const SidecarViews& views, const SidecarNotes& notes,
                     GroundTruth& truth) {
  const fs::path path = folder / kObjectIds;
  if (!is_there(path)) return;
  Files files;
  files.read(path, [&] {
    const Image<std::int32_t> ids = decode_numbers(path);
    require_view_size(path, ids.height(), ids.width(), views);
    truth.labels =
        ViewStack<std::int32_t>({1, 1}, ids.height(), ids.width(), 1, *views.files.whole_center());
    std::copy_n(ids.data(), ids.size(), truth.labels.data());
  });
  files.tell("label maps of the center view", notes);
}

}  // namespace

DisparityField read_benchmark_disparity(const fs::path& folder, const SidecarViews& views,
                                        const SidecarNotes& notes, const Progress& progress) {
  DisparityField field = read_stored(folder, views, notes, progress);
  apply_masks_beside(views, notes, field);
  correct_values(views.samples, field, notes.report);
  return field;
}

void read_benchmark_masks(const fs::path& folder, const SidecarViews& views,
                          const SidecarNotes& notes, GroundTruth& truth) {
  if (views.files.whole_center()) read_object_ids(folder, views, notes, truth);
  if (views.files.whole_center() != views.grid().center()) return;  // they are of another view
  read_regions(folder, views, notes, truth);
  find_high_res(folder, views, notes, truth);
}

std::string view_file_name(int index) {
  return fmt::format("{}{:03}.png", kViewPrefix, index);
}

std::string disparity_file_name(int index) {
  return fmt::format("gt_disp_lowres_Cam{:03}.pfm", index);
}

std::string region_of(const std::filesystem::path& mask, const std::string& suffix) {
  const std::string prefix = "mask_";
  const std::string name = mask.filename().string();
  const bool is_mask = name.starts_with(prefix) && name.ends_with(suffix) &&
                       name.size() > prefix.size() + suffix.size();
  if (!is_mask) return {};
  return name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
}

}  // namespace episcope::io
