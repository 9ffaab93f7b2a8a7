// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/scene_info.h"

#include "app/session/scene/scene_range.h"
#include "app/session/scene/scene_summary.h"
#include "widgets/style/number_text.h"
#include "widgets/style/schema_text.h"

#include <QCoreApplication>

#include <cmath>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::InfoPanel)
};

QString type_text(const LightField& light_field) {
  const QString color = light_field.channels() == 3 ? Text::tr("RGB") : Text::tr("grey");
  switch (light_field.sample_type()) {
    case SampleType::UInt8:
      return color + Text::tr(", 8 bit");
    case SampleType::UInt16:
      return color + Text::tr(", 16 bit");
    case SampleType::Float32:
      return color + Text::tr(", float");
  }
  return color;
}

QString sample_text(const LightField& light_field) {
  const bool is_linear = light_field.sample_type() == SampleType::Float32;
  const QString type =
      type_text(light_field) + (is_linear ? Text::tr(", linear") : Text::tr(", gamma-encoded"));
  return light_field.is_on_disk() ? type + Text::tr(", on disk") : type;
}

QString coverage(const ViewStack<float>& maps, GridShape grid) {
  return maps.grid() == grid
             ? Text::tr("all views")
             : Text::tr("%1 of %2 views").arg(maps.grid().count()).arg(grid.count());
}

QString truth_text(const GroundTruth& truth, GridShape grid) {
  QStringList parts;
  if (truth.has_disparity()) {
    parts << Text::tr("disparity (%1)").arg(coverage(truth.field.disparity, grid));
  }
  if (truth.has_layers()) parts << Text::tr("two layers");
  if (!truth.labels.empty()) parts << Text::tr("labels");
  if (!truth.regions.empty()) {
    const int regions = static_cast<int>(truth.regions.size());
    parts << (regions == 1 ? Text::tr("1 region mask") : Text::tr("%1 region masks").arg(regions));
  }
  if (truth.high_res) parts << Text::tr("ten times the resolution for metrics");
  return parts.isEmpty() ? Text::tr("none") : parts.join(", ");
}

// Four digits, and no exponent where whole numbers say as much.
QString measure(double value) {
  return std::abs(value) >= 1000 ? number_text(value, 0)
                                 : with_minus(QString::number(value, 'g', 4));
}

QString camera_text(const CameraGrid& camera) {
  if (!camera.is_known()) return Text::tr("unknown: disparity only, no depth");
  QString line = Text::tr("B·f %1, shift %2 px")
                     .arg(measure(camera.baseline * camera.focal_length), measure(camera.shift));
  if (camera.cam_distance) line += Text::tr(", Z₀ %1").arg(measure(*camera.cam_distance));
  return line;
}

QString megabytes(std::size_t bytes) {
  const double count = static_cast<double>(bytes) / 1e6;
  return QString::number(count, 'f', count < 10 ? 1 : 0);
}

// A finding of the engine: translated where it is a sentence that stands in the program.
QString finding_text(const std::string& finding) {
  return with_minus(schema_text(finding));
}

QString by_whom(const std::string& finding, bool was_chosen) {
  const QString shown = finding_text(finding);
  return was_chosen ? Text::tr("%1 (set by you)").arg(shown) : shown;
}

// Names of an image grid that were given; empty if they were found.
QString names_text(const Reading& reading) {
  const ParameterValue* pattern = reading.find("pattern");
  const bool is_snake = reading.find("snake") != nullptr;
  if (!pattern && !is_snake) return {};
  QString names = pattern ? QString::fromStdString(to_text(*pattern)) : Text::tr("automatic");
  if (is_snake) names += Text::tr(", snake");
  return Text::tr("%1 (set by you)").arg(names);
}

// The GPU that methods compute on, or why there is none.
QString gpu_text(const CudaDevice& device) {
  const auto gibibytes = [](std::size_t bytes) {
    return QString::number(static_cast<double>(bytes) / (1 << 30), 'f', 1);
  };
  if (!device.is_available) return Text::tr("none: %1").arg(schema_text(device.why_not));
  return Text::tr("%1, %2 of %3 GiB free")
      .arg(QString::fromStdString(device.name), gibibytes(device.free_memory),
           gibibytes(device.memory));
}

