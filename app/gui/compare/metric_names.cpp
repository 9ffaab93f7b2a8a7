// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_names.h"

#include <QCoreApplication>

#include <algorithm>
#include <iterator>

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
    {"layers_right", QT_TRANSLATE_NOOP("episcope::MetricTable", "layers"),
     QT_TRANSLATE_NOOP("episcope::MetricTable",
                       "Pixels with the correct number of layers, one or two, in %"),
     1}};

QString text(const char* source) {
  return QCoreApplication::translate("episcope::MetricTable", source);
}

// Numbers of a result in two layers carry the layer at the end of their key.
struct LayerName {
  const char* suffix;
  const char* label;
  const char* help;
};
constexpr LayerName kLayers[] = {
    {"_foreground", QT_TRANSLATE_NOOP("episcope::MetricTable", "front"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Of the surface in front")},
    {"_background", QT_TRANSLATE_NOOP("episcope::MetricTable", "behind"),
     QT_TRANSLATE_NOOP("episcope::MetricTable", "Of what is seen through it")}};

const LayerName* layer_of(const std::string& key) {
  const auto* found = std::find_if(std::begin(kLayers), std::end(kLayers),
                                   [&](const auto& layer) { return key.ends_with(layer.suffix); });
  return found == std::end(kLayers) ? nullptr : found;
}

const MetricName* name_of(const std::string& key) {
  const LayerName* layer = layer_of(key);
  const std::string of_both =
      layer ? key.substr(0, key.size() - std::string(layer->suffix).size()) : key;
  return std::find_if(std::begin(kNames), std::end(kNames),
                      [&](const MetricName& name) { return name.key == of_both; });
}

}  // namespace

int metric_rank(const std::string& key) {
  const auto layer = layer_of(key) ? layer_of(key) - kLayers + 1 : 0;
  return static_cast<int>((std::size(kLayers) + 1) * (name_of(key) - std::begin(kNames)) + layer);
}

MetricColumn metric_column(Protocol protocol, const std::string& key) {
  const MetricName* found = name_of(key);
  const LayerName* layer = layer_of(key);
  const bool is_known = found != std::end(kNames);
  const QString full_key = QString(protocol_name(protocol)) + '.' + QString::fromStdString(key);
  QString label = is_known ? text(found->label) : QString::fromStdString(key);
  if (is_known && layer) label += ' ' + text(layer->label);
  const QString year = protocol == Protocol::Vmv2013 ? text("2013") : text("2016");
  const QString rules = protocol == Protocol::Vmv2013
                            ? text("Protocol vmv2013: all pixels with ground truth, centre view")
                            : text(
                                  "Protocol benchmark2016: without a border of 15 px, centre "
                                  "view");
  const bool is_share =
      key.starts_with("density") || key.starts_with("shown") || key == "layers_right";
  QString help = is_known ? text(found->help) : QString();
  if (is_known && layer) help += '\n' + text(layer->help);
  return {full_key, year + '\n' + label, QStringList{help, rules, full_key}.join('\n'),
          is_known ? found->decimals : 3, is_share ? BestValue::Greatest : BestValue::Least};
}

}  // namespace episcope
