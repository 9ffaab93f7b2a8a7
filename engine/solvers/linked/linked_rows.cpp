// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked/linked_rows.h"

#include "engine/solvers/linked/linked_start.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr float kRelaxation = 1.9F;
constexpr float kUnlimited = 1e30F;

// How far duals move grows with their limits, but more slowly: where these are large, the costs
// bound them.
double dual_size(double limit) {
  return std::min(limit, std::sqrt(limit));
}

}  // namespace

LinkedRows::LinkedRows(const LinkedSetting& setting, LinkedUnknowns& unknowns)
    : setting_(setting),
      unknowns_(unknowns),
      kernel_(EPISCOPE_CHOOSE_KERNEL(setting.isa, kLinkedKernel)),
      simplex_(EPISCOPE_CHOOSE_KERNEL(setting.isa, kSimplexKernel)) {
  const LinkedRow& row = unknowns.row();
  shape_.steps = row.layers;
  shape_.width = row.width;
  shape_.pitch = row.pitch;
  // A pixel is in 8 pairs and 4 links, so that steps may have 2·(8·pair + 4·link)·primal = 1.
  const double size = dual_size(std::max(setting.problem.smoothness, setting.problem.coherence));
  shape_.primal_step = static_cast<float>(1 / (2 * size));
  shape_.dual_step = static_cast<float>(size / 12);
  shape_.relaxation = kRelaxation;
  link_step_ = shape_.dual_step;
  const std::size_t size_of_row = unknowns.row_size();
  for (auto& each : pairs_) each.assign(kPairKinds * size_of_row + 2 * kLayerRowUnit, 0.0F);
  for (auto* each : {&ahead_[0], &ahead_[1], &u_, &nothing_}) {
    each->assign(size_of_row + 2 * kLayerRowUnit, 0.0F);
  }
  cost_.resize(size_of_row);
  limit_.resize(row.pitch);
  places_.resize(row.pitch);
}

PairDuals LinkedRows::pairs(int image, int y) {
  PairDuals row;
  for (int k = 0; k < kPairKinds; ++k) {
    row.pair[k] =
        y < 0 ? nothing_.data() + kLayerRowUnit
              : pairs_[y & 1].data() + kLayerRowUnit + static_cast<long>(k) * unknowns_.row_size();
    row.limit[k] = y < 0 ? nothing_.data() + kLayerRowUnit : setting_.limits[image].row(y, k);
  }
  return row;
}

float* LinkedRows::ahead(int y) {
  return ahead_[y & 1].data() + kLayerRowUnit;
}

void LinkedRows::load_pairs(int image, int y) {
  kernel_.unpack({unknowns_.pairs(image, y), unknowns_.pair_unit()},
                 kPairKinds * unknowns_.row_size(), pairs(image, y).pair[0]);
}

// Limits of the links that leave row y, and where they end.
void LinkedRows::find_leaving(const ImageLinks& links, int y, bool is_limited) {
  const int width = shape_.width;
  const std::int32_t* const target = links.target.row(y);
  const float half = static_cast<float>(setting_.problem.coherence / 2);
  for (int x = 0; x < width; ++x) {
    const std::int32_t at = std::max(target[x], 0);
    places_[x] = at / width * unknowns_.stride() + at % width;
    limit_[x] = target[x] < 0 ? 0 : is_limited ? half * link_weight(links, y, x) : kUnlimited;
  }
}

// Likewise of the links that arrive, and where they come from.
void LinkedRows::find_arriving(int image, int kind, int y, bool is_limited) {
  const int width = shape_.width;
  const ImageLinks& links = setting_.problem.images[setting_.sources.from(image, kind)].links[kind];
  const std::int32_t* const source = setting_.sources.pixels(image, kind).row(y);
  const float half = static_cast<float>(setting_.problem.coherence / 2);
  for (int x = 0; x < width; ++x) {
    const std::int32_t at = std::max(source[x], 0);
    const int from_y = at / width, from_x = at % width;
    places_[x] = from_y * unknowns_.stride() + from_x;
    limit_[x] = source[x] < 0 ? 0
                : is_limited  ? half * link_weight(links, from_y, from_x)
                              : kUnlimited;
  }
}

