// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/write_scene.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/json.h"
#include "engine/io/formats/benchmark_truth.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

/// Smallest and largest valid disparity.
Interval valid_range(const DisparityField& field) {
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < (field.empty() ? 0 : field.disparity.size()); ++i) {
    if (!field.valid.empty() && field.valid.data()[i] == 0) continue;
    const double d = field.disparity.data()[i];
    range = {std::min(range.min, d), std::max(range.max, d)};
  }
  return range;
}

/// A scene of unknown camera gets one that holds its disparities at positive depths: depth is then
/// true up to a projective change only.
CameraGrid camera_for(const Scene& scene) {
  const CameraGrid& known = scene.light_field->info().camera;
  if (known.is_known()) return known;
  double largest = 1;
  for (const DisparityField* field :
       {&scene.truth->field, &scene.truth->foreground, &scene.truth->background}) {
    const Interval range = valid_range(*field);
    if (range.min <= range.max) {
      largest = std::max({largest, std::abs(range.min), std::abs(range.max)});
    }
  }
  CameraGrid invented;
  invented.cam_distance = 10;
  invented.focal_length = 1;
  invented.shift = 4 * largest;
  invented.baseline = *invented.cam_distance * invented.shift;
  return invented;
}

void write_positions(Hdf5Output& file, const LightFieldInfo& info) {
  if (info.positions.empty()) return;
  std::vector<double> values;
  for (const CameraPosition& position : info.positions) {
    values.push_back(position.x);
    values.push_back(position.y);
  }
  file.set_numbers("/", kPositions, values);
  file.set_text("/", kPositionUnit, info.position_unit);
}

void write_attributes(Hdf5Output& file, const Scene& scene, const CameraGrid& camera) {
  const LightField& field = *scene.light_field;
  const char* root = "/";
  file.set_integers(root, "yRes", {field.height()});
  file.set_integers(root, "xRes", {field.width()});
  file.set_integers(root, "vRes", {field.grid().v});
  file.set_integers(root, "hRes", {field.grid().u});
  file.set_integers(root, "channels", {field.channels()});
  file.set_number(root, "vSampling", camera.baseline / field.width());
  file.set_number(root, "hSampling", camera.baseline / field.width());
  write_camera(file, root, camera);
  file.set_number(root, "dV", camera.baseline);
  file.set_text(root, kConvention, kConventionText);
  file.set_text(root, "name", field.info().name);
  if (!field.info().camera.is_known()) {
    file.set_text(root, "camera",
                  "unknown; dH, focalLength and shift only turn disparity into "
                  "depth and back");
  }
  if (field.info().disparity_range) {
    file.set_number(root, "disp_min", field.info().disparity_range->min);
    file.set_number(root, "disp_max", field.info().disparity_range->max);
  }
  write_positions(file, field.info());
}

void write_light_field(Hdf5Output& file, const LightField& field, const Progress& progress) {
  const GridShape grid = field.grid();
  const Hdf5Shape shape{static_cast<std::size_t>(grid.v), static_cast<std::size_t>(grid.u),
                        static_cast<std::size_t>(field.height()),
                        static_cast<std::size_t>(field.width()),
                        static_cast<std::size_t>(field.channels())};
  std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        file.add_dataset<T>("LF", shape, "v,u,y,x,c", "");
        for (int i = 0; i < grid.count(); ++i) {
          progress.check();
          const ViewIndex view = grid.view_at(i);
          file.write(std::string("LF"), view_block(shape, view), stack.view(view).data);
          progress.report((i + 1.0) / grid.count());
        }
      },
      field.samples());
}

/// A single view is stored as `[y][x]` if it is the center, else as one valid view of all.
MapGeometry stored_geometry(const DisparityField& field, const LightField& light_field) {
  MapGeometry maps = geometry_of(field.disparity);
  if (maps.grid.count() == 1 && maps.first == light_field.center()) return maps;
  maps.grid = light_field.grid();
  maps.first = {};
  return maps;
}

