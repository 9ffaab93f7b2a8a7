// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/wand.h"

namespace episcope {

Wand::Wand(const Session& session, QObject* parent)
    : QObject(parent), session_(session), job_(this) {}

std::shared_ptr<const DisparityField> Wand::disparity() const {
  const auto& scene = session_.scene();
  if (!scene) return nullptr;
  const GridShape grid = scene->light_field->grid();
  const auto covers_all = [grid](const DisparityField& field) {
    return !field.empty() && field.disparity.grid() == grid;
  };
  const auto known = session_.known_disparity(session_.view());
  if (known && covers_all(*known)) return known;
  if (covers_all(scene->truth->field)) return {scene->truth, &scene->truth->field};
  const auto& of_labels = session_.label_disparity();
  return of_labels && covers_all(*of_labels) ? of_labels : nullptr;
}

Wand::State Wand::prepare() {
  const auto field = disparity();
  const LightFieldPtr light_field = session_.light_field();
  const bool is_known = field && light_field_.lock() == light_field && disparity_.lock() == field;
  if (is_known) return superpixels_ ? State::Ready : State::Making;
  superpixels_ = nullptr;
  light_field_ = light_field;
  disparity_ = field;
  job_.drop();
  if (!field) return State::Missing;
  job_.start<Superpixels>(
      [light_field, field](const Progress& progress) {
        return std::make_shared<const RaySuperpixels>(*light_field, *field, progress);
      },
      [this](const Superpixels& made) {
        superpixels_ = made;
        emit ready();
      });
  return State::Making;
}

std::vector<std::uint8_t> Wand::select(ViewIndex view, PixelIndex seed, float tolerance) const {
  if (!superpixels_) return {};
  const ImageView<const std::uint16_t> ids = superpixels_->ids().view(view);
  const bool is_inside = seed.y >= 0 && seed.x >= 0 && seed.y < ids.height && seed.x < ids.width;
  if (!is_inside) return {};
  return superpixels_->alike(ids.at(seed.y, seed.x), tolerance);
}

PixelRegion Wand::region(const std::vector<std::uint8_t>& selected, ViewIndex view) const {
  if (selected.empty()) return {};
  const ImageView<const std::uint16_t> ids = superpixels_->ids().view(view);
  return region_where(ids.height, ids.width, [&](int y, int x) {
    const std::uint16_t id = ids.at(y, x);
    return id != RaySuperpixels::kNone && selected[id] != 0;
  });
}

std::vector<ViewRegion> Wand::regions(const std::vector<std::uint8_t>& selected) const {
  std::vector<ViewRegion> regions;
  if (selected.empty()) return regions;
  const GridShape grid = superpixels_->ids().grid();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    if (PixelRegion pixels = region(selected, view); !pixels.empty()) {
      regions.push_back({view, std::move(pixels)});
    }
  }
  return regions;
}

}  // namespace episcope

#include "moc_wand.cpp"
