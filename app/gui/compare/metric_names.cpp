// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_names.h"

#include "engine/evaluation/metrics/benchmark_metrics.h"

#include <QCoreApplication>

#include <algorithm>
#include <iterator>
#include <vector>

namespace episcope {
namespace {

struct MetricName {
  const char* key;
  const char* label;
  const char* help;
  int decimals = 2;
};

// In the order of tables.
constexpr MetricName kNames[] = {
    {"mse_100", QT_TRANSLATE_NOOP("episcope::MetricTable", "MSE×100"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Mean squared error ×100, px²"), 3},
    {"badpix_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "bad .07"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Pixels off by more than 0.07 px, in %")},
    {"badpix_0030", QT_TRANSLATE_NOOP("episcope::MetricTable", "bad .03"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Pixels off by more than 0.03 px, in %")},
    {"badpix_0010", QT_TRANSLATE_NOOP("episcope::MetricTable", "bad .01"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Pixels off by more than 0.01 px, in %")},
    {"q_25_100", QT_TRANSLATE_NOOP("episcope::MetricTable", "Q25"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Error ×100 below which the best quarter of the pixels lies, px"),
     3},
    {"density", QT_TRANSLATE_NOOP("episcope::MetricTable", "dense"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Pixels with a value, in %"), 1},
    {"shown", QT_TRANSLATE_NOOP("episcope::MetricTable", "shown"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels with ground truth that the light field shows, in %"),
     1},
    {"mse_100_inset15", QT_TRANSLATE_NOOP("episcope::MetricTable", "MSE inner"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Mean squared error ×100 without a border of 15 px, px²"),
     3},
    {"discontinuities_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "edges"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels at depth edges off by more than 0.07 px, in %")},
    {"bumpiness_planes_100_0050", QT_TRANSLATE_NOOP("episcope::MetricTable", "bumps pl."),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Bumpiness of planes ×100"), 3},
    {"bumpiness_contin_surfaces_100_0050", QT_TRANSLATE_NOOP("episcope::MetricTable", "bumps sm."),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Bumpiness of smooth surfaces ×100"), 3},
    {"mae_planes", QT_TRANSLATE_NOOP("episcope::MetricTable", "angle pl."),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Median angular error of normals on planes, °")},
    {"mae_contin_surfaces", QT_TRANSLATE_NOOP("episcope::MetricTable", "angle sm."),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Median angular error of normals on smooth surfaces, °")},
    {"fine_fattening_0150", QT_TRANSLATE_NOOP("episcope::MetricTable", "fattened"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels around fine structures that are more than 0.15 px too near, in %")},
    {"fine_thinning_0150", QT_TRANSLATE_NOOP("episcope::MetricTable", "thinned"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels of fine structures that are more than 0.15 px too far, in %")},
    {"backgammon_fattening_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "fattening"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels beside the foreground that are closer to it than to their "
                       "background, in %")},
    {"backgammon_thinning_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "thinning"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels of the foreground that are closer to the background than to it, "
                       "in %")},
    {"missed_dots_50_0400", QT_TRANSLATE_NOOP("episcope::MetricTable", "missed dots"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Dots of which half of the pixels or more are off by more than 0.4 px, "
                       "in %")},
    {"background_mse_100", QT_TRANSLATE_NOOP("episcope::MetricTable", "MSE backgr."),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Mean squared error ×100 of the background between dots, px²"),
     3},
    {"low_texture_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "low texture"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels without much texture off by more than 0.07 px, in %")},
    {"dark_stripes_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "dark str."),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels of dark stripes, of high contrast, off by more than 0.07 px, in %")},
    {"bright_stripes_0070", QT_TRANSLATE_NOOP("episcope::MetricTable", "bright str."),
     QT_TRANSLATE_NOOP(
         "episcope::MetricTable",
         "Pixels of bright stripes, of low contrast, off by more than 0.07 px, in %")},
    {"bumpiness_slanted_100_0050", QT_TRANSLATE_NOOP("episcope::MetricTable", "bumps sl."),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Bumpiness of slanted surfaces ×100"), 3},
    {"bumpiness_parallel_100_0050", QT_TRANSLATE_NOOP("episcope::MetricTable", "bumps par."),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Bumpiness of surfaces parallel to the image ×100"),
     3},
    {"runtime_log", QT_TRANSLATE_NOOP("episcope::MetricTable", "log time"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Decadic logarithm of the seconds taken")},
    {"layers_right", QT_TRANSLATE_NOOP("episcope::MetricTable", "layers"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels with the correct number of layers, one or two, in %"),
     1}};

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::MetricTable)
};

// What a number is of, where the end of its key says so; a key may have several such ends.
struct PartName {
  const char* suffix;
  const char* label;
  const char* help;
};
constexpr PartName kParts[] = {
    {"_foreground", QT_TRANSLATE_NOOP("episcope::MetricTable", "front"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Of the surface in front")},
    {"_background", QT_TRANSLATE_NOOP("episcope::MetricTable", "behind"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Of what is seen through it")},
    {kLowResSuffix, QT_TRANSLATE_NOOP("episcope::MetricTable", "low res."),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "In the resolution of the views: the official score needs the truth of ten "
                       "times the resolution")}};

// A key without its ends, and the numbers of the parts they name, the first one first.
struct KeyParts {
  std::string base;
  std::vector<std::size_t> parts;
};

KeyParts parts_of(const std::string& key) {
  KeyParts split{key, {}};
  for (std::size_t part = 0; part < std::size(kParts);) {
    const std::string suffix = kParts[part].suffix;
    if (!split.base.ends_with(suffix)) {
      ++part;
      continue;
    }
    split.base.resize(split.base.size() - suffix.size());
    split.parts.insert(split.parts.begin(), part);
    part = 0;
  }
  return split;
}

const MetricName* name_of(const std::string& base) {
  return std::find_if(std::begin(kNames), std::end(kNames),
                      [&](const MetricName& name) { return name.key == base; });
}

}  // namespace

int metric_rank(const std::string& key) {
  const KeyParts split = parts_of(key);
  int of_parts = 0;
  for (const std::size_t part : split.parts) of_parts |= 1 << part;
  return static_cast<int>((name_of(split.base) - std::begin(kNames)) << std::size(kParts)) +
         of_parts;
}

MetricColumn metric_column(Protocol protocol, const std::string& key) {
  const KeyParts split = parts_of(key);
  const MetricName* found = name_of(split.base);
  const bool is_known = found != std::end(kNames);
  const QString full_key = QString(protocol_name(protocol)) + '.' + QString::fromStdString(key);
  QString label = is_known ? Text::tr(found->label) : QString::fromStdString(key);
  const QString year = protocol == Protocol::Vmv2013 ? Text::tr("2013") : Text::tr("2016");
  const QString rules =
      protocol == Protocol::Vmv2013
          ? Text::tr("Protocol vmv2013: all pixels with ground truth, centre view")
          : Text::tr(
                "Protocol benchmark2016: without a border of 15 px, centre "
                "view");
  const bool is_share =
      key.starts_with("density") || key.starts_with("shown") || key == "layers_right";
  QString help = is_known ? Text::tr(found->help) : QString();
  for (const std::size_t part : split.parts) {
    if (!is_known) break;
    label += ' ' + Text::tr(kParts[part].label);
    help += '\n' + Text::tr(kParts[part].help);
  }
  return {full_key, year + '\n' + label, QStringList{help, rules, full_key}.join('\n'),
          is_known ? found->decimals : 3, is_share ? BestValue::Greatest : BestValue::Least};
}

}  // namespace episcope