// Costs less what flows along the links.
void LinkedRows::fill_costs(int image, int y, bool is_limited) {
  look_up_costs(setting_.problem, kernel_, image, y, cost_.data());
  if (setting_.problem.coherence == 0) return;
  const LinkedRow& row = unknowns_.row();
  for (int kind = 0; kind < kLinkKinds; ++kind) {
    const ImageLinks& links = setting_.problem.images[image].links[kind];
    if (links.to >= 0) {
      find_leaving(links, y, is_limited);
      kernel_.leave(row, {unknowns_.links(image, kind, y), unknowns_.link_unit()}, limit_.data(),
                    cost_.data());
    }
    const int from = setting_.sources.from(image, kind);
    if (from >= 0) {
      find_arriving(image, kind, y, is_limited);
      kernel_.arrive(row, {unknowns_.links(from, kind, 0), unknowns_.link_unit()}, places_.data(),
                     limit_.data(), cost_.data());
    }
  }
}

void LinkedRows::move_pairs(int image, int y, const float* ahead_below) {
  simplex_.move_dual(shape_, ahead(y), ahead_below, pairs(image, y));
  kernel_.pack(pairs(image, y).pair[0], kPairKinds * unknowns_.row_size(), unknowns_.pair_unit(),
               unknowns_.pairs(image, y));
}

// A row of u needs the old duals of its own and of the row above, a row of duals the new u of its
// own and of the row below.
void LinkedRows::sweep(int image) {
  const long size = unknowns_.row_size();
  float* const u = u_.data() + kLayerRowUnit;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    load_pairs(image, y);
    fill_costs(image, y, false);
    kernel_.unpack({unknowns_.u(image, y), LinkedUnknowns::kUnit}, size, u);
    simplex_.move_primal(shape_, cost_.data(), pairs(image, y), pairs(image, y - 1), u, ahead(y));
    kernel_.pack(u, size, LinkedUnknowns::kUnit, unknowns_.u(image, y));
    kernel_.pack(ahead(y), size, LinkedUnknowns::kUnit, unknowns_.ahead(image, y));
    if (y > 0) move_pairs(image, y - 1, ahead(y));
  }
  const int last = unknowns_.height() - 1;
  move_pairs(image, last, ahead(last));
}

void LinkedRows::move_links(int image) {
  if (setting_.problem.coherence == 0) return;
  for (int kind = 0; kind < kLinkKinds; ++kind) {
    const ImageLinks& links = setting_.problem.images[image].links[kind];
    if (links.to < 0) continue;
    for (int y = 0; y < unknowns_.height(); ++y) {
      setting_.progress.check();
      find_leaving(links, y, true);
      kernel_.move(unknowns_.row(), {unknowns_.ahead(image, y), LinkedUnknowns::kUnit},
                   {unknowns_.ahead(links.to, 0), LinkedUnknowns::kUnit}, places_.data(),
                   {link_step_, kRelaxation, limit_.data()}, unknowns_.link_unit(),
                   unknowns_.links(image, kind, y));
    }
  }
}

double LinkedRows::bound(int image) {
  double sum = 0;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    load_pairs(image, y);
    fill_costs(image, y, true);
    sum += simplex_.bound(shape_, cost_.data(), pairs(image, y), pairs(image, y - 1));
  }
  return sum;
}

void LinkedRows::round(int image, ImageView<int> labels) {
  float* const u = u_.data() + kLayerRowUnit;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    kernel_.unpack({unknowns_.u(image, y), LinkedUnknowns::kUnit}, unknowns_.row_size(), u);
    simplex_.cut(shape_, u, labels.row(y));
  }
}

}  // namespace episcope