/// Writes a disparity field as depth, 0 where there is none, and its mask if something is missing.
void write_depth(Hdf5Output& file, const std::string& name, const DisparityField& field,
                 const Scene& scene, const CameraGrid& camera, const Progress& progress) {
  if (field.empty()) return;
  const LightField& light_field = *scene.light_field;
  const ViewStack<float>& disparity = field.disparity;
  const MapGeometry maps = stored_geometry(field, light_field);
  std::vector<float> depth(disparity.view_size());
  const auto to_depth = [&](ViewIndex view) -> const float* {
    std::fill(depth.begin(), depth.end(), 0.0F);
    if (!field.contains(view)) return depth.data();
    const DisparityView map = field.view(view);
    for (int y = 0; y < disparity.height(); ++y) {
      for (int x = 0; x < disparity.width(); ++x) {
        if (!map.is_valid(y, x)) continue;
        const double z = camera.depth_from_disparity(map.disparity.at(y, x));
        depth[static_cast<std::size_t>(y) * disparity.width() + x] =
            std::isfinite(z) ? static_cast<float>(z) : 0.0F;
      }
    }
    return depth.data();
  };
  const bool has_mask = !field.valid.empty() || !(disparity.grid() == maps.grid);
  std::vector<std::uint8_t> mask;  ///< Of all views, in the order in which they are written.
  write_maps<float>(
      file, name, maps, "scene units", progress.part(0, has_mask ? 0.8 : 1), [&](ViewIndex view) {
        const float* z = to_depth(view);
        if (has_mask) {
          std::transform(z, z + depth.size(), std::back_inserter(mask),
                         [](float one) { return static_cast<std::uint8_t>(one > 0); });
        }
        return z;
      });
  if (!has_mask) return;
  const std::uint8_t* next = mask.data();
  write_maps<std::uint8_t>(file, name + "_MASK", maps, "", progress.part(0.8, 1), [&](ViewIndex) {
    return std::exchange(next, next + disparity.view_size());
  });
}

/// Region masks of the center view, and which pixels of the views are valid.
void write_masks(Hdf5Output& file, const Scene& scene, const Progress& progress) {
  for (const auto& [name, region] : scene.truth->regions) {
    const Hdf5Shape shape{static_cast<std::size_t>(region.height()),
                          static_cast<std::size_t>(region.width())};
    file.add_dataset<std::uint8_t>(kRegionPrefix + name, shape, "y,x", "");
    file.write(kRegionPrefix + name, {{0, 0}, shape}, region.data());
  }
  const ViewStack<std::uint8_t>& valid = scene.light_field->valid();
  if (!valid.empty()) write_stack(file, kValid, valid, "", progress);
}

/// A part of the views that is not the center alone is stored among all, the others as 0 = none.
void write_true_labels(Hdf5Output& file, const Scene& scene, const Progress& progress) {
  const ViewStack<std::int32_t>& labels = scene.truth->labels;
  if (labels.empty()) return;
  const LightField& field = *scene.light_field;
  const bool is_center = labels.grid().count() == 1 && labels.first() == field.center();
  if (is_center || labels.grid() == field.grid()) {
    return write_label_maps(file, kTrueLabels, labels, progress);
  }
  MapGeometry maps = geometry_of(labels);
  maps.grid = field.grid();
  maps.first = {};
  const std::vector<std::int32_t> none(labels.view_size(), 0);
  write_label_maps(file, kTrueLabels, maps, progress, [&](ViewIndex view) {
    return labels.contains(view) ? labels.view(view).data : none.data();
  });
}

void write_labels(Hdf5Output& file, const Scene& scene, const Progress& progress) {
  write_true_labels(file, scene, progress);
  if (!scene.truth->labels.empty()) {
    add_label_list(file, kTrueLabels, scene.scribbles.labels);
    const auto& estimated = scene.truth->labels_estimated;
    if (estimated) write_estimated(file, kTrueLabels, *estimated);
  }
  if (scene.scribbles.empty()) return;
  const LightField& field = *scene.light_field;
  add_scribbles(file, scene.scribbles, {{field.grid(), field.height(), field.width()}, {}, false},
                progress);
}

