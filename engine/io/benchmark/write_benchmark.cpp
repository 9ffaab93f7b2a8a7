// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/io/archive/write_scene.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/atomic_folder.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/maps/pfm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// PNG has no float samples: those become 16 bit, clamped to [0, 1].
Image<std::uint16_t> to_16_bit(ImageView<const float> view) {
  Image<std::uint16_t> image(view.height, view.width, view.channels);
  std::transform(view.data, view.data + view.size(), image.begin(), to_word_sample);
  return image;
}

void write_view(const fs::path& path, const LightField& field, ViewIndex view) {
  if (field.sample_type() == SampleType::UInt8) {
    write_png(path, field.view<std::uint8_t>(view));
  } else if (field.sample_type() == SampleType::UInt16) {
    write_png(path, field.view<std::uint16_t>(view));
  } else {
    write_png(path, to_16_bit(field.view<float>(view)).view());
  }
}

void write_disparity_map(const fs::path& path, const DisparityView& map) {
  Image<float> marked(map.disparity.height, map.disparity.width);
  for (int y = 0; y < marked.height(); ++y) {
    for (int x = 0; x < marked.width(); ++x) {
      marked.at(y, x) =
          map.is_valid(y, x) ? map.disparity.at(y, x) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  write_pfm(path, marked.view());
}

/// Parameters whose camera has the same B·f and shift; depth is in mm, as the benchmark has it.
std::string config_text(const LightField& field) {
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
  return text.str();
}

void write_truth(const fs::path& folder, const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const LightField& field = *scene.light_field;
  const ViewIndex center = field.center();
  if (truth.field.contains(center)) {
    write_disparity_map(folder / kCenterDisparity, truth.field.view(center));
  }
  const bool has_all = truth.has_disparity() && truth.field.disparity.grid() == field.grid();
  for (int i = 0; has_all && i < field.grid().count(); ++i) {
    write_disparity_map(folder / disparity_file_name(i), truth.field.view(field.grid().view_at(i)));
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
    write_view(target.temporary() / view_file_name(i), field, view);
  });
  const std::string config = config_text(field);
  write_atomically(target.temporary() / kBenchmarkConfig,
                   {reinterpret_cast<const std::uint8_t*>(config.data()), config.size()});
  write_truth(target.temporary(), scene);
  progress.check();
  target.commit();
  progress.report(1);
}

}  // namespace episcope::io