void add_conventions(SceneInfo& info, const CameraGrid& camera,
                     const ConventionReport& convention) {
  info.rows.push_back({Text::tr("Order"), by_whom(convention.order, convention.order_was_chosen),
                       finding_text(convention.order_check), "order"});
  info.rows.push_back({Text::tr("Sign"),
                       convention.sign.empty() ? Text::tr("not known") : Text::tr("checked"),
                       finding_text(convention.sign_check), "sign"});
  info.rows.push_back({Text::tr("Camera"), camera_text(camera), {}, "camera"});
  if (!convention.units.empty()) {
    info.rows.push_back({Text::tr("Depth"), by_whom(convention.units, convention.units_were_chosen),
                         finding_text(convention.units_check), "units"});
  }
  info.rows.push_back({Text::tr("Format"), schema_text(convention.format), {}, "format"});
}

}  // namespace

SceneInfo describe(const Scene& scene, const std::optional<CudaDevice>& gpu) {
  const LightField& light_field = *scene.light_field;
  const GridShape grid = light_field.grid();
  const ConventionReport& convention = scene.convention;
  const auto utf8 = [](const std::string& each) { return QString::fromStdString(each); };
  SceneInfo info;
  info.title = utf8(light_field.info().name);
  info.rows.push_back({Text::tr("Views"), Text::tr("%1×%2").arg(grid.v).arg(grid.u), {}});
  info.rows.push_back({Text::tr("Size"),
                       Text::tr("%1×%2 px, %3 MB")
                           .arg(light_field.width())
                           .arg(light_field.height())
                           .arg(megabytes(light_field.byte_size())),
                       {}});
  info.rows.push_back({.key = Text::tr("Samples"),
                       .value = sample_text(light_field),
                       .id = "samples",
                       .tip = schema_text(samples_text(scene))});
  if (!light_field.valid().empty()) {
    info.rows.push_back(
        {Text::tr("Valid"),
         Text::tr("%1 % of the pixels").arg(number_text(valid_percent(light_field), 1)),
         Text::tr("The others are dark or empty and do not count.")});
  }
  if (!convention.gain.empty()) {
    info.rows.push_back({Text::tr("Brightness"), finding_text(convention.gain), {}, "gain"});
  }
  if (const Interval range = known_disparity_range(scene); range.length() > 0) {
    info.rows.push_back(
        {Text::tr("Disparity"),
         Text::tr("%1 … %2 px").arg(number_text(range.min, 2), number_text(range.max, 2)),
         {}});
  }
  if (convention.focus_px != 0) {
    info.rows.push_back({Text::tr("Focus"),
                         Text::tr("%1 px applied").arg(number_text(convention.focus_px, 2)),
                         Text::tr("All views but the centre one are interpolated.")});
  }
  info.rows.push_back({Text::tr("Truth"), truth_text(*scene.truth, grid), {}});
  add_conventions(info, light_field.info().camera, convention);
  if (const QString names = names_text(light_field.info().reading); !names.isEmpty()) {
    info.rows.push_back({Text::tr("Names"), names, {}, "names"});
  }
  for (const Companion& companion : scene.companions) {
    info.rows.push_back({schema_text(companion_name(companion.kind)), utf8(companion.shape), {}});
  }
  if (const std::string files = files_text(convention); !files.empty()) {
    info.rows.push_back({Text::tr("Files"), utf8(files), {}, "files"});
  }
  info.rows.push_back({Text::tr("Source"), utf8(light_field.info().source), {}, "source"});
  info.rows.push_back(
      {Text::tr("GPU"), gpu ? gpu_text(*gpu) : Text::tr("being looked for …"), {}, "gpu"});
  for (const std::string& warning : convention.warnings) info.warnings << utf8(warning);
  return info;
}

}  // namespace episcope