bool has_labels(const Scene& scene) {
  return !scene.truth->labels.empty() || !scene.scribbles.empty();
}

std::filesystem::path label_file(const std::filesystem::path& path, LabelFile labels) {
  const std::vector<std::filesystem::path> files = label_files_of(path);
  return labels == LabelFile::NamedAfter ? files.front() : files.back();
}

/// Whether this file of labels may be written: there is none, or it is ours of the same light
/// field. Labels of other programs are never overwritten; ours then go into the light-field file
/// itself.
bool may_write_labels(const std::filesystem::path& labels, const std::filesystem::path& file) {
  if (!std::filesystem::exists(labels)) return true;
  return has_hdf5_signature(labels) &&
         Hdf5Input(labels).text("/", "light_field") == file.filename().string();
}

/// Keeps what lies at a path, to bring it back if a later step fails: light field and labels are to
/// change both or neither. Where the disk knows no hard links, the new file stays.
class FormerFile {
 public:
  explicit FormerFile(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    was_there_ = std::filesystem::exists(path, error);
    if (!was_there_) return;
    path_ = std::filesystem::canonical(path, error);
    kept_ = path_.parent_path() / path_.filename().string().insert(0, 1, '.').append(".former");
    std::filesystem::remove(kept_, error);
    std::filesystem::create_hard_link(path_, kept_, error);
    if (error) kept_.clear();
  }
  ~FormerFile() {
    std::error_code ignored;
    if (!kept_.empty()) std::filesystem::remove(kept_, ignored);
  }
  FormerFile(const FormerFile&) = delete;
  FormerFile& operator=(const FormerFile&) = delete;

  template <class Step>
  void restore_unless(const Step& step) {
    try {
      step();
    } catch (...) {
      std::error_code ignored;
      if (!was_there_) std::filesystem::remove(path_, ignored);
      if (!kept_.empty()) std::filesystem::rename(kept_, path_, ignored);
      throw;
    }
  }

 private:
  std::filesystem::path path_;
  std::filesystem::path kept_;
  bool was_there_ = false;
};

std::uintmax_t archive_bytes(const Scene& scene, bool has_disparity) {
  const auto of = [&](const DisparityField& field) {
    return field.empty() ? 0 : field.disparity.size() * (has_disparity ? 9 : 5);
  };
  const GroundTruth& truth = *scene.truth;
  const LightField& field = *scene.light_field;
  const std::size_t view = static_cast<std::size_t>(field.height()) * field.width();
  const std::size_t valid = field.valid().empty() ? 0 : field.valid().size();
  return field.byte_size() + valid + truth.regions.size() * view + of(truth.field) +
         of(truth.foreground) + of(truth.background) + (1 << 16);
}

std::uintmax_t label_bytes(const Scene& scene) {
  const std::size_t labels = scene.truth->labels.empty() ? 0 : scene.truth->labels.size();
  const LightField& field = *scene.light_field;
  const std::size_t views = scene.scribbles.views.size();
  const std::size_t painted = (views > 1 ? static_cast<std::size_t>(field.grid().count()) : views) *
                              field.height() * field.width();
  return labels + painted + (1 << 16);  // deflated
}

void write_stated(Hdf5Output& file, const StatedFacts& stated) {
  const std::pair<const char*, const std::string&> texts[] = {
      {kOrigin, stated.origin}, {kSamples, stated.samples}, {kSign, stated.sign}};
  for (const auto& [name, text] : texts) {
    if (!text.empty()) file.set_text("/", name, text);
  }
}

void require_size(const DisparityField& field, const LightField& views) {
  const ViewStack<float>& maps = field.disparity;
  if (maps.empty() || (maps.height() == views.height() && maps.width() == views.width())) return;
  throw InvalidInput(fmt::format("the truth has {}×{} px, but the views have {}×{} px",
                                 maps.width(), maps.height(), views.width(), views.height()));
}

// All layers as depth, and as disparity if that is wanted.
void write_truth(Hdf5Output& file, const Scene& scene, const CameraGrid& camera, bool has_disparity,
                 const Progress& progress) {
  const GroundTruth& truth = *scene.truth;
  const std::pair<const char*, const DisparityField*> fields[] = {
      {"", &truth.field}, {"_FOREGROUND", &truth.foreground}, {"_BACKGROUND", &truth.background}};
  double done = 0;
  for (const auto& [layer, field] : fields) {
    progress.check();
    require_size(*field, *scene.light_field);
    const std::string depth = std::string(kTrueDepth) + layer;
    const std::string disparity = std::string(kTrueDisparity) + layer;
    write_depth(file, depth, *field, scene, camera, progress.part(done, done + 0.25));
    if (has_disparity && !field->empty()) {
      write_disparity(file, disparity, *field, stored_geometry(*field, *scene.light_field),
                      progress.part(done + 0.25, done + 0.33));
    }
    for (const std::string& name : {depth, disparity}) {
      if (truth.estimated && file.has(name)) write_estimated(file, name, *truth.estimated);
    }
    done += 0.33;
  }
}

// Beside the archive `of`; nothing is there before commit().
void write_label_file(AtomicFile& target, const std::filesystem::path& of, const Scene& scene,
                      const Progress& progress) {
  Hdf5Output file(target);
  file.set_text("/", "light_field", of.filename().string());
  file.set_text("/", kConvention, kConventionText);
  write_labels(file, scene, progress);
  file.close();
}

}  // namespace

std::filesystem::path labels_place(const std::filesystem::path& path, const Scene& scene,
                                   LabelFile labels) {
  if (!has_labels(scene)) return {};
  const std::filesystem::path beside = label_file(path, labels);
  return beside == path || !may_write_labels(beside, path) ? path : beside;
}

void write_archive(const std::filesystem::path& path, const Scene& scene, const Progress& progress,
                   const ArchiveForm& form) {
  progress.check();
  progress.step("writing " + path.filename().string());
  const std::filesystem::path beside = label_file(path, form.labels);
  const std::filesystem::path place = labels_place(path, scene, form.labels);
  const bool is_inside = !place.empty() && place == path;
  const bool is_apart = !place.empty() && !is_inside;
  const CameraGrid camera = camera_for(scene);

  const std::uintmax_t label_room = is_inside ? label_bytes(scene) : 0;
  AtomicFile target(path, archive_bytes(scene, form.has_disparity) + label_room);
  Hdf5Output file(target);
  write_attributes(file, scene, camera);
  write_stated(file, scene.convention.stated);
  write_light_field(file, *scene.light_field, progress.part(0, 0.6));
  write_truth(file, scene, camera, form.has_disparity, progress.part(0.6, 0.84));
  write_masks(file, scene, progress.part(0.84, 0.86));
  if (is_inside) write_labels(file, scene, progress.part(0.86, 0.95));
  file.close();

  if (is_apart) {
    AtomicFile label_target(beside, label_bytes(scene));
    write_label_file(label_target, path, scene, progress.part(0.86, 0.95));
    progress.check();
    FormerFile former(path);
    target.commit();
    former.restore_unless([&] { label_target.commit(); });
  } else {
    target.commit();
  }
  // Otherwise labels of the overwritten file would be taken for those of the new one.
  for (const std::filesystem::path& old : label_files_of(path)) {
    if (old == place || !std::filesystem::exists(old) || !may_write_labels(old, path)) continue;
    std::filesystem::remove(old);
  }
  progress.report(1);
}

namespace {

namespace fs = std::filesystem;

/// PNG has no float samples: those become 16 bit, clamped to [0, 1].
Image<std::uint16_t> to_16_bit(ImageView<const float> view) {
  Image<std::uint16_t> image(view.height, view.width, view.channels);
  std::transform(view.data, view.data + view.size(), image.begin(), to_word_sample);
  return image;
}

void write_benchmark_view(const fs::path& path, const LightField& field, ViewIndex view) {
  if (field.sample_type() == SampleType::UInt8) {
    write_png(path, field.view<std::uint8_t>(view));
  } else if (field.sample_type() == SampleType::UInt16) {
    write_png(path, field.view<std::uint16_t>(view));
  } else {
    write_png(path, to_16_bit(field.view<float>(view)).view());
  }
}

/// Parameters whose camera has the same B·f and shift; depth is in mm, as the benchmark has it.
std::string config_text(const Scene& scene) {
  const LightField& field = *scene.light_field;
  constexpr double kFocalLengthMm = 100;
  constexpr double kSensorMm = 35;
  const CameraGrid& camera = field.info().camera;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "[intrinsics]\nimage_resolution_x_px = " << field.width()
       << "\nimage_resolution_y_px = " << field.height() << "\n";
  const bool is_known = camera.is_known() && camera.shift > 0;
  if (is_known) {
    text << "focal_length_mm = " << kFocalLengthMm << "\nsensor_size_mm = " << kSensorMm << "\n";
  }
  text << "\n[extrinsics]\nnum_cams_x = " << field.grid().u << "\nnum_cams_y = " << field.grid().v
       << "\n";
  if (is_known) {
    const double focal_length_px =
        kFocalLengthMm * std::max(field.width(), field.height()) / kSensorMm;
    const double product = camera.baseline * camera.focal_length;
    text << "baseline_mm = " << product / focal_length_px
         << "\nfocus_distance_m = " << product / camera.shift / 1000 << "\n";
  }
  text << "\n[meta]\nscene = " << field.info().name << "\n";
  if (field.info().disparity_range) {
    text << "disp_min = " << field.info().disparity_range->min
         << "\ndisp_max = " << field.info().disparity_range->max << "\n";
  }
  if (const auto& estimated = scene.truth->estimated) {
    text << kEstimatedBy << " = " << estimated->method << "\n"
         << kEstimatedFrom << " = " << estimated->source << "\n";
  }
  return text.str();
}

void write_truth(const fs::path& folder, const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const LightField& field = *scene.light_field;
  const ViewIndex center = field.center();
  if (truth.field.contains(center)) {
    write_pfm(folder / kCenterDisparity, marked_map(truth.field.view(center)).view());
  }
  const bool is_of_center =
      truth.field.disparity.grid().count() == 1 && truth.field.contains(center);
  for (int i = 0; !is_of_center && i < field.grid().count(); ++i) {
    const ViewIndex view = field.grid().view_at(i);
    if (!truth.field.contains(view)) continue;
    write_pfm(folder / disparity_file_name(i), marked_map(truth.field.view(view)).view());
  }
  if (truth.labels.contains(center) && !truth.labels.empty()) {
    const auto labels = truth.labels.view(center);
    Image<std::uint16_t> ids(labels.height, labels.width);
    std::transform(labels.data, labels.data + labels.size(), ids.begin(), [](std::int32_t label) {
      return static_cast<std::uint16_t>(std::clamp(label, 0, 65535));
    });
    write_png(folder / kObjectIds, ids.view());
  }
  for (const auto& [name, region] : truth.regions) {
    Image<std::uint8_t> mask(region.height(), region.width());
    const bool is_numbered = is_numbered_region(name);
    std::transform(region.begin(), region.end(), mask.begin(),
                   [=](std::uint8_t inside) { return inside == 0 || is_numbered ? inside : 255; });
    write_png(folder / ("mask_" + name + kMaskSuffix), mask.view());
  }
}

}  // namespace

void write_benchmark_folder(const fs::path& folder, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + folder.filename().string());
  const LightField& field = *scene.light_field;
  AtomicFolder target(folder, field.byte_size());
  parallel_for(field.grid().count(), progress.part(0, 0.9), [&](int i) {
    const ViewIndex view = field.grid().view_at(i);
    write_benchmark_view(target.temporary() / view_file_name(i), field, view);
  });
  const std::string config = config_text(scene);
  write_atomically(target.temporary() / kBenchmarkConfig,
                   {reinterpret_cast<const std::uint8_t*>(config.data()), config.size()});
  write_truth(target.temporary(), scene);
  progress.check();
  target.commit();
  progress.report(1);
}

}  // namespace episcope::io
